//! The state as the integrators see it.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::record::Record;
use super::setting::Context;

/// `impl State for SleighState`.
pub(super) fn emit(context: &Context) -> TokenStream {
    of(context, &context.state)
}

/// `impl State` for a record.
pub(super) fn of(context: &Context, record: &Record) -> TokenStream {
    let Context { runtime, scalar, lints, .. } = context;
    let generics = context.record_impl_generics();
    let state = context.type_of(record);
    let length = Literal::usize_unsuffixed(record.len());
    let names = record.names();
    let components = super::layout::local("components");
    quote! {
        #lints
        #[automatically_derived]
        impl #generics #runtime::State for #state {
            type Scalar = #scalar;
            type Dim = #runtime::D<#length>;
            #[inline]
            fn to_array(&self) -> [#scalar; #length] {
                ::core::convert::From::from(*self)
            }
            #[inline]
            fn from_array(#components: [#scalar; #length]) -> Self {
                ::core::convert::From::from(#components)
            }
            #[inline]
            fn names() -> [&'static ::core::primitive::str; #length] {
                [#(#names),*]
            }
        }
    }
}

//! The state as the integrators see it.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::context::Context;

/// `impl State for SleighState`.
pub(super) fn emit(context: &Context) -> TokenStream {
    let Context { runtime, scalar, .. } = context;
    let generics = context.record_impl_generics();
    let state = context.type_of(&context.state);
    let length = Literal::usize_unsuffixed(context.state.len());
    let names = context.state.names();
    let components = super::layout::local("components");
    quote! {
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

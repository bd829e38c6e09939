//! The trait of the energy.

use proc_macro2::TokenStream;
use quote::quote;

use super::setting::Context;

/// `impl Energy for Sleigh`.
pub(super) fn implementation(context: &Context) -> TokenStream {
    let Context { runtime, scalar, .. } = context;
    let (t, state, state_type) = (&context.locals.t, &context.locals.state, context.type_of(&context.state));
    let body = quote! {
        #[inline]
        fn energy(&self, #t: #scalar, #state: &#state_type) -> #scalar {
            Self::energy(self, #t, #state)
        }
    };
    context.implement(&quote!(#runtime::Energy), &body)
}

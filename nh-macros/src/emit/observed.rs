//! The trait of the declared observables.

use proc_macro2::TokenStream;
use quote::quote;

use super::record::Record;
use super::setting::Context;

/// `impl Observed for Sleigh`.
pub(super) fn implementation(context: &Context, outputs: &Record) -> TokenStream {
    let Context { runtime, scalar, .. } = context;
    let (t, state, input) = (&context.locals.t, &context.locals.state, &context.locals.input);
    let (state_type, input_type) = (context.type_of(&context.state), context.input_type());
    let outputs = context.type_of(outputs);
    let body = quote! {
        type Outputs = #outputs;
        #[inline]
        fn outputs(&self, #t: #scalar, #state: &#state_type, #input: &#input_type) -> #outputs {
            Self::outputs(self, #t, #state, #input)
        }
    };
    context.implement(&quote!(#runtime::Observed), &body)
}

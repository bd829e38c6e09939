//! The energy.

use nonholonomic_core::program::Program;
use proc_macro2::TokenStream;
use quote::quote;

use super::context::Context;
use super::function::Head;
use super::program::body;
use super::scope::Scope;

/// The head of `energy`.
pub(super) fn head(context: &Context) -> Head {
    Head {
        name: "energy",
        doc: &[" The energy y · ∂L/∂y − L."],
        takes_input: false,
        returns: context.scalar.clone(),
    }
}

/// The inherent method `energy`.
pub(super) fn method(context: &Context, scope: &Scope, program: &Program) -> TokenStream {
    let body = body(context, scope, program);
    let (statements, value) = (&body.statements, body.outputs.first());
    head(context).with_body(context, &body.used, &quote!(#statements #value))
}

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

//! All quasi-velocities, those that are not in the state included.

use nonholonomic_core::program::Program;
use proc_macro2::TokenStream;
use quote::quote;

use super::context::Context;
use super::function::Head;
use super::program::body;
use super::scope::Scope;

/// The head of `velocity`.
pub(super) fn head(context: &Context) -> Head {
    Head {
        name: "velocity",
        doc: &[" All quasi-velocities, as the constraints give them from the state."],
        takes_input: false,
        returns: context.type_of(&context.velocity),
    }
}

/// The inherent method `velocity`.
pub(super) fn method(context: &Context, scope: &Scope, program: &Program) -> TokenStream {
    let body = body(context, scope, program);
    let name = &context.velocity.name;
    let result = context.velocity.construct(&quote!(#name), &body.outputs);
    let statements = &body.statements;
    head(context).with_body(context, &body.used, &quote!(#statements #result))
}

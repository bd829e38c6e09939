//! The derivative by the Gibbs–Appell function.

use std::collections::BTreeSet;

use nonholonomic_core::system::System;
use proc_macro2::TokenStream;
use quote::quote;

use super::context::Context;
use super::function::{Head, Part, program};
use super::program::body;
use super::scope::Scope;

/// The head of `gibbs_appell`.
fn head(context: &Context) -> Head {
    Head {
        name: "gibbs_appell",
        doc: &[
            " The time derivative of the state by the function of Gibbs and Appell: another derivation of",
            " the same equations, which agrees with `derivative` to rounding.",
        ],
        takes_input: true,
        returns: context.type_of(&context.state),
    }
}

/// The inherent method, if it is asked for.
pub(super) fn emit(context: &Context, scope: &Scope, system: &System) -> Part {
    let Some(procedure) = &system.gibbs_appell else { return Part::default() };
    let program = program(&system.model, procedure);
    let body = body(context, scope, &program);
    let name = &context.state.name;
    let result = context.state.construct(&quote!(#name), &body.outputs);
    let statements = &body.statements;
    let methods = head(context).with_body(context, &body.used, &quote!(#statements #result));
    Part { methods, items: TokenStream::new(), programs: vec![("gibbs_appell", program)] }
}

/// What stands for it beside errors.
pub(super) fn stub(context: &Context) -> Part {
    let default = quote!(::core::default::Default::default());
    let methods = head(context).with_body(context, &BTreeSet::new(), &default);
    Part { methods, ..Part::default() }
}

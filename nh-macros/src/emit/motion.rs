//! The time derivative of the state, and the system as the integrators see it.

use std::collections::BTreeSet;

use nonholonomic_core::program::{Cost, Program};
use proc_macro2::TokenStream;
use quote::quote;

use super::inherent_method::Head;
use super::layout::local;
use super::program::body;
use super::setting::Context;
use super::symbols::{Argument, Scope};

/// The head of `derivative`.
pub(super) fn head(context: &Context) -> Head {
    Head {
        name: "derivative",
        doc: &[" The time derivative of the state: the field `x` of the result is ẋ."],
        takes_input: true,
        returns: context.type_of(&context.state),
    }
}

/// A derivative of at most so many instructions becomes part of the step that evaluates it, at every stage.
/// Compilers judge each of its calls by itself; in one piece, what depends on parameters alone leaves the
/// loop, and stages stay in registers.
const PART_OF_THE_STEP: usize = 160;

/// The attribute of a derivative that says whether it becomes part of the step.
pub(super) fn inlining(program: &Program) -> TokenStream {
    if Cost::of(program).instructions() <= PART_OF_THE_STEP {
        quote!(#[inline(always)] #[allow(clippy::inline_always)])
    } else {
        quote!(#[inline])
    }
}

/// The inherent method `derivative`.
pub(super) fn method(context: &Context, scope: &Scope, program: &Program) -> TokenStream {
    let (used, statements) = statements(context, scope, program);
    head(context).with_inlining(context, &used, &statements, &inlining(program))
}

/// The arguments that the derivative reads, and the statements that compute it.
pub(super) fn statements(
    context: &Context,
    scope: &Scope,
    program: &Program,
) -> (BTreeSet<Argument>, TokenStream) {
    let body = body(context, scope, program);
    let name = &context.state.name;
    let result = context.state.construct(&quote!(#name), &body.outputs);
    let statements = &body.statements;
    (body.used, quote!(#statements #result))
}

/// `impl Dynamics for Sleigh`, with how states are checked.
pub(super) fn implementation(
    context: &Context,
    inlining: &TokenStream,
    check_state: &TokenStream,
) -> TokenStream {
    let Context { runtime, scalar, .. } = context;
    let (t, state, input) = (&context.locals.t, &context.locals.state, &context.locals.input);
    let state_type = context.type_of(&context.state);
    let input_type = context.input_type();
    let check_input = check_input(context);
    let body = quote! {
        type State = #state_type;
        type Input = #input_type;
        #inlining
        fn derivative(&self, #t: #scalar, #state: &#state_type, #input: &#input_type) -> #state_type {
            Self::derivative(self, #t, #state, #input)
        }
        #[inline]
        fn validate(&self) -> ::core::result::Result<(), #runtime::ParameterError> {
            Self::validate(self)
        }
        #check_state
        #check_input
    };
    context.implement(&quote!(#runtime::Dynamics), &body)
}

/// Refuses inputs that are not finite.
fn check_input(context: &Context) -> TokenStream {
    let Context { runtime, .. } = context;
    let Some(record) = &context.input else { return TokenStream::new() };
    let (input, input_type) = (&context.locals.input, context.input_type());
    let (name, value) = (local("name"), local("value"));
    let pairs = record.names().zip(record.places(input)).map(|(name, place)| quote!((#name, #place)));
    quote! {
        fn check_input(&self, #input: &#input_type) -> ::core::result::Result<(), #runtime::InputFault> {
            for (#name, #value) in [#(#pairs),*] {
                if !#runtime::Scalar::is_finite(#value) {
                    return ::core::result::Result::Err(#runtime::InputFault {
                        input: #name,
                        value: #runtime::Scalar::to_f64(#value),
                    });
                }
            }
            ::core::result::Result::Ok(())
        }
    }
}

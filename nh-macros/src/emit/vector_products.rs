//! Products of the Jacobian of the derivative with vectors, from either side.

use nonholonomic_core::id::SymbolId;
use nonholonomic_core::model::Model;
use nonholonomic_core::system::{Side, System, VectorProduct};
use proc_macro2::{Ident, Span, TokenStream};
use quote::{ToTokens, quote};
use std::collections::BTreeSet;

use super::inherent_method::{Part, drops};
use super::layout::local;
use super::program::body;
use super::setting::Context;
use super::symbols::{Argument, Scope};

/// The methods that are asked for.
pub(super) fn emit(context: &Context, system: &System) -> Part {
    let mut part = Part::default();
    for VectorProduct { side, vector, procedure } in &system.products {
        let program = context.derivative(system, side.word(), procedure);
        let scope = scope(context, &system.model, &system.state(), (*side, vector));
        let body = body(context, &scope, &program);
        let n = context.state.len();
        let state = |outputs: &[TokenStream]| context.state.construct(&context.state_name(), outputs);
        let value = match side {
            Side::Right => state(&body.outputs),
            Side::Left => {
                let (by_state, by_input) = body.outputs.split_at(n.min(body.outputs.len()));
                let by_state = state(by_state);
                let by_input = context.input.as_ref().map_or_else(
                    || quote!(()),
                    |record| record.construct(&record.name.to_token_stream(), by_input),
                );
                quote!((#by_state, #by_input))
            }
        };
        let statements = &body.statements;
        part.methods.extend(method(context, *side, &body.used, &quote!(#statements #value)));
        part.programs.push((side.word(), program));
    }
    part
}

/// One with zeros.
pub(super) fn stub(context: &Context, side: Side) -> Part {
    let zero = quote!(::core::default::Default::default());
    Part { methods: method(context, side, &BTreeSet::new(), &zero), ..Part::default() }
}

/// The arguments beside time, state and input: their names and types.
fn further(context: &Context, side: Side) -> Vec<(Argument, Ident, TokenStream)> {
    let state = context.type_of(&context.state);
    match side {
        Side::Right => vec![
            (Argument::Direction, local("direction"), state),
            (Argument::InputDirection, local("input_direction"), context.input_type()),
        ],
        Side::Left => vec![(Argument::Weights, local("weights"), state)],
    }
}

/// Where the vector is.
fn scope<'a>(
    context: &Context,
    model: &'a Model,
    in_state: &[SymbolId],
    (side, vector): (Side, &[SymbolId]),
) -> Scope<'a> {
    let mut scope = Scope::new(context, model, in_state);
    let (of_state, of_input) = vector.split_at(in_state.len().min(vector.len()));
    for ((argument, ident, _), (record, symbols)) in further(context, side)
        .into_iter()
        .zip([(Some(&context.state), of_state), (context.input.as_ref(), of_input)])
    {
        if let Some(record) = record {
            scope = scope.with_places(argument, symbols, record.places(&ident));
        }
    }
    scope
}

/// A method with this body.
fn method(context: &Context, side: Side, used: &BTreeSet<Argument>, body: &TokenStream) -> TokenStream {
    let Context { visibility, scalar, .. } = context;
    let (t, state, input) = (&context.locals.t, &context.locals.state, &context.locals.input);
    let (state_type, input_type) = (context.type_of(&context.state), context.input_type());
    let further = further(context, side);
    let parameters = further.iter().map(|(_, ident, of_type)| quote!(#ident: &#of_type));
    let mut drops = drops(context, used, true);
    for (_, ident, _) in further.iter().filter(|(argument, ..)| !used.contains(argument)) {
        drops.extend(quote!(_ = #ident;));
    }
    let (doc, returns): (&[&str], TokenStream) = match side {
        Side::Right => (
            &[
                " The Jacobian of the derivative times a direction: how the derivative changes where the state",
                " changes along `direction`, and the inputs along `input_direction`.",
            ],
            quote!(#state_type),
        ),
        Side::Left => (
            &[
                " The transpose of the Jacobian of the derivative times `weights`: the derivatives by the state,",
                " and by the inputs, of the sum of the components of ẋ with these weights.",
            ],
            quote!((#state_type, #input_type)),
        ),
    };
    let name = Ident::new(side.word(), Span::call_site());
    quote! {
        #(#[doc = #doc])*
        #[must_use]
        #[inline]
        #visibility fn #name(
            &self, #t: #scalar, #state: &#state_type, #input: &#input_type, #(#parameters),*
        ) -> #returns {
            #drops
            #body
        }
    }
}

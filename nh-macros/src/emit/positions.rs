//! The return to position constraints: what `project` does first, and how integrators ask for it.

use nonholonomic_core::functions::RESIDUAL;
use nonholonomic_core::id::SymbolId;
use nonholonomic_core::program::Program;
use nonholonomic_core::system::{PositionReturn, System};
use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::infix::element;
use super::layout::local;
use super::place::Place;
use super::program::body;
use super::projection::step_of_velocities;
use super::results::residual_names;
use super::setting::Context;
use super::symbols::{Argument, Scope};

/// `|present| { … }`: outputs of a program, in the array of the coordinates, or of the velocities.
pub(super) fn in_array(
    context: &Context,
    system: &System,
    moved: &[SymbolId],
    program: &Program,
) -> TokenStream {
    let present = local("present");
    let scope = Scope::new(context, &system.model, &system.state());
    let scope = scope.with_array(Argument::Present, &present, moved);
    let body = body(context, &scope, program);
    let argument = if body.used.contains(&Argument::Present) { quote!(#present) } else { quote!(_) };
    let (statements, outputs) = (&body.statements, body.outputs.iter().map(element));
    quote!(|#argument| { #statements [#(#outputs),*] })
}

/// The statement of `project` that moves the coordinates of `state`.
pub(super) fn iteration(context: &Context, system: &System, positions: &PositionReturn) -> TokenStream {
    let runtime = &context.runtime;
    let places = context.state.places(&context.locals.state);
    let coordinates = &places[..system.state_coordinates.len().min(places.len())];
    let place = Place::of(context, system, positions);
    let in_array = |program: &Program| in_array(context, system, &system.state_coordinates, program);
    let (change, residual) = (in_array(&place.change()), in_array(&place.residual()));
    quote!([#(#coordinates),*] = #runtime::newton([#(#coordinates),*], #change, #residual)?;)
}

/// What `impl Dynamics` says of position constraints; nothing without them.
pub(super) fn hooks(context: &Context, system: &System) -> TokenStream {
    let Some(positions) = &system.positions else { return TokenStream::new() };
    let Context { runtime, scalar, .. } = context;
    let (t, state, state_type) = (&context.locals.t, &context.locals.state, context.type_of(&context.state));
    let places = context.state.places(state);
    let (coordinates, rest) = places.split_at(system.state_coordinates.len().min(places.len()));
    let velocities = &rest[..system.state_velocities.len().min(rest.len())];
    let change = Place::of(context, system, positions).change();
    let change = in_array(context, system, &system.state_coordinates, &change);
    let of_velocities = step_of_velocities(context, system)
        .map(|step| quote!([#(#velocities),*] = #runtime::first_iterate([#(#velocities),*], #step);));
    let count = system.functions.get(&RESIDUAL).map_or(0, |residual| residual.outputs.len());
    let count = Literal::usize_unsuffixed(count);
    let body = super::near_return::body_of_return(context, system, positions);
    let names = residual_names(system);
    let side = side(context, system, positions);
    let residuals = super::projection::entries(&local("residual"), names.len());
    let residual = local("residual");
    quote! {
        #[inline]
        fn has_positions(&self) -> ::core::primitive::bool { true }
        fn return_to_positions(
            &self, #t: #scalar, #state: &mut #state_type
        ) -> ::core::result::Result<#scalar, #runtime::ProjectionError> {
            #body
        }
        fn correct_positions(&self, #t: #scalar, #state: &mut #state_type) {
            _ = #t;
            [#(#coordinates),*] = #runtime::corrected([#(#coordinates),*], #change);
            #of_velocities
        }
        #side
        fn worst_constraint(&self, #t: #scalar, #state: &#state_type) -> #runtime::StateFault {
            let #residual: [#scalar; #count] =
                ::core::convert::From::from(Self::constraint_residual(self, #t, #state));
            #runtime::worst([#((#names, #residuals)),*])
        }
    }
}

/// The sign of what the constraints are divided by; nothing where they are divided by parameters alone.
fn side(context: &Context, system: &System, positions: &PositionReturn) -> Option<TokenStream> {
    if positions.pivots.outputs.is_empty() {
        return None;
    }
    let Context { runtime, scalar, .. } = context;
    let (t, state, state_type) = (&context.locals.t, &context.locals.state, context.type_of(&context.state));
    let scope = Scope::new(context, &system.model, &system.state());
    let body = body(context, &scope, &context.lowering.program(&system.model, &positions.pivots));
    let (statements, outputs) = (&body.statements, body.outputs.iter().map(element));
    Some(quote! {
        fn side(&self, #t: #scalar, #state: &#state_type) -> #scalar {
            _ = (self, #t, #state);
            #statements
            #runtime::product_of_signs([#(#outputs),*])
        }
    })
}

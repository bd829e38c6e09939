//! The return to position constraints: what `project` does first, and how integrators ask for it.

use nonholonomic_core::functions::RESIDUAL;
use nonholonomic_core::mechanics::Procedure;
use nonholonomic_core::system::{PositionReturn, System};
use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::infix::element;
use super::layout::local;
use super::program::body;
use super::projection::{Way, closure, velocities};
use super::results::residual_names;
use super::setting::Context;
use super::symbols::{Argument, Scope};

/// `|present| { … }`: outputs of a procedure, in the array of the coordinates.
fn of_coordinates(context: &Context, system: &System, procedure: &Procedure) -> TokenStream {
    let present = local("present");
    let scope = Scope::new(context, &system.model, &system.state()).with_array(
        Argument::Present,
        &present,
        &system.state_coordinates,
    );
    let body = body(context, &scope, &context.lowering.program(&system.model, procedure));
    let argument = if body.used.contains(&Argument::Present) { quote!(#present) } else { quote!(_) };
    let (statements, outputs) = (&body.statements, body.outputs.iter().map(element));
    quote!(|#argument| { #statements [#(#outputs),*] })
}

/// The statement of `project` that moves the coordinates of `state`.
pub(super) fn iteration(context: &Context, system: &System, positions: &PositionReturn) -> TokenStream {
    iteration_from(context, system, positions, None)
}

/// The same, with the residuals if they are known.
fn iteration_from(
    context: &Context,
    system: &System,
    positions: &PositionReturn,
    known: Option<&[TokenStream]>,
) -> TokenStream {
    let runtime = &context.runtime;
    let places = context.state.places(&context.locals.state);
    let coordinates = &places[..system.state_coordinates.len().min(places.len())];
    let change = of_coordinates(context, system, &positions.step);
    let residual = of_coordinates(context, system, &positions.residual);
    let start = quote!([#(#coordinates),*]);
    match known {
        None => quote!(#start = #runtime::newton(#start, #change, #residual)?;),
        Some(known) => {
            quote!(#start = #runtime::newton_from((#start, [#(#known),*]), #change, #residual)?;)
        }
    }
}

/// The body of `return_to_positions`: `project` for states that are near to the constraints, with one look at these where
/// nothing has to move.
fn body_of_return(context: &Context, system: &System, positions: &PositionReturn) -> TokenStream {
    let Context { runtime, scalar, .. } = context;
    let (t, state) = (&context.locals.t, &context.locals.state);
    let (residual, given) = (local("residual"), local("given"));
    let count = system.functions.get(&RESIDUAL).map_or(0, |residual| residual.outputs.len());
    let literal = Literal::usize_unsuffixed(count);
    let moves = if system.embedding.is_some() {
        // identities of the base do not stand among the residuals
        quote!(Self::project(self, #t, #state)?;)
    } else {
        let known = super::projection::entries(&residual, positions.count);
        let of_positions = iteration_from(context, system, positions, Some(&known));
        let of_velocities =
            system.projection.as_ref().map(|projection| velocities(context, system, projection, Way::Short));
        quote! {
            if !#runtime::holds(&#residual) {
                let #given = #state;
                let mut #state = *#given;
                #of_positions
                #of_velocities
                *#given = #state;
            }
        }
    };
    quote! {
        let #residual: [#scalar; #literal] =
            ::core::convert::From::from(Self::constraint_residual(self, #t, #state));
        #moves
        ::core::result::Result::Ok(#runtime::largest(&#residual))
    }
}

/// What `impl Dynamics` says of position constraints; nothing without them.
pub(super) fn hooks(context: &Context, system: &System) -> TokenStream {
    let Some(positions) = &system.positions else { return TokenStream::new() };
    let Context { runtime, scalar, .. } = context;
    let (t, state, state_type) = (&context.locals.t, &context.locals.state, context.type_of(&context.state));
    let places = context.state.places(state);
    let (coordinates, rest) = places.split_at(system.state_coordinates.len().min(places.len()));
    let velocities = &rest[..system.state_velocities.len().min(rest.len())];
    let change = of_coordinates(context, system, &positions.step);
    let of_velocities = system.projection.as_ref().map(|projection| {
        let step = closure(
            context,
            system,
            &projection.start,
            &system.state_velocities,
            &context.lowering.program(&system.model, &projection.step),
        );
        quote!([#(#velocities),*] = #runtime::first_iterate([#(#velocities),*], #step);)
    });
    let count = system.functions.get(&RESIDUAL).map_or(0, |residual| residual.outputs.len());
    let count = Literal::usize_unsuffixed(count);
    let body = body_of_return(context, system, positions);
    let names = residual_names(system);
    let side = side(context, system, positions);
    let residuals = super::projection::entries(&local("residual"), names.len());
    let residual = local("residual");
    quote! {
        #[inline]
        fn has_positions(&self) -> bool { true }
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

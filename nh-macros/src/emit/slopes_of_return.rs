//! The derivatives of one step back to position constraints, of positions and then of velocities: `return_jacobian` of
//! `impl Jacobian`.

use nonholonomic_core::id::SymbolId;
use nonholonomic_core::mechanics::Procedure;
use nonholonomic_core::system::System;
use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use super::infix::element;
use super::layout::local;
use super::program::body;
use super::setting::Context;
use super::symbols::{Argument, Scope};

/// The method of the trait; nothing without position constraints.
pub(super) fn method(context: &Context, system: &System) -> Option<TokenStream> {
    let positions = system.positions.as_ref()?;
    let slopes = positions.slopes.as_ref()?;
    let Context { runtime, scalar, .. } = context;
    let (t, state, state_type) = (&context.locals.t, &context.locals.state, context.type_of(&context.state));
    let places = context.state.places(state);
    let (coordinates, rest) = places.split_at(system.state_coordinates.len().min(places.len()));
    let velocities = &rest[..system.state_velocities.len().min(rest.len())];
    let all = Literal::usize_unsuffixed(places.len());
    let [present, moved, of_positions, of_velocities] =
        ["present", "moved", "of_positions", "of_velocities"].map(local);
    let at = |procedure: &Procedure, argument: &Ident, width: usize| {
        let scope = Scope::new(context, &system.model, &system.state());
        let scope = scope.with_array(Argument::Present, argument, &system.state_coordinates);
        of_array(context, system, procedure, (scope, argument), width)
    };
    let start = quote!([#(#coordinates),*]);
    let by_coordinates = at(&slopes.positions, &present, places.len());
    let (moves, by_velocities) = if let Some(by) = &slopes.velocities {
        let change = at(&positions.step, &present, 1);
        // where a projection starts are the velocities of the state
        let started = system.projection.iter().flat_map(|projection| &projection.start);
        let started: Vec<SymbolId> = started.copied().collect();
        let scope = Scope::new(context, &system.model, &system.state())
            .with_places(Argument::State, &started, velocities.to_vec())
            .with_array(Argument::Present, &moved, &system.state_coordinates);
        let width = places.len() + started.len();
        let by = of_array(context, system, by, (scope, &moved), width);
        let moves = quote!(let #moved = #runtime::corrected(#start, #change););
        (moves, quote!((#by)(&#moved)))
    } else {
        let width = all.clone();
        (TokenStream::new(), quote!([[<#scalar as #runtime::Scalar>::ZERO; #width]; 0]))
    };
    Some(quote! {
        fn return_jacobian(&self, #t: #scalar, #state: &#state_type) -> [[#scalar; #all]; #all] {
            _ = (self, #t);
            let #of_positions = (#by_coordinates)(&#start);
            #moves
            let #of_velocities = #by_velocities;
            #runtime::slopes_of_return(&#of_positions, &#of_velocities)
        }
    })
}

/// `|present| { … }`: outputs of a procedure of the coordinates in an array, in rows of a length where that is not 1.
fn of_array(
    context: &Context,
    system: &System,
    procedure: &Procedure,
    (scope, argument): (Scope, &Ident),
    width: usize,
) -> TokenStream {
    let scalar = &context.scalar;
    let body = body(context, &scope, &context.lowering.program(&system.model, procedure));
    let name = if body.used.contains(&Argument::Present) { quote!(#argument) } else { quote!(_) };
    let count = Literal::usize_unsuffixed(system.state_coordinates.len());
    let (statements, outputs) = (&body.statements, body.outputs.iter().map(element));
    let outputs: Vec<TokenStream> = if width == 1 {
        outputs.collect()
    } else {
        let outputs: Vec<TokenStream> = outputs.collect();
        outputs.chunks(width).map(|row| quote!([#(#row),*])).collect()
    };
    quote!(|#name: &[#scalar; #count]| { #statements [#(#outputs),*] })
}

//! The body of `return_to_positions`: what is computed at one place is one program, in branches.

use nonholonomic_core::functions::RESIDUAL;
use nonholonomic_core::system::{PositionReturn, System};
use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::infix::element;
use super::layout::local;
use super::place::Place;
use super::program::{Body, body_in_branches};
use super::setting::Context;
use super::symbols::Scope;

/// `project` for states that are near to the constraints: residuals at a place, and there the change of positions, or of
/// velocities, with everything that these have in common. Where nothing has to move it is one look at the constraints.
pub(super) fn body_of_return(context: &Context, system: &System, positions: &PositionReturn) -> TokenStream {
    if system.embedding.is_some() {
        // identities of the base do not stand among the residuals
        return by_projection(context, system);
    }
    let Context { runtime, .. } = context;
    let (t, state) = (&context.locals.t, &context.locals.state);
    let places = context.state.places(state);
    let (coordinates, rest) = places.split_at(system.state_coordinates.len().min(places.len()));
    let velocities = &rest[..system.state_velocities.len().min(rest.len())];
    // 1. residuals of positions and velocities, then both changes
    let Place { program, counts, .. } = Place::of(context, system, positions);
    let scope = Scope::new(context, &system.model, &system.state());
    let angles = local("angles");
    let (look, changes, count) = body_in_branches(context, &scope, &program, (&counts, &angles));
    let from_first_place = (count > 0).then(|| {
        let count = Literal::usize_unsuffixed(count);
        quote!(let mut #angles = [#runtime::CloseAngle::none(); #count];)
    });
    // 2. what they lead to
    let array = |outputs: &[TokenStream]| {
        let outputs = outputs.iter().map(element);
        quote!([#(#outputs),*])
    };
    let (of_positions, of_velocities) = look.outputs.split_at(positions.count.min(look.outputs.len()));
    let (of_positions, of_velocities) = (array(of_positions), array(of_velocities));
    let (way, next) = (local("way"), local("next"));
    let moves = |change: &Body, moved: &[TokenStream], how: &TokenStream| {
        let (statements, change) = (&change.statements, array(&change.outputs));
        quote!(#statements [#(#moved),*] = #way.#how([#(#moved),*], #change);)
    };
    let moves_positions = changes.first().map(|change| moves(change, coordinates, &quote!(positions)));
    let moves_velocities = match changes.get(1) {
        Some(change) => Some(moves(change, velocities, &quote!(velocities))),
        None => super::projection::velocities(context, system),
    };
    let (statements, given) = (&look.statements, local("given"));
    quote! {
        let #given = #state;
        let mut #state = *#given;
        #from_first_place
        let mut #way = #runtime::NearReturn::from(&[#(#coordinates),*]);
        loop {
            #statements
            let #next = #way.next(&#of_positions, &#of_velocities);
            // velocities first: what they are off is computed where the positions are
            if #next.moves_velocities() { #moves_velocities }
            if #next.moves_positions() { #moves_positions }
            if #next != #runtime::Next::Positions { break; }
        }
        #way.end(#given, #state, |#state| Self::project(self, #t, #state))
    }
}

/// The same by `project`.
fn by_projection(context: &Context, system: &System) -> TokenStream {
    let Context { runtime, scalar, .. } = context;
    let (t, state) = (&context.locals.t, &context.locals.state);
    let count = system.functions.get(&RESIDUAL).map_or(0, |residual| residual.outputs.len());
    let (count, residual) = (Literal::usize_unsuffixed(count), local("residual"));
    quote! {
        let #residual: [#scalar; #count] =
            ::core::convert::From::from(Self::constraint_residual(self, #t, #state));
        Self::project(self, #t, #state)?;
        ::core::result::Result::Ok(#runtime::largest(&#residual))
    }
}

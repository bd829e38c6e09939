//! The body of `return_to_positions`: looks at the constraints, and changes by what the first place was solved with.

use nonholonomic_core::functions::RESIDUAL;
use nonholonomic_core::program::Value;
use nonholonomic_core::system::{PositionReturn, System};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use super::infix::element;
use super::layout::local;
use super::place::Place;
use super::program::{Body, Writer};
use super::setting::Context;
use super::symbols::{Argument, Scope};

/// `project` for states that are near to the constraints: looks at these, and the changes of positions and velocities that the
/// factors of the first place make of what is left. Where nothing has to move it is one look.
pub(super) fn body_of_return(context: &Context, system: &System, positions: &PositionReturn) -> TokenStream {
    if system.embedding.is_some() {
        // identities of the base do not stand among the residuals
        return by_projection(context, system);
    }
    let Context { runtime, scalar, .. } = context;
    let (t, state) = (&context.locals.t, &context.locals.state);
    let places = context.state.places(state);
    let (coordinates, rest) = places.split_at(system.state_coordinates.len().min(places.len()));
    let velocities = &rest[..system.state_velocities.len().min(rest.len())];
    let place = Place::of(context, system, positions);
    let program = &*place.program.with_known_numbers();
    let (given, way) = (local("given"), local("way"));
    let (angles, open, moved) = (local("angles"), local("open"), local("moved"));
    let scope = Scope::new(context, &system.model, &system.state())
        .with_array(Argument::Open, &open, &place.open)
        .with_array(Argument::Moved, &moved, &place.moved);
    // 1. what is left here, and at the next places
    let mut here = Writer::new(context, &scope, program, Some(&angles));
    let mut there = here.clone();
    let (first, next) = (Look::written(&mut here, &place), Look::written(&mut there, &place));
    let [sizes, sizes_of_rates] = place.sizes();
    let Body { statements: beside, outputs: sizes, .. } = here.write(sizes);
    let sizes = array(&sizes);
    let size_of_rates = |writer: &Writer| {
        let Body { statements, outputs, .. } = writer.clone().write(sizes_of_rates);
        let sizes = array(&outputs);
        quote!({ #statements #sizes })
    };
    // 2. the changes, what they are solved with, and what they leave
    let (of_positions, of_velocities) = (place.change(), place.change_of_velocities());
    let nearby = place.nearby().concat();
    let several = [of_positions, of_velocities.unwrap_or_default(), &nearby].concat();
    let ahead = here.write_ahead(&several, &[place.open.as_slice(), &place.moved].concat());
    let mut count = here.angles;
    let mut written = |outputs: &[Value]| {
        let mut writer = here.clone();
        let Body { statements, outputs, .. } = writer.write(outputs);
        count = count.max(writer.angles);
        (statements, array(&outputs))
    };
    let [slopes, bends, turns] = place.nearby();
    let (change_statements, change) = written(of_positions);
    let (left_statements, nearby) = written(&[slopes, bends].concat());
    let (rates, sizes_here) = (&first.rates, size_of_rates(&here));
    let holds = quote!(#runtime::are_rounding::<#scalar, _>(&#rates, &#sizes_here));
    let moves_velocities = of_velocities.map(|of_velocities| {
        let (turn_statements, turns) = written(turns);
        let (statements, change) = written(of_velocities);
        let sizes = size_of_rates(&here);
        quote! {
            if #way.has_foreseen() {
                #turn_statements
                #way.turns(&mut #open, &#turns, &#sizes);
            }
            #statements
            [#(#velocities),*] = #way.velocities([#(#velocities),*], #change);
        }
    });
    let is_held_up = of_velocities.map(|_| {
        let (rates, sizes) = (&next.rates, size_of_rates(&there));
        quote!(if #way.is_held_up_by(&#rates, &#sizes) { break; })
    });
    let by_themselves = match of_velocities {
        Some(_) => None,
        None => super::projection::velocities(context, system),
    };
    let by_themselves = by_themselves.map(|moves| quote!(if !#way.is_far() { #moves }));
    let at_hand = angles_at_hand(context, &angles, count);
    let Look { statements: look, of_positions, rates, open: left } = first;
    let Look { statements: next, of_positions: next_positions, open: next_left, .. } = next;
    let coordinate_count = Literal::usize_unsuffixed(coordinates.len());
    quote! {
        let #given = #state;
        let mut #state = *#given;
        #at_hand
        #look
        #beside
        let mut #way = #runtime::NearReturn::from(&#of_positions, &#rates, &#sizes);
        if !(#way.is_far() || (#way.holds() && #holds)) {
            let mut #open = #left;
            #ahead
            loop {
                let mut #moved = [<#scalar as #runtime::Scalar>::ZERO; #coordinate_count];
                while #way.moves_positions() {
                    #change_statements
                    #moved = #way.displaced(&[#(#coordinates),*], &#moved, &#change);
                    if #way.is_first() {
                        #left_statements
                        #way.foresees(&mut #open, &#nearby);
                    }
                }
                #moves_velocities
                [#(#coordinates),*] = #way.positions([#(#coordinates),*], #moved);
                if #way.ends() { break; }
                #next
                #open = #next_left;
                #way = #way.next(&[#(#coordinates),*], &#next_positions);
                #is_held_up
            }
            #by_themselves
        }
        #way.end(#given, #state, |#state| Self::project(self, #t, #state))
    }
}

/// The array of so many angles, before the first of them.
fn angles_at_hand(context: &Context, angles: &Ident, count: usize) -> Option<TokenStream> {
    let (runtime, length) = (&context.runtime, Literal::usize_unsuffixed(count));
    (count > 0).then(|| quote!(let mut #angles = [#runtime::CloseAngle::none(); #length];))
}

/// What is left of the equations at a place.
struct Look {
    statements: TokenStream,
    of_positions: TokenStream,
    rates: TokenStream,
    /// What changes are for.
    open: TokenStream,
}

impl Look {
    fn written(writer: &mut Writer, place: &Place) -> Self {
        let look = place.look();
        let Body { statements, outputs, .. } = writer.write(&look.concat());
        let (of_positions, rest) = outputs.split_at(look[0].len().min(outputs.len()));
        let (rates, open) = rest.split_at(look[1].len().min(rest.len()));
        Self { statements, of_positions: array(of_positions), rates: array(rates), open: array(open) }
    }
}

fn array(outputs: &[TokenStream]) -> TokenStream {
    let outputs = outputs.iter().map(element);
    quote!([#(#outputs),*])
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

//! The way back to where a state belongs: base coordinates to their identities, velocities to the
//! constraints.

use nonholonomic_core::functions::{RESIDUAL, Record};
use nonholonomic_core::id::SymbolId;
use nonholonomic_core::program::Program;
use nonholonomic_core::system::System;
use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use super::infix::element;
use super::inherent_method::Part;
use super::layout::local;
use super::place::Place;
use super::program::body;
use super::results::Results;
use super::setting::Context;
use super::symbols::{Argument, Scope};

/// The inherent method `project`, and `impl Constrained for Sleigh`; nothing where every state is
/// where it belongs.
pub(super) fn emit(context: &Context, system: &System) -> Part {
    let mut part = Part::default();
    let mut constraints = None;
    let count = system.functions.get(&RESIDUAL).map_or(0, |residual| residual.outputs.len());
    if count > 0 && (system.projection.is_some() || system.positions.is_some()) {
        part.methods = method(context, system);
        let place = system.positions.as_ref().map(|positions| Place::of(context, system, positions));
        let of_positions = place.as_ref().map(Place::change);
        let projection = system.projection.as_ref();
        let of_velocities = projection
            .map(|projection| context.lowering.program(&system.model, &projection.step))
            .or_else(|| place.as_ref()?.change_of_velocities());
        part.programs.extend(of_positions.map(|step| ("project, each step of positions", step)));
        part.programs.extend(of_velocities.map(|step| ("project, each step", step)));
        constraints = Some(count);
    }
    let identities = system.embedding.as_ref().map(|embedding| embedding.texts.as_slice());
    if identities.is_some() || constraints.is_some() {
        let results = Results::of(context, system);
        let residual = results.get(context, Record::Residual).filter(|_| constraints.is_some());
        let names: Vec<&String> = identities
            .into_iter()
            .flatten()
            .chain(residual.into_iter().flat_map(super::record::Record::names))
            .collect();
        let counts = [identities.map_or(0, <[_]>::len), constraints.unwrap_or(0)];
        part.items = implementation(context, counts, &constraint_names(&names));
    }
    part
}

/// The same methods with nothing to do.
pub(super) fn stub(context: &Context, identities: usize, constraints: usize) -> Part {
    let mut part = Part::default();
    let (t, state) = (&context.locals.t, &context.locals.state);
    if constraints > 0 {
        part.methods = with_body(context, What::default(), &quote!(_ = (self, #t, #state);));
    }
    if identities + constraints > 0 {
        part.items = implementation(context, [identities, constraints], &TokenStream::new());
    }
    part
}

/// The inherent method: coordinates first, then velocities.
fn method(context: &Context, system: &System) -> TokenStream {
    let state = &context.locals.state;
    let of_velocities = velocities(context, system);
    let of_positions = system.positions.as_ref().map(|p| super::positions::iteration(context, system, p));
    let normalize = system.embedding.as_ref().map(|_| quote!(Self::normalize(self, &mut #state)?;));
    let what = What { normalizes: normalize.is_some(), returns: of_positions.is_some() };
    if normalize.is_none() && (of_positions.is_none() || of_velocities.is_none()) {
        let body = of_positions.or(of_velocities);
        return with_body(context, what, &quote!(#body));
    }
    // the anchor keeps identities to first order: what is left of them goes, and what that moves comes back, until nothing
    // but rounding moves
    let (before, runtime, places) = (local("before"), &context.runtime, context.state.places(state));
    let coordinates = &places[..system.state_coordinates.len().min(places.len())];
    let returns = if of_positions.is_some() && normalize.is_some() {
        quote! {
            for _ in 0..#runtime::MOST_RETURNS {
                let #before = [#(#coordinates),*];
                #normalize
                #of_positions
                if #runtime::stays(&#before, &[#(#coordinates),*]) { break; }
            }
        }
    } else {
        quote!(#normalize #of_positions)
    };
    let given = local("given");
    let body = quote! {
        let #given = #state;
        let mut #state = *#given;
        #returns
        #of_velocities
        *#given = #state;
    };
    with_body(context, what, &body)
}

/// `|start, present| { … }`: the velocities after a step; nothing where they stay.
pub(super) fn step_of_velocities(context: &Context, system: &System) -> Option<TokenStream> {
    if let Some(projection) = &system.projection {
        let step = context.lowering.program(&system.model, &projection.step);
        return Some(closure(context, system, &projection.start, &system.state_velocities, &step));
    }
    let change = Place::of(context, system, system.positions.as_ref()?).change_of_velocities()?;
    let change = super::positions::in_array(context, system, &system.state_velocities, &change);
    let (runtime, start) = (&context.runtime, local("start"));
    Some(quote!(|#start, _| #runtime::corrected(*#start, #change)))
}

/// The statement that moves the velocities of `state`; nothing where they stay.
pub(super) fn velocities(context: &Context, system: &System) -> Option<TokenStream> {
    let (runtime, t, state) = (&context.runtime, &context.locals.t, &context.locals.state);
    let step = step_of_velocities(context, system)?;
    let present = local("present");
    let places = context.state.places(state);
    let (coordinates, rest) = places.split_at(system.state_coordinates.len().min(places.len()));
    let (velocities, auxiliary) = rest.split_at(system.state_velocities.len().min(rest.len()));
    let mut moved = coordinates.to_vec();
    moved.extend(entries(&present, velocities.len()));
    moved.extend_from_slice(auxiliary);
    let moved = context.state.construct(&context.state_name(), &moved);
    let residual = quote!(::core::convert::From::from(Self::constraint_residual(self, #t, &#moved)));
    let of_positions = system.positions.as_ref().map_or(0, |positions| positions.count);
    let residual = if of_positions == 0 {
        residual
    } else {
        let count = system.functions.get(&RESIDUAL).map_or(0, |residual| residual.outputs.len());
        let rates: Vec<Ident> =
            (of_positions..count).map(|index| local(&format!("residual_{}", index + 1))).collect();
        let skipped = (0..of_positions).map(|_| quote!(_));
        let (count, scalar) = (Literal::usize_unsuffixed(count), &context.scalar);
        quote!({ let [#(#skipped,)* #(#rates),*]: [#scalar; #count] = #residual; [#(#rates),*] })
    };
    Some(quote! {
        [#(#velocities),*] = #runtime::project([#(#velocities),*], #step, |#present| #residual)?;
    })
}

/// What `project` does beside moving velocities.
#[derive(Clone, Copy, Default)]
struct What {
    normalizes: bool,
    returns: bool,
}

/// `project` with a body; the base coordinates may have to be normalized.
fn with_body(context: &Context, what: What, body: &TokenStream) -> TokenStream {
    let Context { runtime, visibility, scalar, .. } = context;
    let (t, state, state_type) = (&context.locals.t, &context.locals.state, context.type_of(&context.state));
    let first = what.normalizes.then(|| quote!(#[doc = " The base coordinates are normalized first."]));
    let text = if what.returns {
        [
            " Moves the base coordinates to where the position constraints hold, by steps along the anchor that are the",
            " least where distance is measured by the kinetic energy, and then the velocities to the constraints there.",
        ]
    } else {
        [
            " Moves the velocities to the nearest ones that satisfy the constraints, where distance is",
            " measured by the kinetic energy.",
        ]
    };
    quote! {
        #(#[doc = #text])*
        #first
        ///
        /// # Errors
        /// If the constraints are not met, because the state is too far from them or they are
        /// dependent there; the state is then as it was.
        #visibility fn project(
            &self, #t: #scalar, #state: &mut #state_type
        ) -> ::core::result::Result<(), #runtime::ProjectionError> {
            #body
            ::core::result::Result::Ok(())
        }
    }
}

/// `|start, present| { … }`: a step of an iteration, in arrays of the moved components.
pub(super) fn closure(
    context: &Context,
    system: &System,
    started: &[SymbolId],
    moved: &[SymbolId],
    step: &Program,
) -> TokenStream {
    let (start, present) = (local("start"), local("present"));
    let scope = Scope::new(context, &system.model, &system.state())
        .with_array(Argument::Start, &start, started)
        .with_array(Argument::Present, &present, moved);
    let step = body(context, &scope, step);
    let name = |argument: Argument, ident: &Ident| {
        if step.used.contains(&argument) { quote!(#ident) } else { quote!(_) }
    };
    let (start, present) = (name(Argument::Start, &start), name(Argument::Present, &present));
    let (statements, outputs) = (&step.statements, step.outputs.iter().map(element));
    quote!(|#start, #present| { #statements [#(#outputs),*] })
}

/// `present[0]`, `present[1]`, …
pub(super) fn entries(array: &Ident, count: usize) -> Vec<TokenStream> {
    let entries = (0..count).map(|index| {
        let index = Literal::usize_unsuffixed(index);
        quote!(#array[#index])
    });
    entries.collect()
}

/// `constraint_names`, in the order of the residuals.
fn constraint_names(names: &[&String]) -> TokenStream {
    let count = Literal::usize_unsuffixed(names.len());
    quote! {
        fn constraint_names() -> [&'static ::core::primitive::str; #count] { [#(#names),*] }
    }
}

/// `impl Constrained for Sleigh`, with the identities of the base before the constraints.
fn implementation(
    context: &Context,
    [identities, constraints]: [usize; 2],
    names: &TokenStream,
) -> TokenStream {
    let Context { runtime, scalar, .. } = context;
    let (t, state, state_type) = (&context.locals.t, &context.locals.state, context.type_of(&context.state));
    let count = Literal::usize_unsuffixed(identities + constraints);
    let of_identities = quote!(Self::identity_residual(self, #state));
    let of_constraints = quote!(::core::convert::From::from(Self::constraint_residual(self, #t, #state)));
    let project = if constraints > 0 {
        quote!(Self::project(self, #t, #state))
    } else {
        quote!(_ = #t; Self::normalize(self, #state))
    };
    let residual = match (identities, constraints) {
        (_, 0) => quote!(_ = #t; #of_identities),
        (0, _) => of_constraints,
        _ => {
            let names = |prefix: &str, count: usize| -> Vec<Ident> {
                (1..=count).map(|index| local(&format!("{prefix}{index}"))).collect()
            };
            let (first, second) = (names("identity_", identities), names("constraint_", constraints));
            let second_count = Literal::usize_unsuffixed(constraints);
            quote! {
                let [#(#first),*] = #of_identities;
                let [#(#second),*]: [#scalar; #second_count] = #of_constraints;
                [#(#first,)* #(#second),*]
            }
        }
    };
    let body = quote! {
        type Constraints = #runtime::D<#count>;
        #[inline]
        fn constraint_residual(&self, #t: #scalar, #state: &#state_type) -> [#scalar; #count] { #residual }
        #names
        #[inline]
        fn project(
            &self, #t: #scalar, #state: &mut #state_type
        ) -> ::core::result::Result<(), #runtime::ProjectionError> { #project }
    };
    context.implement(&quote!(#runtime::Constrained), &body)
}

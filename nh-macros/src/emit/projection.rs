//! The way back to where a state belongs: base coordinates to their identities, velocities to the
//! constraints.

use nonholonomic_core::functions::RESIDUAL;
use nonholonomic_core::id::SymbolId;
use nonholonomic_core::program::Program;
use nonholonomic_core::system::{Projection, System};
use proc_macro2::{Ident, Literal, TokenStream};
use quote::quote;

use super::context::Context;
use super::expression::element;
use super::function::{Part, program};
use super::layout::local;
use super::program::body;
use super::scope::{Argument, Scope};

/// The inherent method `project`, and `impl Constrained for Sleigh`; nothing where every state is
/// where it belongs.
pub(super) fn emit(context: &Context, system: &System) -> Part {
    let mut part = Part::default();
    let mut constraints = None;
    let count = system.functions.get(&RESIDUAL).map_or(0, |residual| residual.outputs.len());
    if let (Some(projection), true) = (&system.projection, count > 0) {
        let step = program(&system.model, &projection.step);
        part.methods = method(context, system, projection, &step);
        part.programs.push(("project, each step", step));
        constraints = Some(count);
    }
    let identities = system.embedding.as_ref().map(|embedding| embedding.texts.len());
    if constraints.or(identities).is_some() {
        part.items = implementation(context, identities.unwrap_or(0), constraints.unwrap_or(0));
    }
    part
}

/// The same methods with nothing to do.
pub(super) fn stub(context: &Context, identities: usize, constraints: usize) -> Part {
    let mut part = Part::default();
    let (t, state) = (&context.locals.t, &context.locals.state);
    if constraints > 0 {
        part.methods = with_body(context, false, &quote!(_ = (self, #t, #state);));
    }
    if identities + constraints > 0 {
        part.items = implementation(context, identities, constraints);
    }
    part
}

/// The inherent method.
fn method(context: &Context, system: &System, projection: &Projection, step: &Program) -> TokenStream {
    let (runtime, t, state) = (&context.runtime, &context.locals.t, &context.locals.state);
    let present = local("present");
    let places = context.state.places(state);
    let coordinates = places.len().saturating_sub(system.state_velocities.len());
    let velocities = &places[coordinates..];
    let mut moved = places[..coordinates].to_vec();
    moved.extend(entries(&present, velocities.len()));
    let moved = context.state.construct(&context.state_name(), &moved);
    let step = closure(context, system, &projection.start, &system.state_velocities, step);
    let iteration = quote! {
        [#(#velocities),*] = #runtime::project(
            [#(#velocities),*],
            #step,
            |#present| ::core::convert::From::from(Self::constraint_residual(self, #t, &#moved)),
        )?;
    };
    if system.embedding.is_none() {
        return with_body(context, false, &iteration);
    }
    let given = local("given");
    let body = quote! {
        let #given = #state;
        let mut #state = *#given;
        Self::normalize(self, &mut #state)?;
        #iteration
        *#given = #state;
    };
    with_body(context, true, &body)
}

/// `project` with a body; the base coordinates may have to be normalized.
fn with_body(context: &Context, normalizes: bool, body: &TokenStream) -> TokenStream {
    let Context { runtime, visibility, scalar, .. } = context;
    let (t, state, state_type) = (&context.locals.t, &context.locals.state, context.type_of(&context.state));
    let first = normalizes.then(|| quote!(#[doc = " The base coordinates are normalized first."]));
    quote! {
        /// Moves the velocities to the nearest ones that satisfy the constraints, where distance is
        /// measured by the kinetic energy.
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

/// `impl Constrained for Sleigh`, with the identities of the base before the constraints.
fn implementation(context: &Context, identities: usize, constraints: usize) -> TokenStream {
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
        #[inline]
        fn project(
            &self, #t: #scalar, #state: &mut #state_type
        ) -> ::core::result::Result<(), #runtime::ProjectionError> { #project }
    };
    context.implement(&quote!(#runtime::Constrained), &body)
}

//! The identities of an embedded base: whether a state satisfies them, and the way back.

use nonholonomic_core::system::{Embedding, System};
use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::infix::element;
use super::inherent_method::Part;
use super::layout::local;
use super::program::body;
use super::projection::{closure, entries};
use super::setting::Context;
use super::symbols::{Argument, Scope};

/// The inherent methods `identity_residual` and `normalize`; nothing without identities.
pub(super) fn emit(context: &Context, scope: &Scope, system: &System) -> Part {
    let Some(embedding) = &system.embedding else { return Part::default() };
    let mut methods = residual(context, scope, system, embedding);
    methods.extend(normalize(context, system, embedding));
    let programs = vec![("normalize, each step", context.lowering.program(&system.model, &embedding.step))];
    Part { methods, programs, ..Part::default() }
}

/// The same methods with nothing to do.
pub(super) fn stub(context: &Context, identities: usize) -> Part {
    if identities == 0 {
        return Part::default();
    }
    let (runtime, scalar, state) = (&context.runtime, &context.scalar, &context.locals.state);
    let count = Literal::usize_unsuffixed(identities);
    let zeros = quote!([<#scalar as #runtime::Scalar>::ZERO; #count]);
    let mut methods = residual_with_body(context, &[], identities, &quote!(_ = (self, #state); #zeros));
    methods.extend(normalize_with_body(context, &quote!(_ = (self, #state);)));
    Part { methods, ..Part::default() }
}

fn residual(context: &Context, scope: &Scope, system: &System, embedding: &Embedding) -> TokenStream {
    let body = body(context, scope, &context.lowering.program(&system.model, &embedding.residual));
    let this = (!body.used.contains(&Argument::This)).then(|| quote!(_ = self;));
    let (statements, outputs) = (&body.statements, body.outputs.iter().map(element));
    let texts = &embedding.texts;
    residual_with_body(context, texts, texts.len(), &quote!(#this #statements [#(#outputs),*]))
}

fn residual_with_body(context: &Context, texts: &[String], count: usize, body: &TokenStream) -> TokenStream {
    let Context { visibility, scalar, .. } = context;
    let (state, state_type) = (&context.locals.state, context.type_of(&context.state));
    let count = Literal::usize_unsuffixed(count);
    let lines = texts.iter().map(|text| format!(" - `{text}`"));
    quote! {
        /// What the base coordinates leave of their identities:
        ///
        #(#[doc = #lines])*
        #[must_use]
        #[inline]
        #visibility fn identity_residual(&self, #state: &#state_type) -> [#scalar; #count] { #body }
    }
}

fn normalize(context: &Context, system: &System, embedding: &Embedding) -> TokenStream {
    let (runtime, state) = (&context.runtime, &context.locals.state);
    let symbols = &system.state_coordinates;
    let places = context.state.places(state);
    let (coordinates, velocities) = places.split_at(symbols.len().min(places.len()));
    let present = local("present");
    let mut moved = entries(&present, coordinates.len());
    moved.extend_from_slice(velocities);
    let moved = context.state.construct(&context.state_name(), &moved);
    let step =
        closure(context, system, &[], symbols, &context.lowering.program(&system.model, &embedding.step));
    let iteration = quote! {
        [#(#coordinates),*] = #runtime::project(
            [#(#coordinates),*],
            #step,
            |#present| Self::identity_residual(self, &#moved),
        )?;
    };
    normalize_with_body(context, &iteration)
}

fn normalize_with_body(context: &Context, body: &TokenStream) -> TokenStream {
    let Context { runtime, visibility, .. } = context;
    let (state, state_type) = (&context.locals.state, context.type_of(&context.state));
    quote! {
        /// Moves the base coordinates back to where their identities hold, by the shortest way.
        ///
        /// # Errors
        /// If they are too far from there; the state is then as it was.
        #visibility fn normalize(
            &self, #state: &mut #state_type
        ) -> ::core::result::Result<(), #runtime::ProjectionError> {
            #body
            ::core::result::Result::Ok(())
        }
    }
}

/// `check_state` of `impl Dynamics for Sleigh`: a state off the identities is refused.
pub(super) fn check_state(context: &Context, scope: &Scope, system: &System) -> TokenStream {
    let Some(embedding) = &system.embedding else { return TokenStream::new() };
    let Context { runtime, scalar, .. } = context;
    let (t, state, state_type) = (&context.locals.t, &context.locals.state, context.type_of(&context.state));
    let outputs = [embedding.step.outputs.as_slice(), &embedding.residual.outputs].concat();
    let both = embedding.step.with_outputs(outputs);
    let body = body(context, scope, &context.lowering.program(&system.model, &both));
    let (next, residuals) = body.outputs.split_at(embedding.step.outputs.len().min(body.outputs.len()));
    let this = (!body.used.contains(&Argument::This)).then(|| quote!(_ = self;));
    let places = context.state.places(state);
    let coordinates = places.iter().take(next.len());
    let (statements, next, texts) = (&body.statements, next.iter().map(element), &embedding.texts);
    quote! {
        fn check_state(
            &self, #t: #scalar, #state: &#state_type
        ) -> ::core::result::Result<(), #runtime::StateFault> {
            #this
            _ = #t;
            #statements
            #runtime::check_identities(
                [#(#coordinates),*],
                [#(#next),*],
                [#((#texts, #residuals)),*],
            )
        }
    }
}

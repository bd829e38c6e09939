//! The stated first integrals with their gradients.

use nonholonomic_core::model::Request;
use nonholonomic_core::system::System;
use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::infix::element;
use super::inherent_method::{Part, drops_of};
use super::program::body;
use super::setting::Context;
use super::symbols::{Argument, Scope};

/// `impl Invariants for Sleigh`, if it is asked for.
pub(super) fn emit(context: &Context, scope: &Scope, system: &System) -> Part {
    let Some(form) = &system.phase_space.invariants else { return Part::default() };
    let arguments = [Argument::This, Argument::Time, Argument::State];
    let (of_values, of_gradients) = (
        context.lowering.program(&system.model, &form.values),
        context.lowering.program(&system.model, &form.gradients),
    );
    let values = {
        let body = body(context, scope, &of_values);
        let (drops, statements) = (drops_of(context, &arguments, &body.used), &body.statements);
        let outputs = body.outputs.iter().map(element);
        quote!(#drops #statements [#(#outputs),*])
    };
    let gradients = {
        let body = body(context, scope, &of_gradients);
        let (drops, statements) = (drops_of(context, &arguments, &body.used), &body.statements);
        let rows = body.outputs.chunks(context.state.len().max(1)).map(|row| {
            let row = row.iter().map(element);
            quote!([#(#row),*])
        });
        quote!(#drops #statements [#(#rows),*])
    };
    let items = implementation(context, form.values.outputs.len(), &values, &gradients);
    Part {
        items,
        methods: TokenStream::new(),
        programs: vec![("invariants", of_values), ("invariant_gradients", of_gradients)],
    }
}

/// The same with one invariant that is zero: how many there are is not known.
pub(super) fn stub(context: &Context, requests: &[Request]) -> Part {
    if !requests.contains(&Request::Invariants) {
        return Part::default();
    }
    let (t, state) = (&context.locals.t, &context.locals.state);
    let nothing = quote!(_ = (self, #t, #state); ::core::default::Default::default());
    Part { items: implementation(context, 1, &nothing, &nothing), ..Part::default() }
}

fn implementation(
    context: &Context,
    count: usize,
    values: &TokenStream,
    gradients: &TokenStream,
) -> TokenStream {
    let Context { runtime, scalar, .. } = context;
    let (t, state, state_type) = (&context.locals.t, &context.locals.state, context.type_of(&context.state));
    let (k, n) = (Literal::usize_unsuffixed(count), Literal::usize_unsuffixed(context.state.len()));
    let body = quote! {
        type Count = #runtime::D<#k>;
        #[inline]
        fn invariants(&self, #t: #scalar, #state: &#state_type) -> [#scalar; #k] { #values }
        #[inline]
        fn invariant_gradients(&self, #t: #scalar, #state: &#state_type) -> [[#scalar; #n]; #k] {
            #gradients
        }
    };
    context.implement(&quote!(#runtime::Invariants), &body)
}

//! The equations that a step keeps by itself.

use nonholonomic_core::system::System;
use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::infix::element;
use super::inherent_method::{Part, drops_of};
use super::program::body;
use super::setting::Context;
use super::symbols::{Argument, Scope};

/// `impl Holding for Sleigh`, if a method is asked for that needs it.
pub(super) fn emit(context: &Context, scope: &Scope, system: &System) -> Part {
    let Some(form) = &system.phase_space.held else { return Part::default() };
    let arguments = [Argument::This, Argument::Time, Argument::State];
    let (count, width) = (form.functions.len(), context.state.len());
    let values = form.map.outputs.iter().take(count).copied().collect();
    let others = form.map.outputs.iter().skip(count).copied().collect();
    let of_values = context.lowering.program(&system.model, &form.map.with_outputs(values));
    let of_others = context.lowering.program(&system.model, &form.map.with_outputs(others));
    let residuals = {
        let body = body(context, scope, &of_values);
        let (drops, statements) = (drops_of(context, &arguments, &body.used), &body.statements);
        let (runtime, scalar) = (&context.runtime, &context.scalar);
        let zero = quote!(<#scalar as #runtime::Scalar>::ZERO);
        let outputs = body.outputs.iter().map(element).chain((count..width).map(|_| zero.clone()));
        quote!(#drops #statements [#(#outputs),*])
    };
    let runtime = &context.runtime;
    let held = {
        let body = body(context, scope, &of_others);
        let (drops, statements) = (drops_of(context, &arguments, &body.used), &body.statements);
        let rows = body.outputs.chunks(width.max(1)).map(|row| {
            let row = row.iter().map(element);
            quote!([#(#row),*])
        });
        let rows: Vec<TokenStream> = rows.collect();
        let (slopes, directions) = rows.split_at(count);
        quote!(#drops #statements #runtime::Held::new([#(#slopes),*], [#(#directions),*]))
    };
    let items = implementation(context, &held, &residuals);
    Part { items, methods: TokenStream::new(), programs: vec![("equations", of_values), ("held", of_others)] }
}

/// The same without equations.
pub(super) fn stub(context: &Context) -> Part {
    let (runtime, t, state) = (&context.runtime, &context.locals.t, &context.locals.state);
    let held = quote!(_ = (self, #t, #state); #runtime::Held::none());
    let residuals = quote!(_ = (self, #t, #state); ::core::default::Default::default());
    Part { items: implementation(context, &held, &residuals), ..Part::default() }
}

fn implementation(context: &Context, held: &TokenStream, residuals: &TokenStream) -> TokenStream {
    let Context { runtime, scalar, .. } = context;
    let (t, state, state_type) = (&context.locals.t, &context.locals.state, context.type_of(&context.state));
    let n = Literal::usize_unsuffixed(context.state.len());
    let body = quote! {
        #[inline]
        fn held(&self, #t: #scalar, #state: &#state_type) -> #runtime::Held<#state_type> { #held }
        #[inline]
        fn equations(&self, #t: #scalar, #state: &#state_type) -> [#scalar; #n] { #residuals }
    };
    context.implement(&quote!(#runtime::Holding), &body)
}

//! The system with what depends on parameters alone computed ahead.

use std::collections::BTreeSet;

use nonholonomic_core::model::Request;
use nonholonomic_core::program::{Program, Split};
use nonholonomic_core::system::System;
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use super::infix::element;
use super::inherent_method::{Part, drops};
use super::layout::local;
use super::motion::inlining;
use super::program::body;
use super::setting::{Context, copy_of_parameters};
use super::symbols::{Argument, Scope};

/// `PreparedSleigh` and `prepare`, if they are asked for.
pub(super) fn emit(context: &Context, system: &System, derivative: &Program) -> Part {
    let model = &system.model;
    if !model.requests.iter().any(|(asked, _)| *asked == Request::Prepared) {
        return Part::default();
    }
    let Split { ahead, rest, symbols } = context.lowering.split(model, &system.derivative, derivative);
    let in_state = system.state();
    let scope =
        Scope::new(context, model, &in_state).with_array(Argument::Values, &local("values"), &symbols);
    let (ahead_body, rest_body) = (body(context, &scope, &ahead), body(context, &scope, &rest));
    let values = ahead_body.outputs.iter().map(element);
    let statements = &ahead_body.statements;
    let unused = (!ahead_body.used.contains(&Argument::This)).then(|| quote!(_ = self;));
    let ahead_tokens = quote!(#unused #statements [#(#values),*]);
    let name = &context.state.name;
    let result = context.state.construct(&quote!(#name), &rest_body.outputs);
    let (statements, drops) = (&rest_body.statements, drops(context, &rest_body.used, true));
    let values = local("values");
    let unused = (!rest_body.used.contains(&Argument::Values)).then(|| quote!(_ = #values;));
    let rest_tokens = quote!(#drops #unused #statements #result);
    let mut part = items(context, symbols.len(), &ahead_tokens, (&inlining(&rest), &rest_tokens));
    part.programs = vec![("prepare", ahead), ("derivative, prepared", rest)];
    part
}

/// The same items with zeros.
pub(super) fn stub(context: &Context) -> Part {
    let values = local("values");
    let drops = drops(context, &BTreeSet::new(), true);
    let rest = quote!(#drops _ = #values; ::core::default::Default::default());
    items(context, 0, &quote!(_ = self; []), (&quote!(#[inline]), &rest))
}

/// The name of the type, `impl Prepare`, and the method that prepares.
fn items(
    context: &Context,
    count: usize,
    ahead: &TokenStream,
    (inlining, rest): (&TokenStream, &TokenStream),
) -> Part {
    let Context { runtime, scalar, visibility, layout, lints, .. } = context;
    let (t, state, input) = (&context.locals.t, &context.locals.state, &context.locals.input);
    let (state_type, input_type) = (context.type_of(&context.state), context.input_type());
    let name = &layout.name;
    let prepared = format_ident!("Prepared{name}");
    let (_, ty_generics, _) = context.generics.split_for_impl();
    let parameters = context.parameters_of_alias();
    let length = Literal::usize_unsuffixed(count);
    let values = local("values");
    let [doc, doc_of_prepare] = [
        format!(" [`{name}`] with what depends on its parameters alone computed ahead."),
        format!(" The same system as the [`{name}`] that it was made from, parameters included."),
    ];
    let copy = copy_of_parameters(context);
    let methods = quote! {
        #[doc = #doc_of_prepare]
        #[must_use]
        #[inline]
        #visibility fn prepare(&self) -> #runtime::Prepared<Self> {
            #runtime::Prepared::new(#copy)
        }
    };
    let implementation = context.implement(
        &quote!(#runtime::Prepare),
        &quote! {
            type Ahead = [#scalar; #length];
            #[inline]
            fn computed_ahead(&self) -> Self::Ahead {
                #ahead
            }
            #inlining
            fn derivative_from(
                &self, #values: &Self::Ahead, #t: #scalar, #state: &#state_type, #input: &#input_type
            ) -> #state_type {
                #rest
            }
        },
    );
    let items = quote! {
        #[doc = #doc]
        #lints
        #visibility type #prepared #parameters = #runtime::Prepared<#name #ty_generics>;
        #implementation
    };
    Part { methods, items, programs: Vec::new() }
}

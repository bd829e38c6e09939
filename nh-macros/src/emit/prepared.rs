//! The system with what depends on parameters alone computed ahead.

use std::collections::BTreeSet;

use nonholonomic_core::functions::ENERGY;
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
use super::setting::Context;
use super::symbols::{Argument, Scope};

/// `PreparedSleigh` and `prepare`, if they are asked for.
pub(super) fn emit(context: &Context, system: &System, derivative: &Program) -> Part {
    let model = &system.model;
    let requested = |request| model.requests.iter().any(|(asked, _)| *asked == request);
    if !requested(Request::Prepared) {
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
    let has_jacobian = system.model.requests.iter().any(|(request, _)| *request == Request::Jacobian);
    let has = [system.functions.get(&ENERGY).is_some(), has_jacobian];
    let mut part = items(context, symbols.len(), &ahead_tokens, (&inlining(&rest), &rest_tokens), has);
    part.programs = vec![("prepare", ahead), ("derivative, prepared", rest)];
    part
}

/// The same items with zeros.
pub(super) fn stub(context: &Context, has_jacobian: bool) -> Part {
    let values = local("values");
    let drops = drops(context, &BTreeSet::new(), true);
    let rest = quote!(#drops _ = #values; ::core::default::Default::default());
    items(context, 0, &quote!(_ = self; []), (&quote!(#[inline]), &rest), [true, has_jacobian])
}

/// The type, its traits, and the methods that make it.
fn items(
    context: &Context,
    count: usize,
    ahead: &TokenStream,
    (inlining, rest): (&TokenStream, &TokenStream),
    [has_energy, has_jacobian]: [bool; 2],
) -> Part {
    let Context { runtime, scalar, visibility, layout, lints, .. } = context;
    let (t, state, input) = (&context.locals.t, &context.locals.state, &context.locals.input);
    let (state_type, input_type) = (context.type_of(&context.state), context.input_type());
    let name = &layout.name;
    let prepared = format_ident!("Prepared{name}");
    let (impl_generics, ty_generics, where_clause) = context.generics.split_for_impl();
    let length = Literal::usize_unsuffixed(count);
    let values = local("values");
    let [doc, doc_of_prepare] = [
        format!(" [`{name}`] with what depends on its parameters alone computed ahead."),
        format!(" The same system as the [`{name}`] that it was made from, parameters included."),
    ];
    let methods = quote! {
        #[doc = #doc_of_prepare]
        #[must_use]
        #[inline]
        #visibility fn prepare(&self) -> #prepared #ty_generics {
            #prepared { system: *self, values: self.computed_ahead() }
        }
        /// What the derivative needs of the parameters alone.
        #[inline]
        fn computed_ahead(&self) -> [#scalar; #length] {
            #ahead
        }
        /// The derivative from what was computed ahead.
        #inlining
        fn derivative_from(
            &self, #values: &[#scalar; #length], #t: #scalar, #state: &#state_type, #input: &#input_type
        ) -> #state_type {
            #rest
        }
    };
    let result = |fault: TokenStream| quote!(::core::result::Result<(), #runtime::#fault>);
    let (parameters, of_state, of_input) =
        (result(quote!(ParameterError)), result(quote!(StateFault)), result(quote!(InputFault)));
    let mut items = quote! {
        #[doc = #doc]
        #[derive(::core::clone::Clone, ::core::marker::Copy)]
        #lints
        #visibility struct #prepared #impl_generics #where_clause {
            system: #name #ty_generics,
            values: [#scalar; #length],
        }
        #lints
        #[automatically_derived]
        impl #impl_generics #runtime::Dynamics for #prepared #ty_generics #where_clause {
            type State = #state_type;
            type Input = #input_type;
            #inlining
            fn derivative(&self, #t: #scalar, #state: &#state_type, #input: &#input_type) -> #state_type {
                self.system.derivative_from(&self.values, #t, #state, #input)
            }
            #[inline]
            fn validate(&self) -> #parameters {
                #runtime::Dynamics::validate(&self.system)
            }
            #[inline]
            fn check_state(&self, #t: #scalar, #state: &#state_type) -> #of_state {
                #runtime::Dynamics::check_state(&self.system, #t, #state)
            }
            #[inline]
            fn check_input(&self, #input: &#input_type) -> #of_input {
                #runtime::Dynamics::check_input(&self.system, #input)
            }
        }
    };
    if has_energy {
        items.extend(quote! {
            #lints
            #[automatically_derived]
            impl #impl_generics #runtime::Energy for #prepared #ty_generics #where_clause {
                #[inline]
                fn energy(&self, #t: #scalar, #state: &#state_type) -> #scalar {
                    #runtime::Energy::energy(&self.system, #t, #state)
                }
            }
        });
    }
    if has_jacobian {
        let (n, m) = (context.state.len(), context.input.as_ref().map_or(0, super::record::Record::len));
        let (n, m) = (Literal::usize_unsuffixed(n), Literal::usize_unsuffixed(m));
        items.extend(quote! {
            #lints
            #[automatically_derived]
            impl #impl_generics #runtime::Jacobian for #prepared #ty_generics #where_clause {
                type InputDim = #runtime::D<#m>;
                #[inline]
                fn state_jacobian(
                    &self, #t: #scalar, #state: &#state_type, #input: &#input_type
                ) -> [[#scalar; #n]; #n] {
                    #runtime::Jacobian::state_jacobian(&self.system, #t, #state, #input)
                }
                #[inline]
                fn input_jacobian(
                    &self, #t: #scalar, #state: &#state_type, #input: &#input_type
                ) -> [[#scalar; #m]; #n] {
                    #runtime::Jacobian::input_jacobian(&self.system, #t, #state, #input)
                }
            }
        });
    }
    Part { methods, items, programs: Vec::new() }
}

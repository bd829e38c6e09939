//! `validate`: every parameter is finite, and no parameter pivot is zero.

use nh_core::mechanics::Procedure;
use nh_core::system::System;
use proc_macro2::TokenStream;
use quote::quote;

use super::context::Context;
use super::function::program;
use super::layout::local;
use super::program::body;
use super::record::plain;
use super::scope::{Scope, parameter_places};

/// The inherent method `validate`.
pub(super) fn method(context: &Context, scope: &Scope, system: &System) -> TokenStream {
    let pivots = pivots(context, scope, system);
    with_body(context, &pivots)
}

/// The method, with what it does after the parameters are known to be finite.
pub(super) fn with_body(context: &Context, pivots: &TokenStream) -> TokenStream {
    let Context { runtime, visibility, .. } = context;
    let finite = finite(context);
    quote! {
        /// Checks the parameters.
        ///
        /// # Errors
        /// The first parameter that is not finite, or that makes an expression zero by which the
        /// equations divide.
        #visibility fn validate(&self) -> ::core::result::Result<(), #runtime::ParameterError> {
            #finite
            #pivots
            ::core::result::Result::Ok(())
        }
    }
}

/// Every scalar parameter is finite.
fn finite(context: &Context) -> TokenStream {
    let Context { runtime, .. } = context;
    let (name, value) = (local("name"), local("value"));
    let names = context.layout.parameters.iter().flat_map(|family| {
        let name = plain(&family.ident);
        family.entries().into_iter().map(move |entry| {
            let indices: String = entry.iter().map(|index| format!("[{index}]")).collect();
            format!("{name}{indices}")
        })
    });
    let pairs: Vec<_> =
        names.zip(parameter_places(context)).map(|(text, place)| quote!((#text, #place))).collect();
    if pairs.is_empty() {
        return quote!(_ = self;);
    }
    quote! {
        for (#name, #value) in [#(#pairs),*] {
            if !#runtime::Scalar::is_finite(#value) {
                return ::core::result::Result::Err(#runtime::ParameterError {
                    parameter: #name,
                    value: #runtime::Scalar::to_f64(#value),
                    fault: #runtime::ParameterFault::NotFinite,
                });
            }
        }
    }
}

/// No expression of parameters by which the equations divide is zero.
fn pivots(context: &Context, scope: &Scope, system: &System) -> TokenStream {
    let Context { runtime, scalar, .. } = context;
    let model = &system.model;
    let values = system.parameter_checks.iter().map(|check| check.nonzero).collect();
    let body = body(context, scope, &program(model, &Procedure::of(values)));
    let checks = system.parameter_checks.iter().zip(&body.outputs).map(|(check, value)| {
        let text = &check.text;
        let symbols = model.graph.symbols_in(&[check.nonzero]);
        let blamed = model.parameters.iter().find(|parameter| symbols.contains(&parameter.symbol));
        let (name, place) = match blamed.and_then(|parameter| scope.place(parameter.symbol)) {
            Some((_, place)) => (blamed.map_or("", |parameter| &parameter.name), place.clone()),
            None => ("", quote!(<#scalar as #runtime::Scalar>::ZERO)),
        };
        quote! {
            if !<#scalar as #runtime::Scalar>::all_ne(#value, <#scalar as #runtime::Scalar>::ZERO) {
                return ::core::result::Result::Err(#runtime::ParameterError {
                    parameter: #name,
                    value: #runtime::Scalar::to_f64(#place),
                    fault: #runtime::ParameterFault::ZeroPivot { expression: #text },
                });
            }
        }
    });
    let statements = &body.statements;
    quote!(#statements #(#checks)*)
}

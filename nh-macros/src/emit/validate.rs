//! `validate`: every parameter is finite, assumptions hold, and no parameter pivot is zero.

use nonholonomic_core::id::ExprId;
use nonholonomic_core::mechanics::Procedure;
use nonholonomic_core::model::{Model, Relation};
use nonholonomic_core::system::System;
use proc_macro2::TokenStream;
use quote::quote;

use super::context::Context;
use super::function::program;
use super::layout::{Family, local};
use super::program::body;
use super::scope::{Scope, parameter_places};

/// The inherent method `validate`.
pub(super) fn method(context: &Context, scope: &Scope, system: &System) -> TokenStream {
    let checks = checks(context, scope, system);
    with_body(context, &checks)
}

/// The method, with what it does after the parameters are known to be finite.
pub(super) fn with_body(context: &Context, checks: &TokenStream) -> TokenStream {
    let Context { runtime, visibility, .. } = context;
    let finite = finite(context);
    quote! {
        /// Checks the parameters.
        ///
        /// # Errors
        /// The first parameter that is not finite, that breaks an assumption, or that makes an
        /// expression zero by which the equations divide.
        #visibility fn validate(&self) -> ::core::result::Result<(), #runtime::ParameterError> {
            #finite
            #checks
            ::core::result::Result::Ok(())
        }
    }
}

/// Every scalar parameter is finite.
fn finite(context: &Context) -> TokenStream {
    let Context { runtime, .. } = context;
    let (name, value) = (local("name"), local("value"));
    let names = context.layout.parameters.iter().flat_map(Family::names);
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

/// Every assumption holds, and no expression of parameters by which the equations divide is zero.
fn checks(context: &Context, scope: &Scope, system: &System) -> TokenStream {
    let runtime = &context.runtime;
    let assumptions = &system.model.assumptions;
    let sides = assumptions.iter().flat_map(|assumption| [assumption.left, assumption.right]);
    let pivots = system.parameter_checks.iter().map(|check| check.nonzero);
    let procedure = Procedure::of(sides.chain(pivots).collect());
    let body = body(context, scope, &program(&system.model, &procedure));
    let (sides, pivots) = body.outputs.split_at((2 * assumptions.len()).min(body.outputs.len()));
    let mut tokens = body.statements.clone();
    for (assumption, sides) in assumptions.iter().zip(sides.chunks(2)) {
        let text = &assumption.text;
        let fault = quote!(#runtime::ParameterFault::Assumption { text: #text });
        let [left, right] = sides else { continue };
        let (method, first, second) = match assumption.relation {
            Relation::Less => (quote!(all_gt), right, left),
            Relation::LessOrEqual => (quote!(all_ge), right, left),
            Relation::Greater => (quote!(all_gt), left, right),
            Relation::GreaterOrEqual => (quote!(all_ge), left, right),
            Relation::NotEqual => (quote!(all_ne), left, right),
        };
        let blamed = &[assumption.left, assumption.right];
        tokens.extend(check(
            context,
            scope,
            &system.model,
            blamed,
            &quote!(#method(#first, #second)),
            &fault,
        ));
    }
    let zero = zero(context);
    for (pivot, value) in system.parameter_checks.iter().zip(pivots) {
        let text = &pivot.text;
        let fault = quote!(#runtime::ParameterFault::ZeroPivot { expression: #text });
        let holds = quote!(all_ne(#value, #zero));
        tokens.extend(check(context, scope, &system.model, &[pivot.nonzero], &holds, &fault));
    }
    tokens
}

/// Returns the error unless a condition holds; the first parameter in the expressions is blamed.
fn check(
    context: &Context,
    scope: &Scope,
    model: &Model,
    blamed: &[ExprId],
    holds: &TokenStream,
    fault: &TokenStream,
) -> TokenStream {
    let Context { runtime, scalar, .. } = context;
    let symbols = model.graph.symbols_in(blamed);
    let found = model.parameters.iter().find(|parameter| symbols.contains(&parameter.symbol));
    let (name, place) = match found.map(|parameter| (parameter, scope.place(parameter.symbol))) {
        Some((parameter, Some((_, place)))) => (parameter.name.as_str(), place.clone()),
        _ => ("", zero(context)),
    };
    quote! {
        if !<#scalar as #runtime::Scalar>::#holds {
            return ::core::result::Result::Err(#runtime::ParameterError {
                parameter: #name,
                value: #runtime::Scalar::to_f64(#place),
                fault: #fault,
            });
        }
    }
}

fn zero(context: &Context) -> TokenStream {
    let Context { runtime, scalar, .. } = context;
    quote!(<#scalar as #runtime::Scalar>::ZERO)
}

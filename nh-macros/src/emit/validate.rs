//! `validate`: every parameter is finite, assumptions hold, and no parameter pivot is zero.

use nonholonomic_core::id::{ExprId, Id};
use nonholonomic_core::mechanics::Procedure;
use nonholonomic_core::model::{Model, Relation};
use nonholonomic_core::system::System;
use proc_macro2::TokenStream;
use quote::quote;

use super::layout::{Family, local, plain};
use super::program::body;
use super::setting::Context;
use super::symbols::{Scope, parameter_places};

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

/// Every scalar parameter is finite. One that stands in no expression is not read, so that the compiler can say of
/// its field that nothing reads it.
fn finite(context: &Context) -> TokenStream {
    let Context { runtime, .. } = context;
    let (name, value) = (local("name"), local("value"));
    let layout = context.layout;
    let is_idle = |family: &Family| layout.idle.contains(&plain(&family.ident));
    let families = layout.parameters.iter();
    let names = families.flat_map(|family| family.names().into_iter().map(move |name| (family, name)));
    let pairs: Vec<_> = names
        .zip(parameter_places(context))
        .filter(|((family, _), _)| !is_idle(family))
        .map(|((_, text), place)| quote!((#text, #place)))
        .collect();
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
    let body = body(context, scope, &context.lowering.program(&system.model, &procedure));
    let (sides, pivots) = body.outputs.split_at((2 * assumptions.len()).min(body.outputs.len()));
    let mut tokens = symmetric(context, &system.model);
    tokens.extend(body.statements.clone());
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

/// Entries of symmetric matrices agree to 4 ε of the larger. A scalar that is a type parameter does not say its ε:
/// 3 (4/3 − 1) − 1 is ε in any binary arithmetic, since 4/3 is rounded once.
fn symmetric(context: &Context, model: &Model) -> TokenStream {
    let Context { runtime, scalar, .. } = context;
    let places = parameter_places(context);
    let number = quote!(<#scalar as #runtime::Scalar>);
    let epsilon = local("epsilon");
    let checks = model.symmetric.iter().filter_map(|(upper, lower)| {
        let (a, b) = (places.get(upper.index())?, places.get(lower.index())?);
        let (name, opposite) = (&model.parameters[*lower].name, &model.parameters[*upper].name);
        Some(quote! {
            if !#number::all_ge(
                #number::from_f64(4.0) * #epsilon * #number::max(#number::abs(#a), #number::abs(#b)),
                #number::abs(#a - #b),
            ) {
                return ::core::result::Result::Err(#runtime::ParameterError {
                    parameter: #name,
                    value: #runtime::Scalar::to_f64(#b),
                    fault: #runtime::ParameterFault::NotSymmetric { opposite: #opposite },
                });
            }
        })
    });
    let checks: Vec<TokenStream> = checks.collect();
    if checks.is_empty() {
        return TokenStream::new();
    }
    let (one, three) = (quote!(#number::ONE), quote!(#number::from_f64(3.0)));
    quote! {
        let #epsilon = #number::abs(#three * (#number::from_f64(4.0) / #three - #one) - #one);
        #(#checks)*
    }
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

//! What is emitted beside errors, so that nothing but the errors shows: the same items, without
//! the derived equations.

use std::collections::BTreeSet;

use nonholonomic_core::model::Request;
use proc_macro2::TokenStream;
use quote::quote;

use super::context::Context;
use super::function::{Head, Part};
use super::layout::Layout;
use super::taylor;
use super::{
    callback, constraint, discrete, dynamics, embedding, energy, gibbs_appell, hamiltonian, invariants,
    jacobian, momenta, observed, parameter_jacobian, phase_space, prepared, projection, report, state,
    validate, velocity,
};
use crate::resolve::Outline;

/// The struct with the items that its declaration would have given it, as far as it is understood.
pub(crate) fn stubs(layout: &Layout, outline: &Outline) -> TokenStream {
    let declared: usize = layout.velocities.iter().map(|family| family.entries().len()).sum();
    let declared = layout.velocity_symbols.get(..declared).unwrap_or_default();
    let context = &Context::new(layout, &outline.in_state, declared);
    let runtime = &context.runtime;
    let scalar = &context.scalar;
    let zero = quote!(<#scalar as #runtime::Scalar>::ZERO);
    let default = quote!(::core::default::Default::default());
    let stub = |head: Head, value: &TokenStream| head.with_body(context, &BTreeSet::new(), value);
    let mut methods = report::with_text(context, "");
    methods.extend(stub(dynamics::head(context), &default));
    methods.extend(stub(energy::head(context), &zero));
    methods.extend(stub(velocity::head(context), &default));
    methods.extend(validate::with_body(context, &TokenStream::new()));
    let mut items = report::item(context, &[]);
    items.extend(super::records(context, true));
    items.extend(state::emit(context));
    items.extend(dynamics::implementation(context, &quote!(#[inline]), &TokenStream::new()));
    items.extend(energy::implementation(context));
    if let Some(outputs) = &context.outputs {
        methods.extend(stub(observed::head(context, outputs), &default));
        items.extend(observed::implementation(context, outputs));
    }
    let part = on_request(context, outline);
    methods.extend(part.methods);
    items.extend(part.items);
    items.extend(context.inherent(&methods));
    items.extend(callback::emit(context));
    items
}

/// What is asked for, and what comes with constraints: whether the formulation is the projected one
/// is not known, and what stands there in vain does no harm.
fn on_request(context: &Context, outline: &Outline) -> Part {
    let labels: Vec<Option<&str>> = outline.labels.iter().map(Option::as_deref).collect();
    let Outline { ref requests, velocities, identities, claims_section, .. } = *outline;
    let constraints = labels.len();
    let count = |request| if requests.contains(&request) { constraints } else { 0 };
    let counts = [count(Request::Multipliers), count(Request::Reactions), constraints];
    let asked = |request, stub: &dyn Fn() -> Part| {
        if requests.contains(&request) { stub() } else { Part::default() }
    };
    let has_jacobian = requests.contains(&Request::Jacobian);
    constraint::stub(context, &labels, counts)
        .with(asked(Request::Taylor, &|| taylor::stub(context)))
        .with(embedding::stub(context, identities))
        .with(projection::stub(context, identities, constraints))
        .with(momenta::stub(context, &outline.momenta))
        .with(phase_space::stub(context, requests, claims_section, velocities))
        .with(discrete::stub(context, requests))
        .with(invariants::stub(context, requests))
        .with(asked(Request::Hamiltonian, &|| hamiltonian::stub(context, velocities)))
        .with(asked(Request::GibbsAppell, &|| gibbs_appell::stub(context)))
        .with(asked(Request::Prepared, &|| prepared::stub(context, has_jacobian)))
        .with(asked(Request::ParameterJacobian, &|| parameter_jacobian::stub(context)))
        .with(asked(Request::Jacobian, &|| jacobian::stub(context)))
}

//! What is emitted beside errors, so that nothing but the errors shows: the same items, without
//! the derived equations.

use std::collections::BTreeSet;

use nonholonomic_core::model::Request;
use nonholonomic_core::system::Side;
use proc_macro2::TokenStream;
use quote::quote;

use super::inherent_method::Part;
use super::layout::Layout;
use super::setting::Context;
use super::taylor;
use super::{
    almost_poisson, angle_cache, assembly, c, callback, discrete, editor, embedding, energy, functions,
    hamiltonian, held, impact_methods, invariants, jacobian, latex, linearization, motion, observed,
    prepared, projection, report_text, sparse_jacobian, state, validate, variational, vector_products,
};
use crate::resolve::Outline;

/// The struct with the items that its declaration would have given it, as far as it is understood.
pub(crate) fn stubs(layout: &Layout, outline: &Outline) -> TokenStream {
    let declared: usize = layout.velocities.iter().map(|family| family.entries().len()).sum();
    let declared = layout.velocity_symbols.get(..declared).unwrap_or_default();
    let context = Context::new(layout, &outline.in_state, declared);
    let context = &match &outline.outputs {
        None => context,
        Some(outputs) => context.observing(outputs),
    };
    let default = quote!(::core::default::Default::default());
    let mut methods = report_text::with_text(context, "");
    if outline.requests.contains(&Request::Explain) {
        methods.extend(report_text::derivation_with(context, ""));
    }
    if outline.requests.contains(&Request::Latex) {
        methods.extend(latex::with_text(context, ""));
    }
    if outline.requests.contains(&Request::C) {
        methods.extend(c::with_text(context, ""));
    }
    methods.extend(motion::head(context).with_body(context, &BTreeSet::new(), &default));
    methods.extend(validate::with_body(context, &TokenStream::new()));
    let mut items = report_text::item(context, &[]);
    items.extend(super::records(context, true));
    items.extend(state::emit(context));
    items.extend(motion::implementation(context, &quote!(#[inline]), &TokenStream::new()));
    items.extend(energy::implementation(context));
    if let Some(outputs) = &context.outputs {
        items.extend(observed::implementation(context, outputs));
    }
    let part = on_request(context, outline);
    methods.extend(part.methods);
    items.extend(part.items);
    items.extend(context.inherent(&methods));
    items.extend(editor::emit(context, true));
    items.extend(callback::emit(context));
    items
}

/// What is asked for, and what comes with constraints: whether the formulation is the projected one
/// is not known, and what stands there in vain does no harm.
fn on_request(context: &Context, outline: &Outline) -> Part {
    let Outline { ref requests, velocities, identities, .. } = *outline;
    let constraints = outline.labels.len();
    let asked = |request, stub: &dyn Fn() -> Part| {
        if requests.contains(&request) { stub() } else { Part::default() }
    };
    let holds = requests.contains(&Request::SymmetricProjection)
        || (requests.contains(&Request::DiscreteGradient) && outline.has_positions);
    functions::stubs(context, outline)
        .with(asked(Request::Taylor, &|| taylor::stub(context)))
        .with(embedding::stub(context, identities))
        .with(projection::stub(context, identities, constraints))
        .with(if outline.has_positions {
            assembly::stub(context, &outline.in_state, outline.kept.is_some())
        } else {
            Part::default()
        })
        .with(asked(Request::DiscreteGradient, &|| almost_poisson::stub(context, holds)))
        .with(if holds { held::stub(context) } else { Part::default() })
        .with(discrete::stub(context, requests))
        .with(asked(Request::Rattle, &|| variational::stub(context)))
        .with(invariants::stub(context, requests))
        .with(asked(Request::Hamiltonian, &|| hamiltonian::stub(context, velocities)))
        .with(asked(Request::Prepared, &|| prepared::stub(context)))
        .with(asked(Request::AngleCache, &|| angle_cache::stub(context)))
        .with(asked(Request::Jacobian, &|| jacobian::stub(context)))
        .with(asked(Request::SparseJacobian, &|| sparse_jacobian::stub(context)))
        .with(asked(Request::JacobianProduct, &|| vector_products::stub(context, Side::Right)))
        .with(asked(Request::AdjointProduct, &|| vector_products::stub(context, Side::Left)))
        .with(impact_methods::stub(context, &outline.impacts))
        .with(outline.kept.map_or_else(Part::default, |kept| linearization::stub(context, kept)))
}

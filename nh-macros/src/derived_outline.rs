//! The shape of the items beside an error, by a derivation without what is claimed and asked for: what is in error is
//! mostly none of what the state and the sizes follow from.

use nonholonomic_core::compile::compile;
use nonholonomic_core::model::{Model, Request};
use nonholonomic_core::violation::Law;

use crate::resolve::Outline;

/// The outline of a declaration in error, of which parts in error are left out.
pub(crate) fn outlined(model: Model) -> Outline {
    let outline = Outline::of(&model);
    if !is_derived(&model) {
        return outline;
    }
    let momenta = outline.requests.contains(&Request::Momenta) || !model.symmetries.is_empty();
    let system = match compile(bare(model.clone())) {
        Ok(system) => Some(system),
        Err(violations) => {
            let is_about = |laws: &[Law]| violations.iter().all(|violation| laws.contains(&violation.law));
            let mut model = bare(model);
            if is_about(&[Law::Linearization]) {
                model.linearization = None;
                compile(model).ok()
            } else if is_about(&[Law::Jacobi, Law::Homomorphism]) {
                model.almost = true;
                compile(model).ok()
            } else {
                None
            }
        }
    };
    match system {
        Some(system) => outline.derived(&system, momenta),
        None => outline,
    }
}

/// Whether a derivation tells more than the declaration.
fn is_derived(model: &Model) -> bool {
    let chooses = model.independent.is_none() && model.distribution.is_none() && model.formulation.is_none();
    model.tracked.is_some()
        || !model.routh.is_empty()
        || model.requests.iter().any(|(request, _)| has_derived_sizes(*request))
        || (chooses && model.constraints.iter().next().is_some())
}

/// Whether what is generated has sizes that only a derivation gives.
fn has_derived_sizes(request: Request) -> bool {
    matches!(request, Request::Splitting | Request::Gyroscopic | Request::Momenta)
}

/// The declaration without what its state and the sizes do not depend on.
fn bare(mut model: Model) -> Model {
    model.claims.clear();
    model.volume = None;
    model.hamilton_jacobi = None;
    model.impacts.clear();
    model.units.clear();
    model.requests.retain(|(request, _)| has_derived_sizes(*request));
    model
}

//! What is derived for motions on the whole base alone, and refused where position constraints hold.

use crate::id::Origin;
use crate::model::{Model, Request};
use crate::violation::{Law, Violation};

/// What is asked for that has no answer on N = f⁻¹(0).
pub(super) fn beside_positions(model: &Model) -> Vec<Violation> {
    if model.positions.is_empty() {
        return Vec::new();
    }
    let densities = "densities are looked for on the whole base, and motions fill a part of it";
    let fibres = "its fibres and orbits are those of the whole base, and motions stay on a part of it";
    let mut found = Vec::new();
    for (request, origin) in &model.requests {
        let (name, why) = match request {
            Request::Leapfrog => ("leapfrog", "its steps keep constraints on velocities alone"),
            Request::Volume => ("volume", densities),
            Request::Splitting => ("splitting", fibres),
            Request::Gyroscopic => ("gyroscopic", fibres),
            _ => continue,
        };
        found.push(refused(name, why, *origin));
    }
    found.extend(model.volume.iter().map(|claim| refused("volume", densities, claim.origin)));
    let levels = model.routh.first();
    let why = "what is left on a level is derived for motions on the whole base";
    found.extend(levels.map(|level| refused("routh", why, level.origin)));
    found
}

fn refused(name: &str, why: &str, origin: Origin) -> Violation {
    Violation {
        law: Law::Constraint,
        origin,
        what: format!("`{name}` is not derived beside `holonomic`"),
        evidence: why.into(),
        way_out: "leave one of them out, or declare coordinates that need no position constraint".into(),
    }
}

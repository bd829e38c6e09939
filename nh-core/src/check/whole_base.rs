//! What is derived for motions on the whole base alone, and refused where position constraints hold.

use crate::id::Origin;
use crate::model::{Model, Request};
use crate::violation::{Law, Violation};

/// What is asked for that has no answer on N = f⁻¹(0).
pub(super) fn beside_positions(model: &Model) -> Vec<Violation> {
    if model.positions.is_empty() {
        return Vec::new();
    }
    let fibres = "its fibres and orbits are those of the whole base, and motions stay on a part of it";
    let mut found = Vec::new();
    for (request, origin) in &model.requests {
        let (name, why) = match request {
            Request::Leapfrog => ("leapfrog", "its steps keep constraints on velocities alone"),
            Request::Splitting => ("splitting", fibres),
            Request::Gyroscopic => ("gyroscopic", fibres),
            _ => continue,
        };
        found.push(refused(name, why, *origin));
    }
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

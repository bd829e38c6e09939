//! What is derived for motions on the whole base alone, and refused where position constraints hold.

use crate::model::{Model, Request};
use crate::violation::{Law, Violation};

/// What is asked for that has no answer on N = f⁻¹(0).
pub(super) fn beside_positions(model: &Model) -> Vec<Violation> {
    if model.positions.is_empty() {
        return Vec::new();
    }
    let fibres = "its fibres and orbits are those of the whole base, and motions stay on a part of it";
    let elsewhere = "leave one of them out, or declare coordinates that need no position constraint";
    let by_others = "leave it out for methods that keep the positions: `emit { discrete_gradient }` for the energy, \
                     `emit { rattle }` for the symplectic form; or declare \
                     coordinates that need no position constraint";
    let mut found = Vec::new();
    for (request, origin) in &model.requests {
        let (name, why, way_out) = match request {
            Request::Leapfrog => ("leapfrog", "its steps keep constraints on velocities alone", by_others),
            Request::Splitting => ("splitting", fibres, elsewhere),
            Request::Gyroscopic => ("gyroscopic", fibres, elsewhere),
            _ => continue,
        };
        found.push(Violation {
            law: Law::Constraint,
            origin: *origin,
            what: format!("`{name}` is not derived beside `holonomic`"),
            evidence: why.into(),
            way_out: way_out.into(),
        });
    }
    found
}

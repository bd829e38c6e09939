//! What has to hold on the base for words of the declaration to have their meaning: an axis of rotation has
//! length 1, an attitude is a rotation matrix.

use super::evidence::{not_zero_on, shown};
use crate::algebra::Verdict;
use crate::geometry::Manifold;
use crate::model::Model;
use crate::violation::{Law, Violation};

/// Every claimed expression vanishes on the base, one violation for each place.
#[must_use]
pub fn claimed(model: &mut Model, base: &Manifold) -> Vec<Violation> {
    let mut violations: Vec<Violation> = Vec::new();
    for claim in model.claimed.clone() {
        if violations.iter().any(|known| known.origin == claim.origin) {
            continue;
        }
        let verdict = base.zero_test(&mut model.graph, claim.value);
        if verdict.is_zero() {
            continue;
        }
        let value = model.graph.simplify(claim.value);
        let evidence = match &verdict {
            Verdict::NonZero(witness) => {
                format!("{}: {}", claim.measure, not_zero_on(&model.graph, value, witness, base))
            }
            _ => format!("{}: {} should be 0", claim.measure, shown(&model.graph, value)),
        };
        violations.push(Violation {
            law: Law::Attitude,
            origin: claim.origin,
            what: claim.what,
            evidence,
            way_out: claim.way_out,
        });
    }
    violations
}

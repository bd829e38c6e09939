//! Claimed first integrals: their derivative along the motion vanishes on the constraint manifold.

use super::evidence::{not_zero, shown};
use crate::algebra::Verdict;
use crate::geometry::Manifold;
use crate::id::ExprId;
use crate::mechanics::Flow;
use crate::model::Model;
use crate::violation::{Law, Violation};

/// Judges the claims of the declaration; `claims` are they in the variables of the state.
pub fn claims(model: &mut Model, claims: &[ExprId], mut flow: Flow, manifold: &Manifold) -> Vec<Violation> {
    let mut violations = Vec::new();
    for (index, claim) in claims.iter().enumerate() {
        let graph = &mut model.graph;
        let rate = flow.derivative(graph, *claim);
        let verdict = manifold.zero_test(graph, rate);
        if verdict.is_zero() {
            continue;
        }
        let rate = graph.simplify(rate);
        let declared = &model.claims[index];
        let (what, evidence) = match &verdict {
            Verdict::NonZero(witness) if manifold.is_whole() => (
                format!("`{}` is not conserved", declared.name),
                format!("its rate along the motion {}", not_zero(&model.graph, rate, witness)),
            ),
            Verdict::Unknown(why) => (
                format!("whether `{}` is conserved could not be decided", declared.name),
                format!("its rate along the motion is {}: {why}", shown(&model.graph, rate)),
            ),
            _ => (
                format!("`{}` is not conserved", declared.name),
                format!(
                    "its rate along the motion does not vanish where the constraints hold: {}",
                    shown(&model.graph, rate)
                ),
            ),
        };
        violations.push(Violation {
            law: Law::Conservation,
            origin: declared.origin,
            what,
            evidence,
            way_out: "correct the claim or leave it out".into(),
        });
    }
    violations
}

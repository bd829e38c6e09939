//! Claimed first integrals: their derivative along the motion vanishes on the constraint manifold.

use super::evidence::{not_zero, seen, shown};
use super::values_where_unsolved::vanishes_where_unsolved;
use crate::algebra::{Facts, Graph, Verdict, Witness};
use crate::geometry::Manifold;
use crate::id::{ExprId, SymbolId};
use crate::mechanics::Flow;
use crate::model::Model;
use crate::violation::{Law, Violation};

/// Judges the claims of the declaration; `claims` are they in the variables of the state. The manifold is larger than the
/// set where claims are made if there are position constraints that could not be solved.
pub fn claims(
    model: &mut Model,
    claims: &[ExprId],
    mut flow: Flow,
    (manifold, unsolved): (&Manifold, &[ExprId]),
    facts: &Facts,
) -> Vec<Violation> {
    let mut violations = Vec::new();
    for (index, claim) in claims.iter().enumerate() {
        let graph = &mut model.graph;
        let rate = flow.derivative(graph, *claim);
        let (whole, (manifold, verdict)) = (manifold, manifold.judged(graph, rate));
        let restricted = manifold.restrict(graph, rate);
        let mut verdict = graph.verdict_under(restricted, facts, verdict);
        if !unsolved.is_empty()
            && !verdict.is_zero()
            && vanishes_where_unsolved(graph, rate, (&manifold, unsolved))
        {
            continue;
        }
        if let (Verdict::NonZero(_), Some(function)) = (&verdict, unsolved.first()) {
            let function = shown(graph, *function);
            verdict = Verdict::Unknown(format!(
                "no points were found that stand for all where {function} = 0, so that it was asked elsewhere"
            ));
        }
        let rate = if verdict.is_zero() { rate } else { graph.simplify(rate) };
        let declared = &model.claims[index];
        let not_conserved = format!("`{}` is not conserved", declared.name);
        let (what, evidence) = match &verdict {
            Verdict::Zero => continue,
            Verdict::NonZero(witness) if manifold.is_whole() => (
                not_conserved,
                format!("its rate along the motion {}", not_zero(&model.graph, rate, witness)),
            ),
            Verdict::NonZero(witness) => {
                let own = whole.own_images(manifold.images()).into_iter().map(|(symbol, _)| symbol);
                let evidence = on_manifold(&model.graph, rate, witness, (&manifold, own.collect()));
                (not_conserved, evidence)
            }
            Verdict::Unknown(why) => (
                format!("whether `{}` is conserved could not be decided", declared.name),
                format!("its rate along the motion is {}: {why}", shown(&model.graph, rate)),
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

/// The rate at a point where the constraints hold, in the symbols of the declaration and those that tell the part of it.
fn on_manifold(
    graph: &Graph,
    rate: ExprId,
    witness: &Witness,
    (manifold, mut symbols): (&Manifold, Vec<SymbolId>),
) -> String {
    let text = shown(graph, rate);
    let inside = graph.symbols_in(&[rate]);
    let are_few = inside.len() <= 12;
    symbols.retain(|symbol| !inside.contains(symbol));
    symbols.extend(inside);
    match manifold.point(graph, witness, &symbols) {
        Some(point) if are_few => {
            let place: Vec<String> = point
                .iter()
                .map(|(symbol, value)| format!("{} = {value:.4}", graph.symbols()[*symbol]))
                .collect();
            let value = match (seen(witness.value), witness.value) {
                (None, _) => "not 0".to_owned(),
                (Some(small), value) if value.abs() < 1e-4 => small,
                (Some(_), value) => format!("{value:.4}"),
            };
            format!(
                "its rate along the motion is {text}, where the constraints hold for example {value} at {}",
                place.join(", ")
            )
        }
        _ => format!("its rate along the motion does not vanish where the constraints hold: {text}"),
    }
}

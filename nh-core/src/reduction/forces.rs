//! The forces are related: Υ and Φ^*Υ' do the same work on every virtual displacement.

use super::assuming;
use super::bundle_map::BundleMap;
use super::laws::{Sides, broken};
use super::maps::reduced_velocities;
use super::side::Side;
use crate::algebra::Graph;
use crate::geometry::ConstraintDistribution;
use crate::id::ExprId;
use crate::violation::{Law, Violation};

/// Forces that are no formulas cannot be compared.
pub(super) fn opaque(source: &Side, target: &Side, map: &BundleMap) -> Option<Violation> {
    [source, target].into_iter().find_map(|side| {
        let model = &side.proved.model;
        let called = |values: Vec<ExprId>| {
            let symbols = model.graph.symbols_in(&values);
            model.calls.iter().find(|call| symbols.contains(&call.symbol))
        };
        let by_a_force = called(model.forces.iter().map(|force| force.value).collect());
        let by_a_rate = || called(model.auxiliary.iter().map(|state| state.value).collect());
        let (caller, call) =
            by_a_force.map(|call| ("force", call)).or_else(|| Some(("rate", by_a_rate()?)))?;
        Some(Violation {
            law: Law::Morphism,
            origin: map.origin,
            what: "whether the forces are related cannot be known".into(),
            evidence: format!(
                "a {caller} of `{}` calls `self.{}`, which is no formula",
                model.name, call.method
            ),
            way_out: "let the force be an input of both systems, or write it as a formula".into(),
        })
    })
}

/// Compares the forces along a basis of D, or on the virtual displacements as a whole.
pub(super) fn forces(source: &mut Side, target: &Side, map: &BundleMap) -> Vec<Violation> {
    let mut left = source.proved.system.forces.clone();
    let mut right = pulled_back(source, target, map);
    let mut names: Vec<String> =
        source.proved.model.sections.iter().map(|section| section.name.clone()).collect();
    if let Some(distribution) = source.distribution.clone() {
        (left, right) = on_distribution(source, &distribution, (&left, &right));
        let symbols = source.graph().symbols();
        names = distribution.independent.iter().map(|symbol| symbols[*symbol].clone()).collect();
    } else {
        let graph = source.graph();
        let defect = left.iter().zip(&right).map(|(left, right)| graph.formula(left - right)).collect();
        if source.rank_on_displacements(&vec![defect]) == Ok(0) {
            return Vec::new();
        }
    }
    let mut violations = Vec::new();
    for ((left, right), name) in left.into_iter().zip(right).zip(names) {
        let defect = source.graph().sub(left, right);
        let verdict = source.vanishes_on_constraints(defect);
        if verdict.is_zero() {
            continue;
        }
        let (left, right) = (source.restricted(left), source.restricted(right));
        let words = [
            format!("along `{name}`, that of `{}` is", source.name()),
            format!("and that of `{}` becomes", target.name()),
        ];
        let what = "the forces are not related".to_owned();
        let way_out = "correct the forces, the map of the inputs, or the parameters".to_owned();
        let sides = Sides { left, right, words };
        violations.push(broken(source, map.origin, what, &sides, &verdict, way_out));
    }
    violations
}

/// Forces along the basis of D: those of the source with what acts along spanning sections.
fn on_distribution(
    source: &mut Side,
    distribution: &ConstraintDistribution,
    (left, right): (&[ExprId], &[ExprId]),
) -> (Vec<ExprId>, Vec<ExprId>) {
    let graph = &mut source.proved.model.graph;
    let mut along = (Vec::new(), Vec::new());
    for (a, symbol) in distribution.independent.iter().enumerate() {
        let section = distribution.section(a);
        let mut on_section = graph.inner_product(&section, left);
        for value in source.proved.system.forces_along(*symbol) {
            on_section = graph.formula(on_section + value);
        }
        along.0.push(on_section);
        along.1.push(graph.inner_product(&section, right));
    }
    along
}

/// Φ^*Υ' along each section of E. A force of the target along a spanning section of D' acts on the
/// velocity of that section.
fn pulled_back(source: &mut Side, target: &Side, map: &BundleMap) -> Vec<ExprId> {
    let mut pull_back = map.pull_back(target);
    let images = pull_back.apply_all(source.graph(), &target.proved.system.forces);
    let columns = Graph::transposed(&map.fibre);
    let mut forces = vec![source.graph().zero(); source.velocities().len()];
    for (force, column) in forces.iter_mut().zip(&columns) {
        *force = source.graph().inner_product(column, &images);
    }
    let along: Vec<_> = target.proved.system.forces_on_distribution.clone();
    if !along.is_empty()
        && let Some(distribution) = &target.distribution
    {
        let reduced = reduced_velocities(source, target, map);
        let velocities = source.velocities().to_vec();
        for (direction, value) in along {
            let Some(a) = distribution.independent.iter().position(|symbol| *symbol == direction) else {
                continue;
            };
            let graph = source.graph();
            let value = pull_back.apply(graph, value);
            for (force, symbol) in forces.iter_mut().zip(&velocities) {
                let share = graph.partial(reduced[a], *symbol);
                *force = graph.formula(*force + share * value);
            }
        }
    }
    forces.into_iter().map(|force| assuming(source, force)).collect()
}

//! What moves is related: L = L'∘Φ and Φ(D) = D', CLMM Theorems 4.6 and 7.8.

use super::assuming;
use super::auxiliary_rates::auxiliary_states;
use super::bundle_map::BundleMap;
use super::forces::{forces, opaque};
use super::laws::{Sides, broken};
use super::side::Side;
use crate::algebra::Verdict;
use crate::check::evidence::{name_of, shown};
use crate::id::{ConstraintId, ExprId, Id};
use crate::violation::{Law, Violation};

/// Proves that the systems are related, D going onto D' if that `is_asked`. Forces are compared where the constraints are.
pub(super) fn related(source: &mut Side, target: &Side, map: &BundleMap, is_asked: bool) -> Vec<Violation> {
    let mut violations: Vec<Violation> = lagrangian(source, target, map).into_iter().collect();
    let mut constraints = included(source, target, map);
    if is_asked && constraints.is_empty() {
        constraints.extend(covered(source, target, map));
    }
    let comparable = constraints.is_empty();
    violations.extend(constraints);
    match opaque(source, target, map) {
        Some(violation) => violations.push(violation),
        None if comparable => {
            violations.extend(forces(source, target, map));
            violations.extend(auxiliary_states(source, target, map));
        }
        None => {}
    }
    violations
}

/// L = L'∘Φ, on the velocities that are tangent to the positions.
fn lagrangian(source: &mut Side, target: &Side, map: &BundleMap) -> Option<Violation> {
    let right = map.pull_back(target).apply(source.graph(), target.proved.system.lagrangian);
    let right = assuming(source, right);
    let right = source.on_tangent(right);
    let left = source.proved.system.lagrangian;
    let left = source.on_tangent(left);
    let defect = source.graph().sub(left, right);
    let verdict = source.vanishes(defect);
    if verdict.is_zero() {
        return None;
    }
    let what = "the Lagrangians are not related: L is not L' after the map".to_owned();
    let words =
        [format!("that of `{}` is", source.name()), format!("and that of `{}` becomes", target.name())];
    let way_out = "correct the map, the parameters, or one of the Lagrangians".to_owned();
    Some(broken(source, map.origin, what, &Sides { left, right, words }, &verdict, way_out))
}

/// Φ(D) ⊂ D': what the constraints of the source allow satisfies those of the target.
fn included(source: &mut Side, target: &Side, map: &BundleMap) -> Vec<Violation> {
    let mut violations = Vec::new();
    for (index, residual) in residuals_of_target(source, target, map).into_iter().enumerate() {
        let verdict = source.vanishes_on_constraints(residual);
        let undecided = match &verdict {
            Verdict::Zero => continue,
            Verdict::NonZero(_) => String::new(),
            Verdict::Unknown(why) => format!(" ({why})"),
        };
        let left_over = source.restricted(residual);
        let left_over = source.graph().simplify(left_over);
        let (model, id) = (&target.proved.model, ConstraintId::from_index(index));
        let is_declared = model.constraints.get(id).is_some();
        let name = if is_declared { name_of(model, id) } else { "the distribution".to_owned() };
        let (from, to) = (source.name(), target.name());
        violations.push(Violation {
            law: Law::Morphism,
            origin: map.origin,
            what: format!("{name} of `{to}` does not hold for what `{from}` allows"),
            evidence: format!(
                "where the constraints of `{from}` hold, it says {} = 0{undecided}",
                shown(source.graph(), left_over)
            ),
            way_out: format!("add the constraint to `{from}`, or take it from `{to}`"),
        });
    }
    violations
}

/// D' ⊂ Φ(D): the virtual displacements go onto those of the target.
fn covered(source: &mut Side, target: &Side, map: &BundleMap) -> Option<Violation> {
    let wanted = target.rank();
    let (from, to) = (source.name(), target.name());
    let evidence = match source.rank_on_displacements(&map.fibre) {
        Ok(rank) if rank == wanted => return None,
        Ok(rank) => format!(
            "the velocities that `{from}` allows have an image of dimension {rank}, those of `{to}` are of \
             dimension {wanted}"
        ),
        Err(why) => why,
    };
    Some(Violation {
        law: Law::Morphism,
        origin: map.origin,
        what: format!("`{to}` allows velocities that no motion of `{from}` has"),
        evidence,
        way_out: format!("add the missing constraints to `{to}`, or take them from `{from}`"),
    })
}

/// The constraints of the target, pulled back.
fn residuals_of_target(source: &mut Side, target: &Side, map: &BundleMap) -> Vec<ExprId> {
    let mut pull_back = map.pull_back(target);
    let residuals = match &target.distribution {
        None => pull_back.apply_all(source.graph(), &target.proved.constraints.residuals),
        Some(distribution) => {
            let velocity: Vec<ExprId> = map.velocity.iter().map(|located| located.value).collect();
            let constraints = &distribution.constraints;
            let rows = constraints.annihilator.iter().zip(&constraints.drift);
            rows.map(|(row, drift)| {
                let graph = source.graph();
                let row = pull_back.apply_all(graph, row);
                let (linear, drift) = (graph.inner_product(&row, &velocity), pull_back.apply(graph, *drift));
                graph.formula(linear + drift)
            })
            .collect()
        }
    };
    residuals.into_iter().map(|residual| assuming(source, residual)).collect()
}

//! Functions of the motion and of what is declared add no condition: where a parameter is 0 they have a value if that
//! which defines them has.

use super::super::proof::{Defect, FIRST_SEED};
use super::place::Place;
use super::{Derived, Motion, proof_of_flow};
use crate::algebra::{Direction, FieldPoint, Graph, Residue};
use crate::id::{ExprId, SymbolId};
use crate::mechanics::Definition;
use std::collections::BTreeSet;

/// Points that are looked at, as far as they have values.
const POINTS: usize = 3;
/// Points that are tried for these.
const SEEDS: u64 = 24;

/// Those of some parameters that stand in what a claim divides by, and what defines it does not: nothing else can lose
/// its value where they are 0.
pub(super) fn parameters_of_added_divisors(
    graph: &Graph,
    claim: &Derived,
    (declared, motion): (&[ExprId], Motion),
    parameters: &[SymbolId],
) -> Vec<SymbolId> {
    if parameters.is_empty() {
        return Vec::new();
    }
    let known = graph.divisors(&[declared, &motion.derivative.expressions()].concat());
    let solved: BTreeSet<SymbolId> =
        motion.derivative.definitions.iter().flat_map(unknowns).copied().collect();
    let mut symbols: BTreeSet<SymbolId> = BTreeSet::new();
    for procedure in claim.procedures() {
        let mut added: Vec<ExprId> =
            graph.divisors(&procedure.expressions()).difference(&known).copied().collect();
        for definition in &procedure.definitions {
            if let Definition::Solve { matrix, unknowns, .. } = definition
                && !unknowns.iter().all(|unknown| solved.contains(unknown))
            {
                added.extend(matrix.iter().flatten());
            }
        }
        if !added.is_empty() {
            symbols.extend(procedure.depends_on(graph, &added));
        }
    }
    parameters.iter().copied().filter(|parameter| symbols.contains(parameter)).collect()
}

fn unknowns(definition: &Definition) -> &[SymbolId] {
    match definition {
        Definition::Solve { unknowns, .. } => unknowns,
        Definition::Value { .. } | Definition::Call { .. } => &[],
    }
}

/// The first parameter that may be 0 for the motion, and not for the function.
pub(super) fn parameter_that_may_not_vanish<'a, 's>(
    claim: &Derived,
    parameters: &[SymbolId],
    point: impl Fn(u64) -> FieldPoint,
    at: impl Fn(FieldPoint) -> Result<Place<'a, 's>, Defect>,
) -> Option<SymbolId> {
    parameters.iter().copied().find(|parameter| {
        let mut without_value = 0;
        for seed in FIRST_SEED..FIRST_SEED + SEEDS {
            let mut point = point(seed);
            point.chosen.insert(*parameter, Residue::ZERO);
            let Ok(mut place) = at(point) else { continue };
            if !is_defined(claim, &mut place).unwrap_or(false) {
                continue;
            }
            if claim.procedures().iter().all(|procedure| place.run(procedure).is_ok()) {
                return false;
            }
            without_value += 1;
            if without_value == POINTS {
                return true;
            }
        }
        false
    })
}

/// Whether the motion, and what defines the function, have values; false for those whose existence is another
/// question, as that of momenta and densities is.
fn is_defined(claim: &Derived, place: &mut Place) -> Result<bool, Defect> {
    let flow = place.flow()?;
    place.values(&place.reference.roots(place.pass().graph()))?;
    match *claim {
        Derived::Jacobian(function, _, arguments) => {
            let pass = place.pass();
            let along = |(k, symbol): (usize, &SymbolId)| {
                (*symbol, pass.kernel("direction", &[Residue::of_word(k as u64)]))
            };
            let along: Direction = arguments.iter().enumerate().map(along).collect();
            place.slopes(function, &along)?;
        }
        Derived::Rates(function, _) => _ = place.slopes(function, &flow)?,
        Derived::Divergence(_, identities) => _ = proof_of_flow::divergence(place, identities)?,
        Derived::Energy(_) => _ = place.instant.energy()?,
        Derived::Values(form) => _ = form.names.known(place)?.evaluate(form.declared)?,
        Derived::Velocity(_) => {}
        _ => return Ok(false),
    }
    Ok(true)
}

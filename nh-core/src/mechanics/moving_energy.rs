//! Moving energies of systems with affine constraints (Fassò, Sansonetto, arXiv 1503.06661).

use super::complete_lift::complete_lift;
use super::euler_lagrange::LagrangianSystem;
use crate::algebra::{Echelon, FieldPoint, Graph, Residue};
use crate::geometry::{LinearConstraints, Manifold};
use crate::id::{ExprId, Id, SymbolId};

/// A section ξ with Φ ξ = −b and ξ^C(L) = 0 on the constraint manifold, so that E_L − ξ^α p_α is
/// conserved by an autonomous system without forces (mathematics section 4).
///
/// ξ is sought among the sections whose components are affine in the base coordinates, with the
/// parameters that the drift b carries as factors. It is found at random points and then proved.
pub fn moving_energy_section(
    graph: &mut Graph,
    system: &LagrangianSystem,
    constraints: &LinearConstraints,
    parameters: &[SymbolId],
    manifold: &Manifold,
) -> Option<Vec<ExprId>> {
    let candidates = candidates(graph, system);
    let coefficients = sampled_coefficients(graph, system, constraints, parameters, manifold, &candidates)?;
    let scales = scales(graph, constraints, parameters);
    let zero = graph.zero();
    let mut section = vec![zero; system.algebroid.rank()];
    for ((component, function), coefficient) in candidates.iter().zip(coefficients) {
        if coefficient != Residue::ZERO {
            let factor = recognised(graph, coefficient, &scales, parameters)?;
            section[*component] = graph.formula(section[*component] + factor * function);
        }
    }
    proved(graph, system, constraints, manifold, &section).then_some(section)
}

/// `(α, f)` for the sections f e_α with f = 1 or a coordinate.
fn candidates(graph: &mut Graph, system: &LagrangianSystem) -> Vec<(usize, ExprId)> {
    let one = graph.one();
    let mut functions = vec![one];
    functions.extend(system.algebroid.anchor.coordinates.iter().map(|symbol| graph.symbol(*symbol)));
    (0..system.algebroid.rank()).flat_map(|alpha| functions.iter().map(move |f| (alpha, *f))).collect()
}

/// What Φ ξ + b and ξ^C(L) are for one candidate (without b).
fn conditions(
    graph: &mut Graph,
    system: &LagrangianSystem,
    constraints: &LinearConstraints,
    manifold: &Manifold,
    section: &[ExprId],
) -> Vec<ExprId> {
    let mut values = graph.image(&constraints.annihilator, section);
    let change =
        complete_lift(graph, &system.algebroid, section, &system.clock).apply(graph, system.lagrangian);
    values.push(change);
    values.into_iter().map(|value| manifold.restrict(graph, value)).collect()
}

/// Values of the parameters that all sample points share.
fn common_point(seed: u64, parameters: &[SymbolId]) -> FieldPoint {
    let mut point = FieldPoint::random(seed);
    for parameter in parameters {
        point.chosen.insert(*parameter, Residue::mixed(13_000, parameter.index() as u64));
    }
    point
}

/// The coefficients of the candidates in ξ at one set of parameter values, from the conditions at
/// many points.
fn sampled_coefficients(
    graph: &mut Graph,
    system: &LagrangianSystem,
    constraints: &LinearConstraints,
    parameters: &[SymbolId],
    manifold: &Manifold,
    candidates: &[(usize, ExprId)],
) -> Option<Vec<Residue>> {
    let zero = graph.zero();
    let mut columns: Vec<Vec<ExprId>> = Vec::with_capacity(candidates.len() + 1);
    for (component, function) in candidates {
        let mut section = vec![zero; system.algebroid.rank()];
        section[*component] = *function;
        columns.push(conditions(graph, system, constraints, manifold, &section));
    }
    let mut right: Vec<ExprId> = Vec::new();
    for drift in &constraints.drift {
        let negative = graph.formula(-drift);
        right.push(manifold.restrict(graph, negative));
    }
    right.push(zero);
    columns.push(right);
    let conditions = Graph::transposed(&columns);
    let mut rows: Vec<Vec<Residue>> = Vec::new();
    for sample in 0..(2 * candidates.len() as u64) {
        let start = 14_000 + 64 * sample;
        rows.extend(graph.matrix_in_field(&conditions, |seed| common_point(start + seed, parameters)).ok()?);
    }
    Echelon::of(rows).solution(candidates.len())
}

/// The parameters that the drift carries as factors, and 1.
fn scales(graph: &mut Graph, constraints: &LinearConstraints, parameters: &[SymbolId]) -> Vec<ExprId> {
    let mut scales = vec![graph.one()];
    for drift in &constraints.drift {
        for (term, _) in graph.as_linear(*drift).1 {
            let mut kept = graph.factors(term);
            kept.retain(|(base, _)| graph.symbols_in(&[*base]).iter().all(|s| parameters.contains(s)));
            scales.push(graph.product(&kept));
        }
    }
    scales.dedup();
    scales
}

/// A small rational multiple of one of the scales with this value at the common parameters.
fn recognised(
    graph: &mut Graph,
    coefficient: Residue,
    scales: &[ExprId],
    parameters: &[SymbolId],
) -> Option<ExprId> {
    for scale in scales {
        let value = graph.evaluate_in_field(&[*scale], &common_point(14_000, parameters)).ok()?[0];
        let ratio = coefficient * value.inverse()?;
        if let Some(multiple) = ratio.recognised() {
            return Some(graph.scale(multiple, *scale));
        }
    }
    None
}

fn proved(
    graph: &mut Graph,
    system: &LagrangianSystem,
    constraints: &LinearConstraints,
    manifold: &Manifold,
    section: &[ExprId],
) -> bool {
    let mut values = conditions(graph, system, constraints, manifold, section);
    let change = values.pop();
    let horizontal = values.into_iter().zip(&constraints.drift).all(|(value, drift)| {
        let drift = manifold.restrict(graph, *drift);
        let sum = graph.formula(value + drift);
        graph.zero_test(sum).is_zero()
    });
    horizontal && change.is_some_and(|change| graph.zero_test(change).is_zero())
}

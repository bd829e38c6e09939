//! Cyclic coordinates: what nothing depends on.

use super::euler_lagrange::LagrangianSystem;
use crate::algebra::{Graph, Matrix};
use crate::geometry::Anchor;
use crate::id::{CoordId, ExprId, Id, SymbolId};

/// Functions with more operations than this are taken to depend on every symbol that occurs.
const DIFFERENTIATED: u64 = 400;

/// The coordinates that do not occur in L, ρ, C, the forces and `more` (the constraints, identities
/// of the base, position constraints, arguments of methods): their equations are quadratures (mathematics section 5).
pub fn cyclic_coordinates(graph: &mut Graph, system: &LagrangianSystem, more: &[ExprId]) -> Vec<CoordId> {
    let algebroid = &system.algebroid;
    let mut functions = vec![system.lagrangian];
    functions.extend(algebroid.anchor.entries.iter().flatten());
    functions.extend(algebroid.structure.terms().map(|(.., component)| component));
    functions.extend(&system.forces);
    functions.extend(system.forces_on_distribution.iter().map(|(_, force)| *force));
    functions.extend(more);
    functions.sort_unstable();
    functions.dedup();
    let present = graph.symbols_in(&functions);
    let coordinates = algebroid.anchor.coordinates.clone();
    let is_cyclic =
        |symbol: SymbolId| !present.contains(&symbol) || does_not_change(graph, &functions, symbol);
    let found: Vec<bool> = coordinates.into_iter().map(is_cyclic).collect();
    found.iter().enumerate().filter(|(_, cyclic)| **cyclic).map(|(i, _)| CoordId::from_index(i)).collect()
}

/// Whether no function changes with a symbol that occurs in some: `sin(x)^2 + cos(x)^2`.
fn does_not_change(graph: &mut Graph, functions: &[ExprId], symbol: SymbolId) -> bool {
    let dependent: Vec<ExprId> =
        functions.iter().copied().filter(|function| graph.depends_on(*function, &[symbol])).collect();
    if graph.operation_count(&dependent) > DIFFERENTIATED {
        return false;
    }
    dependent.into_iter().all(|function| {
        let partial = graph.partial(function, symbol);
        graph.zero_test(partial).is_zero()
    })
}

/// The section whose motion changes one coordinate alone, at unit rate: ρ(σ) = ∂/∂x^i. `None` where
/// the anchor does not determine it.
pub fn translation(graph: &mut Graph, anchor: &Anchor, coordinate: CoordId) -> Option<Vec<ExprId>> {
    translations(graph, anchor, &[coordinate]).pop()?
}

/// The same for some coordinates: the anchor is solved once.
pub fn translations(graph: &mut Graph, anchor: &Anchor, coordinates: &[CoordId]) -> Vec<Option<Vec<ExprId>>> {
    let n = anchor.coordinates.len();
    if graph.generic_rank(&anchor.entries) != Ok(anchor.rank) {
        return vec![None; coordinates.len()];
    }
    let units: Matrix =
        coordinates.iter().map(|coordinate| graph.unit_vector(n, coordinate.index())).collect();
    if n != anchor.rank {
        // more coordinates than sections: a section of the basis or none
        let mut section = |unit: &Vec<ExprId>| {
            let moves =
                |alpha: &usize| anchor.entries.iter().zip(unit).all(|(row, rate)| row[*alpha] == *rate);
            let alpha = (0..anchor.rank).find(moves)?;
            Some(graph.unit_vector(anchor.rank, alpha))
        };
        return units.iter().map(&mut section).collect();
    }
    let Some(solution) = graph.solve_linear(&anchor.entries, &Graph::transposed(&units)) else {
        return vec![None; coordinates.len()];
    };
    let mut column = |k: usize| solution.values.iter().map(|row| graph.simplify(row[k])).collect();
    (0..coordinates.len()).map(|k| Some(column(k))).collect()
}

//! Mass matrices whose determinants are too long to be written out: where the signs of their eigenvalues are others in
//! another state of one machine, they are singular in a state between.

use super::regularity::machine;
use crate::algebra::{Bounded, Facts, Graph, Matrix, Node, negative_eigenvalues};
use crate::id::{ExprId, SymbolId};

/// Machines that are tried, the first of them with parameters of like size, and states of each.
const MACHINES: u64 = 6;
const OF_LIKE_SIZE: u64 = 4;
const STATES: u64 = 6;

/// Operations of a matrix that is looked at.
const LENGTH: u64 = 1000;

/// Different entries of a matrix that are looked at.
const ENTRIES: usize = 100;

/// Whether something but parameters may occur in a matrix: of many entries it is not asked.
pub(super) fn varies(graph: &Graph, matrix: &Matrix, parameters: &[SymbolId]) -> bool {
    // what was made last is made of most
    let mut entries = matrix.concat();
    entries.sort_unstable_by(|a, b| b.cmp(a));
    entries.dedup();
    entries.len() > ENTRIES
        || entries.into_iter().any(|entry| graph.has_symbol(entry, |symbol| !parameters.contains(&symbol)))
}

fn is_positive(facts: &Facts, symbol: SymbolId) -> bool {
    facts.symbols.get(&symbol).is_some_and(|range| range.is_positive())
}

/// Parts of a Lagrangian that are looked at.
const PARTS: usize = 100;

/// Whether a Lagrangian is, as it stands, a sum of squares of velocities, as that of bodies is, less a potential: then no
/// eigenvalue of its mass matrix is negative, where parameters are positive.
pub(crate) fn is_sum_of_squares(
    graph: &Graph,
    lagrangian: ExprId,
    velocities: &[SymbolId],
    facts: &Facts,
) -> bool {
    let mut parts = vec![(lagrangian, false)];
    for _ in 0..PARTS {
        let Some((part, is_negative)) = parts.pop() else { return true };
        match graph.node(part) {
            Node::Sum { terms, .. } => {
                parts.extend(terms.iter().map(|(term, factor)| (*term, is_negative != factor.is_negative())));
            }
            Node::Product { coefficient, factors } => {
                let is_negative = is_negative != coefficient.is_negative();
                let mut open = factors.iter().filter(|(base, exponent)| {
                    let is_square = exponent.is_integer() && !exponent.has_odd_numerator();
                    !is_square && !graph.as_symbol(*base).is_some_and(|symbol| is_positive(facts, symbol))
                });
                match (open.next(), open.next()) {
                    (None, _) if !is_negative => {}
                    (Some((base, exponent)), None) if exponent.is_one() => parts.push((*base, is_negative)),
                    _ if graph.depends_on(part, velocities) => return false,
                    _ => {}
                }
            }
            _ if graph.depends_on(part, velocities) => return false,
            _ => {}
        }
    }
    false
}

/// Whether a symmetric matrix that is continuous in the state is positive definite in some state of a machine whose parameters
/// are positive and as the facts say, and has negative eigenvalues in another.
pub(crate) fn changes_signature(
    graph: &Graph,
    matrix: &Matrix,
    parameters: &[SymbolId],
    facts: &Facts,
) -> bool {
    let entries = matrix.concat();
    if graph.operation_count(&entries) > LENGTH {
        return false;
    }
    let symbols = graph.symbols_in(&entries);
    let mut evaluator = graph.evaluator(&entries);
    (0..MACHINES).any(|number| {
        let value = |state: u64, symbol: SymbolId| {
            machine(&symbols, parameters, (number, number >= OF_LIKE_SIZE), (STATES, state), symbol)
        };
        let point: Vec<(SymbolId, f64)> =
            parameters.iter().map(|symbol| (*symbol, value(0, *symbol))).collect();
        if !graph.hold_at(facts, &point) {
            return false;
        }
        let mut seen = [false; 2];
        for state in 0..STATES {
            let values = evaluator.at(|symbol| value(state, symbol));
            let rows: Vec<Vec<Bounded>> = values.chunks(matrix.len()).map(<[Bounded]>::to_vec).collect();
            if let Some(negative) = negative_eigenvalues(rows) {
                seen[usize::from(negative > 0)] = true;
            }
        }
        seen == [true; 2]
    })
}

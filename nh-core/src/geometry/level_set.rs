//! N = f⁻¹(0), where position constraints hold: points of it, by solving for coordinates or parameters.
//!
//! What is claimed on N is claimed for all parameters, so that a loop of links is as well the set of all
//! angles with one length that closes it: loops are linear in lengths. What could not be solved is left
//! open: the points found are then those of a larger set.

use super::manifold::{Ease, Manifold};
use crate::algebra::{Graph, Verdict};
use crate::id::{ExprId, SymbolId};

/// A manifold in whose place a larger one stands, if some functions could not be solved.
#[derive(Clone, Debug)]
pub struct NearManifold {
    /// Where the functions vanish that could be solved.
    pub manifold: Manifold,
    /// The others, by position.
    pub unsolved: Vec<usize>,
}

impl Manifold {
    /// Where position constraints hold over an embedded base, solved for coordinates or parameters: linear
    /// ones first, so that no root gets into what could be solved without.
    #[must_use]
    pub fn of_positions(
        graph: &mut Graph,
        base: &Self,
        functions: &[ExprId],
        [coordinates, parameters]: [&[SymbolId]; 2],
    ) -> NearManifold {
        let charted: Vec<SymbolId> = parameters.iter().chain(&base.chart).copied().collect();
        let ways: [(Ease, &[SymbolId]); 4] = [
            (Ease::Linear, coordinates),
            (Ease::Linear, &charted),
            (Ease::Root, &charted),
            (Ease::Root, coordinates),
        ];
        let mut manifold = base.clone();
        let mut open: Vec<usize> = (0..functions.len()).collect();
        while !open.is_empty() {
            let restricted: Vec<(usize, ExprId)> =
                open.iter().map(|index| (*index, manifold.restrict(graph, functions[*index]))).collect();
            let holds = restricted.iter().find(|(_, function)| graph.zero_test(*function) == Verdict::Zero);
            let solved = holds.map(|(index, _)| *index).or_else(|| {
                ways.into_iter().find_map(|(ease, unknowns)| {
                    let solved = restricted
                        .iter()
                        .find(|(_, function)| manifold.solve(graph, *function, unknowns, ease, parameters));
                    solved.map(|(index, _)| *index)
                })
            });
            let Some(solved) = solved else { break };
            open.retain(|index| *index != solved);
        }
        NearManifold { manifold, unsolved: open }
    }
}

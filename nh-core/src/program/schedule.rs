//! The search for the cheapest straight-line form.

use super::cost::Cost;
use super::factor::{Sharing, factor};
use super::import::import;
use super::lower::lower;
use super::nary::Arena;
use super::pairs::{Kind, share_pairs};
use super::powers::separate_powers;
use super::step::Program;
use crate::algebra::Graph;
use crate::id::SymbolId;
use crate::mechanics::Procedure;

/// One way to go. Greedy choices in one pass take chances from the next, so several are tried.
#[derive(Clone, Copy, Debug)]
struct Strategy {
    /// Whether sums are searched for shared pairs before they are factored.
    sums_first: bool,
    /// How factoring counts shared products; none if sums are not factored.
    factoring: Option<Sharing>,
}

/// The strategies, the best on average first.
const STRATEGIES: [Strategy; 5] = [
    Strategy { sums_first: false, factoring: Some(Sharing::Divided) },
    Strategy { sums_first: false, factoring: Some(Sharing::Ignored) },
    Strategy { sums_first: true, factoring: Some(Sharing::Divided) },
    Strategy { sums_first: true, factoring: Some(Sharing::Ignored) },
    Strategy { sums_first: false, factoring: None },
];

/// Beyond so many terms only the first two strategies are tried.
const LARGE: usize = 4000;

/// The cheapest program found for a procedure. Deterministic.
#[must_use]
pub fn schedule(graph: &Graph, procedure: &Procedure) -> Program {
    schedule_grouping(graph, procedure, &[])
}

/// As [`schedule`], where operations among `parameters` are kept together if that costs nothing, so
/// that they can be done once per parameter set.
#[must_use]
pub fn schedule_grouping(graph: &Graph, procedure: &Procedure, parameters: &[SymbolId]) -> Program {
    let arena = import(graph, procedure, parameters);
    let tried = if arena.len() > LARGE { &STRATEGIES[..2] } else { &STRATEGIES[..] };
    let programs = tried.iter().map(|strategy| strategy.run(arena.clone()));
    programs.min_by_key(|program| Cost::of(program).weighted()).unwrap_or_default()
}

impl Strategy {
    fn run(self, mut arena: Arena) -> Program {
        if self.sums_first {
            share_pairs(&mut arena, Kind::Sums);
        }
        if let Some(sharing) = self.factoring {
            factor(&mut arena, sharing);
        }
        separate_powers(&mut arena);
        share_pairs(&mut arena, Kind::Products);
        share_pairs(&mut arena, Kind::Sums);
        lower(&arena)
    }
}

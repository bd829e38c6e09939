//! The search for the cheapest straight-line form.

use super::angles::share_angles;
use super::cost::order;
use super::denominators::separate_powers;
use super::factor::{Sharing, factor};
use super::fold::folded;
use super::import::import;
use super::lower::lower;
use super::nary::Arena;
use super::pairs::{Kind, share_pairs};
use super::step::Program;
use crate::algebra::{Accuracy, Graph};
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

/// Up to so many terms constants are made numbers at different times: before common factors are taken out of
/// sums, after that, or at last. Mostly the first is as good as any.
const SMALL: usize = 250;

/// The cheapest program found for a procedure. Deterministic.
#[must_use]
pub fn schedule(graph: &Graph, procedure: &Procedure) -> Program {
    schedule_grouping(graph, procedure, &[])
}

/// As [`schedule`], where operations among `parameters` are kept together if that costs nothing, so
/// that they can be done once per parameter set.
#[must_use]
pub fn schedule_grouping(graph: &Graph, procedure: &Procedure, parameters: &[SymbolId]) -> Program {
    schedules(graph, procedure, parameters).into_iter().next().unwrap_or_default()
}

/// All programs that are found, the cheapest first.
#[must_use]
pub fn schedules(graph: &Graph, procedure: &Procedure, parameters: &[SymbolId]) -> Vec<Program> {
    let mut arena = import(graph, procedure, parameters);
    // fast code saves evaluations; in careful code, which carries what rounding took, whatever cancels by an addition
    // theorem cancels in both words
    if graph.accuracy() != Accuracy::Balanced {
        share_angles(&mut arena);
    }
    let tried = if arena.len() > LARGE { &STRATEGIES[..2] } else { &STRATEGIES[..] };
    let mut prepared = Vec::new();
    if graph.constants().is_empty() {
        prepare(&arena, tried, &mut prepared);
    } else {
        if arena.len() <= SMALL {
            prepare(&arena, tried, &mut prepared);
            for index in 0..prepared.len() {
                let in_numbers = folded(&prepared[index]);
                add(&mut prepared, in_numbers);
            }
        }
        prepare(&folded(&arena), tried, &mut prepared);
    }
    let mut programs: Vec<Program> = prepared.into_iter().map(straight_line).collect();
    programs.sort_by_cached_key(order);
    programs
}

/// Factors an arena by each strategy; what has come to the same goes the same way from here.
fn prepare(arena: &Arena, strategies: &[Strategy], prepared: &mut Vec<Arena>) {
    let mut shared = None;
    for strategy in strategies {
        let arena = if strategy.sums_first {
            shared.get_or_insert_with(|| with_shared_sums(arena.clone()))
        } else {
            arena
        };
        add(prepared, strategy.factored(arena.clone()));
    }
}

fn add(prepared: &mut Vec<Arena>, arena: Arena) {
    if prepared.iter().all(|other| !other.computes_alike(&arena)) {
        prepared.push(arena);
    }
}

/// A program by the first strategy alone: close enough to the cheapest for procedures to be compared.
#[must_use]
pub fn schedule_roughly(graph: &Graph, procedure: &Procedure) -> Program {
    let arena = import(graph, procedure, &[]);
    let arena = if graph.constants().is_empty() { arena } else { folded(&arena) };
    straight_line(STRATEGIES[0].factored(arena))
}

fn with_shared_sums(mut arena: Arena) -> Arena {
    share_pairs(&mut arena, Kind::Sums);
    arena
}

impl Strategy {
    fn factored(self, mut arena: Arena) -> Arena {
        if let Some(sharing) = self.factoring {
            factor(&mut arena, sharing);
        }
        arena
    }
}

/// The program of an arena whose sums are factored.
fn straight_line(mut arena: Arena) -> Program {
    separate_powers(&mut arena);
    share_pairs(&mut arena, Kind::Products);
    share_pairs(&mut arena, Kind::Sums);
    lower(&arena)
}

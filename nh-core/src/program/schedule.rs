//! The search for the cheapest straight-line form.

use super::angles::share_angles;
use super::coincide::coincided;
use super::cost::{Cost, order};
use super::denominators::separate_powers;
use super::factor::{Sharing, factor};
use super::fold::folded;
use super::import::import;
use super::lower::{fused, lower};
use super::nary::Arena;
use super::pairs::{Kind, share_pairs};
use super::scales::scaled;
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

/// So many strategies are tried where angles are shared, beside all of them where they are not.
const BESIDE: usize = 2;

/// In so many programs, the cheapest, is looked for steps that coincide.
const CONJECTURED: usize = 2;

/// The cheapest program found for a procedure without conjectures and without larger rounding errors. Deterministic.
#[must_use]
pub fn schedule(graph: &Graph, procedure: &Procedure) -> Program {
    schedule_grouping(graph, procedure, &[])
}

/// As [`schedule`], where operations among `parameters` are kept together if that costs nothing, so
/// that they can be done once per parameter set.
#[must_use]
pub fn schedule_grouping(graph: &Graph, procedure: &Procedure, parameters: &[SymbolId]) -> Program {
    let mut found = schedules(graph, procedure, parameters).into_iter();
    found.find(|scheduled| scheduled.beside.is_none()).map(|scheduled| scheduled.program).unwrap_or_default()
}

/// A program that was found for a procedure.
#[derive(Clone, Debug)]
pub struct Scheduled {
    /// The program.
    pub program: Program,
    /// Whether it takes steps for one that coincide at a few points, so that it is to be proved.
    pub is_conjecture: bool,
    /// Where its rounding errors may be larger for something that was done to it: the program without that.
    pub beside: Option<Program>,
}

/// All programs that are found, the cheapest first.
#[must_use]
pub fn schedules(graph: &Graph, procedure: &Procedure, parameters: &[SymbolId]) -> Vec<Scheduled> {
    let arena = at_best_scales(graph, import(graph, procedure, parameters));
    let mut shared = arena.clone();
    let is_shared = share_angles(&mut shared);
    // fast code saves evaluations; in careful code, which carries what rounding took, whatever cancels by an addition
    // theorem cancels in both words; otherwise it is done where the results do not lose by it
    if graph.accuracy() != Accuracy::Balanced {
        return found(graph, if is_shared { &shared } else { &arena }, &STRATEGIES);
    }
    let mut programs = found(graph, &arena, &STRATEGIES);
    let plain = programs.iter().find(|scheduled| scheduled.beside.is_none());
    if is_shared && let Some(plain) = plain.map(|scheduled| scheduled.program.clone()) {
        for Scheduled { program, is_conjecture, .. } in found(graph, &shared, &STRATEGIES[..BESIDE]) {
            if order(&program) < order(&plain) {
                programs.push(Scheduled { program, is_conjecture, beside: Some(plain.clone()) });
            }
        }
        programs.sort_by_cached_key(|scheduled| order(&scheduled.program));
    }
    programs
}

/// The programs of an arena, the cheapest first.
fn found(graph: &Graph, arena: &Arena, strategies: &[Strategy]) -> Vec<Scheduled> {
    let tried = if arena.len() > LARGE { &strategies[..2] } else { strategies };
    let mut prepared = Vec::new();
    if graph.constants().is_empty() {
        prepare(arena, tried, &mut prepared);
    } else {
        if arena.len() <= SMALL {
            prepare(arena, tried, &mut prepared);
            for index in 0..prepared.len() {
                let in_numbers = folded(&prepared[index]);
                add(&mut prepared, in_numbers);
            }
        }
        prepare(&folded(arena), tried, &mut prepared);
    }
    let is_parameter = |symbol| arena.parameters.contains(&symbol);
    let mut found: Vec<(Program, Program)> = Vec::with_capacity(prepared.len());
    for prepared in prepared {
        let lowered = straight_line(prepared);
        found.push((fused(lowered.clone(), is_parameter), lowered));
    }
    found.sort_by_cached_key(|(program, _)| order(program));
    let mut scheduled = Vec::with_capacity(found.len());
    for (place, (plain, lowered)) in found.into_iter().enumerate() {
        if place < CONJECTURED {
            for program in coincided(&lowered, is_parameter) {
                let program = fused(program, is_parameter);
                if order(&program) < order(&plain) {
                    let beside = Some(plain.clone());
                    scheduled.push(Scheduled { program, is_conjecture: true, beside });
                }
            }
        }
        scheduled.push(Scheduled { program: plain, is_conjecture: false, beside: None });
    }
    scheduled.sort_by_cached_key(|scheduled| order(&scheduled.program));
    scheduled
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
    roughly(graph, import(graph, procedure, &[]))
}

fn roughly(graph: &Graph, arena: Arena) -> Program {
    let arena = if graph.constants().is_empty() { arena } else { folded(&arena) };
    let parameters = arena.parameters.clone();
    fused(straight_line(STRATEGIES[0].factored(arena)), |symbol| parameters.contains(&symbol))
}

/// The arena with its sums at other scales, where that is cheaper.
fn at_best_scales(graph: &Graph, arena: Arena) -> Arena {
    let cost = |arena: &Arena| Cost::of(&roughly(graph, arena.clone())).weighted();
    match scaled(&arena) {
        Some(other) if cost(&other) < cost(&arena) => other,
        _ => arena,
    }
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

/// The program of an arena whose sums are factored, to be [`fused`].
fn straight_line(mut arena: Arena) -> Program {
    separate_powers(&mut arena);
    share_pairs(&mut arena, Kind::Products);
    share_pairs(&mut arena, Kind::Sums);
    lower(&arena)
}

//! Terms that cancel identically, and others that leave fewer digits than an expression as cheap would.
//!
//! Procedures are compared by their work and by their errors where all symbols are of ordinary size. An
//! intermediate result that others share, a momentum `I ω + m h v`, say, may bring terms into a sum where they
//! cancel identically. That costs nothing there; but where such a term is large, no digits are left. So results
//! are also looked at where one symbol is larger than all others, and computed another way if that is no dearer.

use crate::algebra::{Accuracy, Graph};
use crate::count::Count;
use crate::id::{ExprId, SymbolId};
use crate::mechanics::{Definition, Procedure};
use crate::program::{Cost, Program, error_growth, reading_in_vain, schedule_roughly, units_lost};
use std::collections::BTreeSet;

/// Procedures with more operations than this are not looked at: nothing of that size is written out.
const LOOKED_AT: u64 = 400;
/// Outputs written out with more operations than this are not simplified.
const WRITTEN_OUT: u64 = 480;
/// Those with no more are, whatever they are like.
const SHORT: u64 = 60;
/// Units in the last place that results may lose where one symbol is a million times the others: more than
/// operations add up to, less than a term is worth that cancels there.
const LOST: f64 = 65536.0;
/// What is gained at least for that.
const MUCH: f64 = 256.0;
/// Units in the last place that do not matter.
const FEW: f64 = 32.0;

/// The same procedure without results that lose digits for nothing. `fixed` are the symbols that are not made
/// large: coordinates, which are mostly angles.
pub(super) fn without_needless_cancellation(
    graph: &mut Graph,
    procedure: Procedure,
    fixed: &[SymbolId],
) -> Procedure {
    if graph.accuracy() == Accuracy::Fast || graph.operation_count(&procedure.values(graph)) > LOOKED_AT {
        return procedure;
    }
    let mut best = Rated::of(graph, procedure, fixed);
    if !best.is_losing() {
        return best.procedure;
    }
    // 1. an intermediate result or an output by itself
    for place in 0..best.procedure.definitions.len() + best.procedure.outputs.len() {
        let place = Place::of(&best.procedure, place);
        let Some(value) = place.value(&best.procedure) else { continue };
        let simplified = graph.simplify(value);
        if simplified != value {
            let mut other = best.procedure.clone();
            place.put(&mut other, simplified);
            best.replace_by(graph, other, fixed);
        }
    }
    // 2. all outputs written out
    if best.is_losing() {
        let written_out = best.procedure.written_out(graph);
        if best.is_worth_writing_out(graph.operation_count(&written_out)) {
            let mut other = best.procedure.clone();
            for (output, value) in graph.simplify_all(&written_out).into_iter().enumerate() {
                Place::of_output(graph, &other, output).put(&mut other, value);
            }
            best.replace_by(graph, other, fixed);
        }
    }
    without_unused(graph, best.procedure)
}

/// Without intermediate results that nothing depends on; methods are called all the same.
fn without_unused(graph: &Graph, mut procedure: Procedure) -> Procedure {
    let mut used: BTreeSet<SymbolId> = graph.symbols_in(&procedure.outputs).into_iter().collect();
    let mut kept = Vec::with_capacity(procedure.definitions.len());
    for definition in procedure.definitions.into_iter().rev() {
        match &definition {
            Definition::Value { symbol, .. } if !used.contains(symbol) => continue,
            Definition::Value { value, .. } => used.extend(graph.symbols_in(&[*value])),
            Definition::Call { arguments, .. } => used.extend(graph.symbols_in(arguments)),
            Definition::Solve { matrix, right, .. } => {
                used.extend(graph.symbols_in(&matrix.concat()));
                used.extend(graph.symbols_in(right));
            }
        }
        kept.push(definition);
    }
    kept.reverse();
    procedure.definitions = kept;
    procedure
}

/// A procedure, its program, and the units in the last place that its outputs may lose.
struct Rated {
    procedure: Procedure,
    program: Program,
    lost: Vec<f64>,
}

impl Rated {
    fn of(graph: &Graph, procedure: Procedure, fixed: &[SymbolId]) -> Self {
        let program = schedule_roughly(graph, &procedure);
        let lost = units_lost(&program, fixed);
        Self { procedure, program, lost }
    }

    /// Whether an output loses more than operations add up to.
    fn is_losing(&self) -> bool {
        self.lost.iter().any(|lost| *lost > LOST)
    }

    /// Whether outputs with so many operations, written out, are worth simplifying. What elimination leaves loses
    /// digits, too, and is not shorter when written out, unless a symbol disappears from it.
    fn is_worth_writing_out(&self, operations: Count) -> bool {
        let disappears = || reading_in_vain(&self.program).contains(&true);
        operations <= SHORT || (operations <= WRITTEN_OUT && disappears())
    }

    /// Takes another procedure of the same value that is no dearer, if an output loses much less by it and
    /// none more than the level of accuracy allows.
    fn replace_by(&mut self, graph: &Graph, other: Procedure, fixed: &[SymbolId]) {
        let other = Self::of(graph, other, fixed);
        if Cost::of(&other.program).weighted() > Cost::of(&self.program).weighted() {
            return;
        }
        let allowed = graph.accuracy().growth();
        let pairs = || self.lost.iter().zip(&other.lost);
        let is_better = pairs().any(|(before, after)| *before > LOST && MUCH * after < *before);
        let is_worse = pairs().any(|(before, after)| *after > allowed * before.max(FEW));
        if is_better && !is_worse && error_growth(graph, &[&self.program, &other.program])[1] <= allowed {
            *self = other;
        }
    }
}

/// Where a value stands in a procedure.
#[derive(Clone, Copy)]
enum Place {
    Definition(usize),
    Output(usize),
}

impl Place {
    /// The definitions, then the outputs.
    fn of(procedure: &Procedure, index: usize) -> Self {
        let definitions = procedure.definitions.len();
        if index < definitions { Self::Definition(index) } else { Self::Output(index - definitions) }
    }

    /// Where the value of an output stands that may be an intermediate result.
    fn of_output(graph: &Graph, procedure: &Procedure, output: usize) -> Self {
        let name = graph.as_symbol(procedure.outputs[output]);
        let is_it = |definition: &Definition| match definition {
            Definition::Value { symbol, .. } => Some(*symbol) == name,
            Definition::Call { .. } | Definition::Solve { .. } => false,
        };
        procedure.definitions.iter().position(is_it).map_or(Self::Output(output), Self::Definition)
    }

    fn value(self, procedure: &Procedure) -> Option<ExprId> {
        match self {
            Self::Definition(index) => match procedure.definitions[index] {
                Definition::Value { value, .. } => Some(value),
                Definition::Call { .. } | Definition::Solve { .. } => None,
            },
            Self::Output(index) => Some(procedure.outputs[index]),
        }
    }

    fn put(self, procedure: &mut Procedure, new: ExprId) {
        match self {
            Self::Definition(index) => {
                if let Definition::Value { value, .. } = &mut procedure.definitions[index] {
                    *value = new;
                }
            }
            Self::Output(index) => procedure.outputs[index] = new,
        }
    }
}

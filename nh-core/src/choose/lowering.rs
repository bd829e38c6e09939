//! Procedures become programs, each of which is proved to compute the same before it is printed.

use std::borrow::Cow;
use std::cell::RefCell;
use std::fmt::Write;

use super::ledger::Proof;
use super::lowered::{Unproved, prove_program, prove_split};
use super::sizes::TAKEN_FROM;
use crate::algebra::{Accuracy, Graph, Range};
use crate::id::{Origin, SymbolId};
use crate::mechanics::Procedure;
use crate::model::Model;
use crate::program::{
    AtRest, Limits, Program, Scheduled, Split, at_rest, corrected, error_growth, error_growth_apart,
    schedules, split,
};
use crate::violation::{Law, Violation};

/// What is said of a program that is refuted, and what can be done.
pub const REFUTED: &str = "no program for a generated function could be proved to compute what was derived";
/// The way out.
pub const DEFECT: &str = "please report this declaration: it is a defect of the derivation";

/// What came of the programs of one declaration.
#[derive(Debug, Default)]
pub struct Lowering {
    outcomes: RefCell<Vec<Result<Proof, Unproved>>>,
    /// What was lowered: a step of a projection, say, is printed in several methods.
    known: RefCell<Vec<Known>>,
    divided_by_roots: RefCell<Vec<&'static str>>,
}

/// A procedure of a model whose program is known.
#[derive(Debug)]
struct Known {
    model: *const Model,
    procedure: Procedure,
    has_corrections: bool,
    program: Program,
    outcome: Result<Proof, Unproved>,
}

impl Known {
    /// The program of a function whose results are among those of this one, where this one is long: what is shared
    /// among more results is as short for some of them, and what was proved of all is proved of these.
    fn part(&self, procedure: &Procedure) -> Option<(Program, Result<Proof, Unproved>)> {
        if self.program.steps.len() < TAKEN_FROM {
            return None;
        }
        let places = self.procedure.places_of(procedure)?;
        let outputs: Option<Vec<_>> =
            places.into_iter().map(|place| self.program.outputs.get(place).copied()).collect();
        Some((self.program.giving(&outputs?), self.outcome.clone()))
    }
}

impl Lowering {
    /// The program of a procedure, at the level of accuracy that is asked for.
    #[must_use]
    pub fn program(&self, model: &Model, procedure: &Procedure) -> Program {
        self.finished(model, procedure, model.graph.accuracy() == Accuracy::Careful)
    }

    /// The program of a function that is, or may contain, a derivative: where lengths vanish by which it divides, it has
    /// the values that it tends to, as far as it is proved to tend to some.
    #[must_use]
    pub fn derivative(
        &self,
        model: &Model,
        (name, procedure): (&'static str, &Procedure),
        limits: Limits,
    ) -> Program {
        let facts = &model.facts.symbols;
        let range = |symbol| facts.get(&symbol).copied().unwrap_or(Range::ALL);
        let is_careful = model.graph.accuracy() == Accuracy::Careful;
        let AtRest { mended, divides_by_roots } =
            at_rest(&self.finished(model, procedure, false), &range, limits);
        let mended = mended.map(|program| if is_careful { corrected(&program) } else { program });
        let proof = mended.as_ref().map(|program| prove_program(&model.graph, procedure, program));
        let is_wrong = matches!(proof, Some(Err(Unproved::Wrong)));
        if (divides_by_roots || is_wrong) && !self.divided_by_roots.borrow().contains(&name) {
            self.divided_by_roots.borrow_mut().push(name);
        }
        match (mended, proof) {
            (Some(program), Some(outcome)) if !is_wrong => {
                self.note(outcome);
                program
            }
            _ => self.program(model, procedure),
        }
    }

    /// The functions among them that divide by roots for which that is not proved.
    #[must_use]
    pub fn divided_by_roots(&self) -> Vec<&'static str> {
        self.divided_by_roots.borrow().clone()
    }

    /// The same program without corrections of rounding errors, where it has any: those of power series are zero.
    #[must_use]
    pub fn without_corrections<'p>(
        &self,
        model: &Model,
        procedure: &Procedure,
        program: &'p Program,
    ) -> Cow<'p, Program> {
        match model.graph.accuracy() {
            Accuracy::Fast | Accuracy::Balanced => Cow::Borrowed(program),
            Accuracy::Careful => Cow::Owned(self.finished(model, procedure, false)),
        }
    }

    fn finished(&self, model: &Model, procedure: &Procedure, has_corrections: bool) -> Program {
        let is_known = |known: &&Known| {
            std::ptr::eq(known.model, model)
                && known.has_corrections == has_corrections
                && known.procedure.computes_alike(procedure)
        };
        if let Some(Known { program, outcome, .. }) = self.known.borrow().iter().find(is_known) {
            self.note(outcome.clone());
            return program.clone();
        }
        let part = |known: &Known| {
            let is_beside = std::ptr::eq(known.model, model) && known.has_corrections == has_corrections;
            if is_beside { known.part(procedure) } else { None }
        };
        if let Some((program, outcome)) = self.known.borrow().iter().find_map(part) {
            self.note(outcome);
            return program;
        }
        let finish = |program| if has_corrections { corrected(&program) } else { program };
        let (program, outcome) = match lowered(&model.graph, procedure, &parameters(model), finish) {
            Ok(Lowered { program, proof }) => (program, proof.map_err(Unproved::Unknown)),
            Err(unproved) => (Program::default(), Err(unproved)),
        };
        self.note(outcome.clone());
        let (procedure, known) = (procedure.clone(), program.clone());
        self.known.borrow_mut().push(Known { model, procedure, has_corrections, program: known, outcome });
        program
    }

    /// A program of a procedure in two parts, of which the first depends on parameters alone.
    #[must_use]
    pub fn split(&self, model: &Model, procedure: &Procedure, program: &Program) -> Split {
        let split = split(program, &parameters(model), model.graph.symbols().len());
        self.note(prove_split(&model.graph, procedure, &split));
        split
    }

    fn note(&self, outcome: Result<Proof, Unproved>) {
        self.outcomes.borrow_mut().push(outcome);
    }

    /// Whether a program computes something else than its procedure.
    #[must_use]
    pub fn is_refuted(&self) -> bool {
        self.outcomes.borrow().contains(&Err(Unproved::Wrong))
    }

    /// That one does.
    #[must_use]
    pub fn violation(&self, origin: Origin) -> Option<Violation> {
        self.is_refuted().then(|| Violation {
            law: Law::Decidable,
            origin,
            what: REFUTED.into(),
            evidence: String::new(),
            way_out: DEFECT.into(),
        })
    }

    /// What was proved, as lines of the ledger.
    #[must_use]
    pub fn text(&self) -> String {
        let outcomes = self.outcomes.borrow();
        let proofs = outcomes.iter().filter_map(|outcome| outcome.as_ref().ok());
        let points: u64 = proofs.clone().map(|proof| proof.points).sum();
        let bits = proofs.clone().map(|proof| proof.bits).fold(f64::INFINITY, f64::min);
        let mut text = String::from("programs\n");
        if points > 0 {
            let count = proofs.count();
            _ = writeln!(text, "  {count} lowered: each proved to 2^-{bits:.0}, at {points} points in all");
        }
        for outcome in outcomes.iter() {
            if let Err(Unproved::Unknown(reason)) = outcome {
                _ = writeln!(text, "  one not decided: {reason}");
            }
        }
        text
    }
}

fn parameters(model: &Model) -> Vec<SymbolId> {
    model.parameters.iter().map(|parameter| parameter.symbol).collect()
}

/// A program with its proof, or why there could be none.
#[derive(Clone, Debug)]
pub struct Lowered {
    /// What is emitted.
    pub program: Program,
    /// How it was proved; the reason where that could not be decided.
    pub proof: Result<Proof, String>,
}

/// The cheapest program of a procedure that is not refuted, with operations among parameters kept together;
/// `finish` makes of a program what is emitted.
///
/// # Errors
/// [`Unproved::Wrong`] where every program is refuted.
pub fn lowered(
    graph: &Graph,
    procedure: &Procedure,
    parameters: &[SymbolId],
    finish: impl Fn(Program) -> Program,
) -> Result<Lowered, Unproved> {
    for Scheduled { program, is_conjecture, beside } in schedules(graph, procedure, parameters) {
        if beside.as_ref().is_some_and(|plain| loses_digits(graph, plain, &program)) {
            continue;
        }
        let program = finish(program);
        match prove_program(graph, procedure, &program) {
            Ok(proof) => return Ok(Lowered { program, proof: Ok(proof) }),
            Err(Unproved::Unknown(_)) if is_conjecture => {}
            Err(Unproved::Unknown(reason)) => return Ok(Lowered { program, proof: Err(reason) }),
            Err(Unproved::Wrong) => {}
        }
    }
    Err(Unproved::Wrong)
}

/// Whether a program has larger rounding errors than one without what was done to it.
fn loses_digits(graph: &Graph, plain: &Program, program: &Program) -> bool {
    if graph.accuracy() == Accuracy::Fast {
        return false;
    }
    let programs = [plain, program];
    let loses = |growth: Vec<f64>| growth[1] > SLACK * growth[0];
    loses(error_growth(graph, &programs)) || loses(error_growth_apart(graph, &programs))
}

/// How much larger rounding errors may be by that, which is how far bounds of equal errors are apart.
const SLACK: f64 = 1.25;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::id::ExprId;
    use crate::program::{order, schedule};

    /// A sum of products of shifted powers for each result: nothing of it can be shared away.
    fn long(graph: &mut Graph, count: i64) -> Procedure {
        let symbol = graph.new_symbol("x");
        let x = graph.symbol(symbol);
        let mut result = |row: i64| -> ExprId {
            (0..12).fold(x, |product, column| {
                let shift = graph.number(13 * row + column + 2);
                graph.formula(product * (x + shift))
            })
        };
        Procedure::of((0..count).map(&mut result).collect())
    }

    /// What gives some of the results of a long program is that program without what it does not need, and no longer
    /// than one that is found apart; of a short one, or of other results, nothing is taken.
    #[test]
    fn some_results_of_a_long_program_are_taken_from_it() {
        let mut graph = Graph::default();
        let procedure = long(&mut graph, 20);
        let known = |procedure: &Procedure| Known {
            model: std::ptr::null(),
            procedure: procedure.clone(),
            has_corrections: false,
            program: schedule(&graph, procedure),
            outcome: Ok(Proof { points: 7, bits: 100.0, is_on_base: false }),
        };
        let whole = known(&procedure);
        assert!(whole.program.steps.len() >= TAKEN_FROM);
        let some = procedure.with_outputs(vec![procedure.outputs[17], procedure.outputs[3]]);
        let (program, outcome) = whole.part(&some).expect("results of it");
        assert!(outcome.is_ok());
        assert!(prove_program(&graph, &some, &program).is_ok());
        assert!(order(&program) <= order(&schedule(&graph, &some)));

        let short = procedure.with_outputs(procedure.outputs[..4].to_vec());
        assert!(known(&short).part(&procedure.with_outputs(vec![procedure.outputs[1]])).is_none());
        let two = graph.number(2);
        assert!(whole.part(&procedure.with_outputs(vec![procedure.outputs[17], two])).is_none());
    }
}

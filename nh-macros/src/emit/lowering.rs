//! Procedures become programs, each of which is proved to compute the same before it is printed.

use std::cell::RefCell;
use std::fmt::Write;

use nonholonomic_core::algebra::Accuracy;
use nonholonomic_core::choose::{Lowered, Proof, Unproved, lowered, prove_split};
use nonholonomic_core::id::{Origin, SymbolId};
use nonholonomic_core::mechanics::Procedure;
use nonholonomic_core::model::Model;
use nonholonomic_core::program::{Program, Split, corrected, split};
use nonholonomic_core::violation::{Law, Violation};

/// What is said of a program that is refuted, and what can be done.
pub(super) const REFUTED: &str =
    "no program for a generated function could be proved to compute what was derived";
pub(super) const DEFECT: &str = "please report this declaration: it is a defect of the derivation";

/// What came of the programs of one declaration.
#[derive(Default)]
pub(super) struct Lowering {
    outcomes: RefCell<Vec<Result<Proof, Unproved>>>,
}

impl Lowering {
    /// The program of a procedure, at the level of accuracy that is asked for.
    pub(super) fn program(&self, model: &Model, procedure: &Procedure) -> Program {
        let is_careful = model.graph.accuracy() == Accuracy::Careful;
        self.finished(model, procedure, |program| if is_careful { corrected(&program) } else { program })
    }

    /// The program of a procedure without corrections of rounding errors.
    pub(super) fn uncorrected(&self, model: &Model, procedure: &Procedure) -> Program {
        self.finished(model, procedure, |program| program)
    }

    fn finished(&self, model: &Model, procedure: &Procedure, finish: impl Fn(Program) -> Program) -> Program {
        match lowered(&model.graph, procedure, &parameters(model), finish) {
            Ok(Lowered { program, proof }) => {
                self.note(proof.map_err(Unproved::Unknown));
                program
            }
            Err(unproved) => {
                self.note(Err(unproved));
                Program::default()
            }
        }
    }

    /// A program of a procedure in two parts, of which the first depends on parameters alone.
    pub(super) fn split(&self, model: &Model, procedure: &Procedure, program: &Program) -> Split {
        let split = split(program, &parameters(model), model.graph.symbols().len());
        self.note(prove_split(&model.graph, procedure, &split));
        split
    }

    fn note(&self, outcome: Result<Proof, Unproved>) {
        self.outcomes.borrow_mut().push(outcome);
    }

    /// Whether a program computes something else than its procedure.
    pub(super) fn is_refuted(&self) -> bool {
        self.outcomes.borrow().contains(&Err(Unproved::Wrong))
    }

    /// That one does.
    pub(super) fn violation(&self, origin: Origin) -> Option<Violation> {
        self.is_refuted().then(|| Violation {
            law: Law::Decidable,
            origin,
            what: REFUTED.into(),
            evidence: String::new(),
            way_out: DEFECT.into(),
        })
    }

    /// What was proved, as lines of the ledger.
    pub(super) fn text(&self) -> String {
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

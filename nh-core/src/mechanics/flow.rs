//! The derivative of functions along the motion.

use super::euler_lagrange::LagrangianSystem;
use super::procedure::{Definition, Procedure};
use crate::algebra::{Derivation, Graph, Matrix, Substitution};
use crate::id::{ExprId, SymbolId};
use crate::limits;
use rustc_hash::FxHashSet;

/// The vector field Γ of the constrained motion as a derivation of functions of (t, x, v, z).
#[derive(Clone, Debug)]
pub struct Flow(Derivation);

impl Flow {
    /// The flow whose coordinates, velocities and auxiliary states have the rates that `derivative` computes.
    pub fn of(
        graph: &mut Graph,
        derivative: &Procedure,
        system: &LagrangianSystem,
        velocities: &[SymbolId],
    ) -> Self {
        let rates = derivative.written_out(graph);
        let coordinates = system.algebroid.anchor.coordinates.iter();
        let auxiliary = system.clock.auxiliary.iter().map(|(state, _)| *state);
        let state = coordinates.chain(velocities).copied().chain(auxiliary);
        let seeds = state.zip(rates).chain([(system.clock.time, graph.one())]);
        Self(Derivation::new(seeds))
    }

    /// `Γ(f)`.
    pub fn derivative(&mut self, graph: &mut Graph, function: ExprId) -> ExprId {
        self.0.apply(graph, function)
    }
}

impl Procedure {
    /// The outputs in terms of the symbols that go in: every intermediate result put in place.
    pub fn written_out(&self, graph: &mut Graph) -> Vec<ExprId> {
        put_in_place(graph, self.definitions.iter(), &self.outputs)
    }

    /// Values in terms of the symbols that go in, of which the procedure may have many more.
    pub(super) fn written_out_alone(&self, graph: &mut Graph, values: &[ExprId]) -> Vec<ExprId> {
        let mut used: FxHashSet<SymbolId> = graph.symbols_in(values).into_iter().collect();
        let mut needed = Vec::new();
        limits::spend(self.definitions.len() / DEFINITIONS_PER_STEP);
        for definition in self.definitions.iter().rev() {
            let read = match definition {
                Definition::Value { symbol, value } if used.contains(symbol) => graph.symbols_in(&[*value]),
                Definition::Solve { unknowns, matrix, right }
                    if unknowns.iter().any(|u| used.contains(u)) =>
                {
                    graph.symbols_in(&[matrix.concat(), right.clone()].concat())
                }
                _ => continue,
            };
            used.extend(read);
            needed.push(definition);
        }
        put_in_place(graph, needed.into_iter().rev(), values)
    }
}

/// As many definitions are passed by in a step of work.
const DEFINITIONS_PER_STEP: usize = 16;

/// Values with definitions put in place.
fn put_in_place<'a>(
    graph: &mut Graph,
    definitions: impl Iterator<Item = &'a Definition>,
    values: &[ExprId],
) -> Vec<ExprId> {
    let mut known = Substitution::new([]);
    for definition in definitions {
        match definition {
            Definition::Value { symbol, value } => {
                let value = known.apply(graph, *value);
                known.insert(*symbol, value);
            }
            // what a method returns is known to the compiled program only: it stays a symbol
            Definition::Call { .. } => {}
            Definition::Solve { unknowns, matrix, right } => {
                let matrix: Matrix = matrix.iter().map(|row| known.apply_all(graph, row)).collect();
                let right: Matrix = right.iter().map(|e| vec![known.apply(graph, *e)]).collect();
                if let Some(solution) = graph.solve_linear(&matrix, &right) {
                    for (symbol, row) in unknowns.iter().zip(solution.values) {
                        known.insert(*symbol, row[0]);
                    }
                }
            }
        }
    }
    known.apply_all(graph, values)
}

//! The derivative of functions along the motion.

use super::euler_lagrange::LagrangianSystem;
use super::procedure::{Definition, Procedure};
use crate::algebra::{Derivation, Graph, Matrix, Substitution};
use crate::id::{ExprId, SymbolId};

/// The vector field Γ of the constrained motion as a derivation of functions of (t, x, v).
#[derive(Clone, Debug)]
pub struct Flow(Derivation);

impl Flow {
    /// The flow whose coordinates and velocities have the rates that `derivative` computes.
    pub fn of(
        graph: &mut Graph,
        derivative: &Procedure,
        system: &LagrangianSystem,
        velocities: &[SymbolId],
    ) -> Self {
        let rates = derivative.written_out(graph);
        let one = graph.one();
        let coordinates = system.algebroid.anchor.coordinates.iter();
        let seeds = coordinates.chain(velocities).copied().zip(rates).chain([(system.time, one)]);
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
        let mut known = Substitution::new([]);
        for definition in &self.definitions {
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
        known.apply_all(graph, &self.outputs)
    }
}

//! Solutions of open systems for other right-hand sides, by what they were solved with, and what weighs these sides.

use super::opened::{Closing, DiagonalAndOne, OpenSystem};
use super::tape::Tape;
use crate::algebra::{Graph, Matrix};
use crate::id::{ExprId, SymbolId};
use crate::mechanics::{Definition, Eliminated, Hanging};
use std::ops::Range;

impl OpenSystem {
    /// Whether each residual is about few variables, rather than about all that is coupled with it.
    pub(super) fn is_local(&self) -> bool {
        matches!(self.closing, Closing::OneByOne { .. })
    }

    /// By how much the unknowns change where the residuals do: C⁻¹ of them.
    pub(super) fn changes(&self, graph: &mut Graph, tape: &mut Tape, residuals: Vec<ExprId>) -> Vec<ExprId> {
        match &self.closing {
            Closing::Factorised { lower, diagonal, .. } => {
                substituted(graph, tape, (lower, diagonal), residuals)
            }
            Closing::DiagonalAndOne { inverse, .. } => inverse.times(graph, tape, residuals),
            Closing::OneByOne { eliminated, .. } => {
                let (forces, motions) = residuals.split_at(eliminated.len());
                let values = Pushed::by(graph, tape, eliminated, (forces, motions)).values;
                let mut found = vec![graph.zero(); self.unknowns.len()];
                for Eliminated { place, unknown, .. } in eliminated {
                    if let Some((unknown, _)) = unknown {
                        found[*unknown] = values[*place];
                    }
                }
                found
            }
            Closing::Inverted { rows, .. } => {
                let rows: Matrix = rows.iter().filter_map(|row| tape.outputs(row)).collect();
                multiplied(graph, tape, &rows, &residuals)
            }
            Closing::Pivoted { matrix, .. } => {
                let matrix: Matrix = matrix.iter().filter_map(|row| tape.outputs(row)).collect();
                self.pivoted(graph, tape, matrix, residuals)
            }
        }
    }

    /// What the residuals weigh where the unknowns have these weights: C⁻ᵀ of them.
    pub(super) fn weights(&self, graph: &mut Graph, tape: &mut Tape, slopes: Vec<ExprId>) -> Vec<ExprId> {
        match &self.closing {
            Closing::Factorised { lower, diagonal, .. } => {
                substituted(graph, tape, (lower, diagonal), slopes)
            }
            // which is symmetric
            Closing::DiagonalAndOne { inverse, .. } => inverse.times(graph, tape, slopes),
            Closing::OneByOne { eliminated, .. } => {
                let zero = graph.zero();
                let pushing = |variable: &Eliminated<usize>| {
                    variable.unknown.map_or(zero, |(unknown, _)| slopes[unknown])
                };
                let forces: Vec<ExprId> = eliminated.iter().map(pushing).collect();
                let motions = vec![zero; forces.len()];
                let Pushed { values, pushes } = Pushed::by(graph, tape, eliminated, (&forces, &motions));
                let of_forces = eliminated.iter().map(|variable| values[variable.place]);
                let mut weights: Vec<ExprId> = of_forces.collect();
                // the forces that carry them, by articulated inertias
                for Eliminated { place, inertias, unknown, .. } in eliminated {
                    let mut force = vec![pushes[*place]];
                    for (p, inertia) in inertias {
                        let inertia = tape.known_output(graph, *inertia);
                        force.push(graph.formula(-(inertia * values[*p])));
                    }
                    weights.push(if unknown.is_some() { zero } else { graph.sum(&force) });
                }
                weights
            }
            Closing::Inverted { rows, .. } => {
                let rows: Matrix = rows.iter().filter_map(|row| tape.outputs(row)).collect();
                multiplied(graph, tape, &Graph::transposed(&rows), &slopes)
            }
            Closing::Pivoted { matrix, .. } => {
                let matrix: Matrix = matrix.iter().filter_map(|row| tape.outputs(row)).collect();
                self.pivoted(graph, tape, Graph::transposed(&matrix), slopes)
            }
        }
    }

    fn pivoted(&self, graph: &mut Graph, tape: &mut Tape, matrix: Matrix, right: Vec<ExprId>) -> Vec<ExprId> {
        let unknowns: Vec<SymbolId> = self.unknowns.iter().map(|_| graph.new_symbol("")).collect();
        let solution = unknowns.iter().map(|unknown| graph.symbol(*unknown)).collect();
        tape.procedure.definitions.push(Definition::Solve { unknowns, matrix, right });
        solution
    }
}

impl DiagonalAndOne {
    /// The unknowns for another right-hand side than that of the solution.
    fn times(&self, graph: &mut Graph, tape: &mut Tape, right: Vec<ExprId>) -> Vec<ExprId> {
        let Self { hanging, rest, over, along, weight } = self;
        let hanging: Vec<Hanging<ExprId>> =
            hanging.iter().map(|gone| gone.map(|place| tape.known_output(graph, place))).collect();
        let (over, along) = (tape.outputs(over).unwrap_or_default(), tape.outputs(along).unwrap_or_default());
        let weight = tape.known_output(graph, *weight);
        let mut named = |graph: &mut Graph, value: ExprId| tape.procedure.define(graph, "", value);
        let right: Vec<ExprId> = right.into_iter().map(|entry| named(graph, entry)).collect();
        let mut carried = right.clone();
        for gone in &hanging {
            gone.carried(graph, &mut carried);
        }
        let forces: Vec<ExprId> = rest.iter().map(|place| named(graph, carried[*place])).collect();
        let weighed: Vec<ExprId> = along
            .iter()
            .map(|entry| {
                let value = graph.formula(weight * entry);
                named(graph, value)
            })
            .collect();
        let reached = graph.inner_product(&weighed, &forces);
        let reached = named(graph, reached);
        let mut values = right.clone();
        for (((place, force), over), along) in rest.iter().zip(&forces).zip(&over).zip(&along) {
            let value = graph.formula(force * over + along * reached);
            values[*place] = named(graph, value);
        }
        for gone in &hanging {
            let value = gone.value(graph, &right, &values);
            values[gone.place] = named(graph, value);
        }
        values
    }
}

/// Rows of C⁻¹, or of its transpose, times a right-hand side. From the left nothing comes by way of the unknowns that
/// have no rows.
fn multiplied(graph: &mut Graph, tape: &mut Tape, rows: &[Vec<ExprId>], right: &[ExprId]) -> Vec<ExprId> {
    let right: Vec<ExprId> = right.iter().map(|entry| tape.procedure.define(graph, "", *entry)).collect();
    let mut found = Vec::with_capacity(rows.len());
    for row in rows {
        let value = graph.inner_product(row, &right[..row.len()]);
        found.push(tape.procedure.define(graph, "", value));
    }
    found
}

/// The solution of L D Lᵀ x = right.
fn substituted(
    graph: &mut Graph,
    tape: &mut Tape,
    (lower, diagonal): (&[Range<usize>], &Range<usize>),
    right: Vec<ExprId>,
) -> Vec<ExprId> {
    let lower: Matrix = lower.iter().filter_map(|row| tape.outputs(row)).collect();
    let diagonal = tape.outputs(diagonal).unwrap_or_default();
    let one = graph.one();
    let mut solution = right;
    // L z = right
    for i in 0..solution.len() {
        let known = graph.inner_product(&lower[i], &solution[..i]);
        let value = graph.formula(solution[i] - known);
        solution[i] = tape.procedure.define(graph, "", value);
    }
    // Lᵀ x = D⁻¹ z
    for i in (0..solution.len()).rev() {
        let below: Vec<ExprId> = lower[i + 1..].iter().map(|row| row[i]).collect();
        let known = graph.inner_product(&below, &solution[i + 1..]);
        let inverse = graph.formula(one / diagonal[i]);
        let inverse = tape.procedure.define(graph, "", inverse);
        let value = graph.formula(solution[i] * inverse - known);
        solution[i] = tape.procedure.define(graph, "", value);
    }
    solution
}

/// Variables that were eliminated one by one, pushed and moved otherwise.
struct Pushed {
    /// The variables.
    values: Vec<ExprId>,
    /// What pushes each when it leaves.
    pushes: Vec<ExprId>,
}

impl Pushed {
    /// By forces on the variables, and by motions beside those by others, both in the order in which they leave.
    fn by(
        graph: &mut Graph,
        tape: &mut Tape,
        eliminated: &[Eliminated<usize>],
        (forces, motions): (&[ExprId], &[ExprId]),
    ) -> Self {
        let (zero, one) = (graph.zero(), graph.one());
        let places = eliminated.first().map_or(0, |last| last.place + 1);
        let mut terms: Vec<Vec<ExprId>> = vec![Vec::new(); places];
        let mut pushes = vec![zero; places];
        let mut rest = vec![zero; places];
        // what pushes a variable pushes those that it is given by
        for (Eliminated { place, by, inertias, unknown }, (force, motion)) in
            eliminated.iter().zip(forces.iter().zip(motions))
        {
            terms[*place].push(*force);
            let motion = tape.procedure.define(graph, "", *motion);
            for (p, inertia) in inertias.iter().filter(|_| motion != zero) {
                let inertia = tape.known_output(graph, *inertia);
                terms[*p].push(graph.formula(-(inertia * motion)));
            }
            let push = graph.sum(&terms[*place]);
            let push = tape.procedure.define(graph, "", push);
            for (p, c) in by.iter().filter(|_| push != zero) {
                let c = tape.known_output(graph, *c);
                terms[*p].push(graph.formula(c * push));
            }
            pushes[*place] = push;
            rest[*place] = match unknown {
                Some((_, pivot)) => {
                    let pivot = tape.known_output(graph, *pivot);
                    let inverse = graph.formula(one / pivot);
                    let inverse = tape.procedure.define(graph, "", inverse);
                    graph.formula(push * inverse)
                }
                None => motion,
            };
        }
        let mut values = rest;
        for Eliminated { place, by, .. } in eliminated.iter().rev() {
            let mut sum = vec![values[*place]];
            for (p, c) in by {
                let c = tape.known_output(graph, *c);
                sum.push(graph.formula(c * values[*p]));
            }
            let value = graph.sum(&sum);
            values[*place] = tape.procedure.define(graph, "", value);
        }
        Self { values, pushes }
    }
}

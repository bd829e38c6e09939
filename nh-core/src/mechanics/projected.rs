//! Lagrange–d'Alembert equations with multipliers on all of E: the saddle form, mathematics (9).

use super::constrained_inverse::ConstrainedInverse;
use super::euler_lagrange::LagrangianSystem;
use super::factorisation::Factorisation;
use super::free_direction::named;
use super::lone_constraint::LoneConstraint;
use super::orthogonal_constraints::Touching;
use super::pair::Pair;
use super::procedure::{Definition, Procedure};
use super::symmetric_solve::{Definiteness, uncoupled};
use crate::algebra::{Accuracy, Facts, Graph, Matrix, Substitution};
use crate::id::{ExprId, SymbolId};

/// Where there are more constraints than this, it matters what they couple.
const FEW: usize = 4;
/// So many times fewer velocities are coupled by a mass matrix that stays by itself.
const FEWER: usize = 4;

/// `W ẏ − Jᵀ λ = force`, `J ẏ = bias`.
#[derive(Clone, Debug)]
pub struct SaddleEquations {
    /// W_{αβ} = ∂²L/∂y^α∂y^β.
    pub mass: Matrix,
    /// Υ − h.
    pub force: Vec<ExprId>,
    /// J^A_α = ∂φ^A/∂y^α: a row for each constraint.
    pub jacobian: Matrix,
    /// −(ρ y)^i ∂_iφ − ∂_tφ − ż ∂_zφ.
    pub bias: Vec<ExprId>,
    /// ẋ^i = ρ^i_α y^α.
    pub rates: Vec<ExprId>,
}

/// Derives the equations for constraints φ^A(t, x, y, z) = 0.
pub fn saddle_equations(
    graph: &mut Graph,
    system: &LagrangianSystem,
    residuals: &[ExprId],
) -> SaddleEquations {
    let velocity = system.algebroid.velocity(graph);
    let balance = system.force_balance(graph, &velocity, &mut Substitution::new([]));
    let velocities = system.algebroid.velocities.clone();
    let mut mass: Matrix = Vec::with_capacity(velocities.len());
    for (alpha, momentum) in balance.momenta.iter().enumerate() {
        let row: Vec<ExprId> = velocities
            .iter()
            .enumerate()
            .map(|(beta, symbol)| {
                // W is symmetric: the lower triangle repeats the upper
                if beta < alpha {
                    return mass[beta][alpha];
                }
                let entry = graph.partial(*momentum, *symbol);
                graph.simplify(entry)
            })
            .collect();
        mass.push(row);
    }
    let force = negated(graph, &balance.rest);
    let jacobian: Matrix = residuals
        .iter()
        .map(|residual| {
            velocities
                .iter()
                .map(|symbol| {
                    let entry = graph.partial(*residual, *symbol);
                    graph.simplify(entry)
                })
                .collect()
        })
        .collect();
    let mut along = system.algebroid.along(graph, &velocity, &system.clock);
    let change = along.apply_all(graph, residuals);
    let bias = negated(graph, &change);
    let rates = system.algebroid.rates(graph, &velocity);
    let rates = rates.into_iter().map(|rate| graph.simplify(rate)).collect();
    SaddleEquations { mass, force, jacobian, bias, rates }
}

fn is_diagonal(graph: &Graph, matrix: &Matrix) -> bool {
    let entries =
        matrix.iter().enumerate().flat_map(|(i, row)| row.iter().enumerate().map(move |(j, e)| (i, j, e)));
    entries.into_iter().all(|(i, j, entry)| i == j || graph.vanishes_by_identity(*entry))
}

fn negated(graph: &mut Graph, list: &[ExprId]) -> Vec<ExprId> {
    list.iter()
        .map(|entry| {
            let negative = graph.formula(-entry);
            graph.simplify(negative)
        })
        .collect()
}

/// The multipliers of a block where they are short and lose nothing.
fn closed_form(graph: &mut Graph, matrix: &Matrix, right: &[ExprId]) -> Option<Vec<ExprId>> {
    match *right {
        [only] => Some(vec![graph.formula(only / matrix[0][0])]),
        // where the constraints are nearly dependent it loses as many digits again
        [first, second] if graph.accuracy() == Accuracy::Fast => {
            let pair = Pair { matrix: [matrix[0][0], matrix[0][1], matrix[1][1]], right: [first, second] };
            pair.simplified(graph).map(|solved| solved.to_vec())
        }
        _ => None,
    }
}

impl SaddleEquations {
    /// The saddle matrix [[W, −Jᵀ], [J, 0]], whose regularity is that of the system
    /// (CLMM (7.5) where W is invertible).
    pub fn matrix(&self, graph: &mut Graph) -> Matrix {
        let zero = graph.zero();
        let constraints = self.jacobian.len();
        let mut rows: Matrix = Vec::new();
        for (alpha, row) in self.mass.iter().enumerate() {
            let mut row = row.clone();
            row.extend(self.jacobian.iter().map(|constraint| graph.formula(-constraint[alpha])));
            rows.push(row);
        }
        for constraint in &self.jacobian {
            let mut row = constraint.clone();
            row.extend(std::iter::repeat_n(zero, constraints));
            rows.push(row);
        }
        rows
    }

    /// The same equations with the constraints weighed into the mass matrix, W + Jᵀ R J and
    /// force + Jᵀ R bias, which changes neither ẏ nor λ, because J ẏ = bias.
    ///
    /// W may be singular, or nearly so, along directions that the constraints forbid; what is
    /// factorised here is definite wherever the kinetic energy is positive on D. The weights
    /// R_A = 1 / Σ_α (J^A_α)² / W_αα carry the units of W.
    #[must_use]
    pub fn augmented(&self, graph: &mut Graph, procedure: &mut Procedure) -> Self {
        let weights: Vec<ExprId> = self
            .jacobian
            .iter()
            .map(|row| {
                let mut terms: Vec<ExprId> = Vec::new();
                for (alpha, entry) in row.iter().enumerate() {
                    if !graph.is_literal_zero(self.mass[alpha][alpha]) {
                        let square = graph.square(*entry);
                        terms.push(graph.formula(square / self.mass[alpha][alpha]));
                    }
                }
                let sum = graph.sum(&terms);
                let one = graph.one();
                let weight = if graph.zero_test(sum).is_zero() { one } else { graph.formula(one / sum) };
                // the squares of a unit vector are one: what they do not leave need not cancel later. Brought over
                // a common denominator, inertias that are far apart would lose digits.
                let short = graph.simplify(weight);
                let is_shorter = graph.operation_count(&[short]) < graph.operation_count(&[weight]);
                let weight =
                    if is_shorter && graph.error_growth(short, weight) <= 1.0 { short } else { weight };
                procedure.define(graph, "weight", weight)
            })
            .collect();
        let mut result = self.clone();
        for ((row, weight), bias) in self.jacobian.iter().zip(weights).zip(&self.bias) {
            for (alpha, entry) in row.iter().enumerate() {
                let weighed = graph.formula(weight * entry);
                result.force[alpha] = graph.formula(result.force[alpha] + weighed * bias);
                for (cell, other) in result.mass[alpha].iter_mut().zip(row) {
                    *cell = graph.formula(*cell + weighed * other);
                }
            }
        }
        result
    }

    /// Whether all weights are finite where no constraint vanishes. Where one moves coordinates without inertia alone, as
    /// those of a contact, it has none; that may be so at a place, such as where a coin stands upright on top of a cylinder.
    fn is_weighed_everywhere(&self, graph: &mut Graph) -> bool {
        let nothing = Facts::default();
        self.jacobian.iter().all(|row| {
            let (mut inert, mut massless) = (Vec::new(), false);
            for (alpha, entry) in row.iter().enumerate().filter(|(_, entry)| !graph.is_literal_zero(**entry))
            {
                if graph.is_literal_zero(self.mass[alpha][alpha]) {
                    massless = true;
                } else {
                    inert.push(*entry);
                }
            }
            let squares: Vec<ExprId> = inert.iter().map(|entry| graph.square(*entry)).collect();
            let sum = graph.sum(&squares);
            let sum = graph.simplify(sum);
            !massless
                || inert.is_empty()
                || inert.iter().chain([&sum]).any(|entry| graph.vanishes_nowhere(*entry, &nothing))
        })
    }

    /// ẏ and λ, as intermediate results of the procedure; `definiteness` judges mass matrices.
    ///
    /// By (10): λ = (J W⁻¹ Jᵀ)⁻¹ (bias − J W⁻¹ force), with one factorisation of W where W is definite, and
    /// diagonal or much sparser than with constraints in it, of the augmented matrix where that is definite, and with constraints made
    /// orthogonal; else the saddle system is solved with numerical pivoting.
    pub fn solve(
        &self,
        graph: &mut Graph,
        definiteness: impl Fn(&Graph, &Matrix) -> Definiteness,
        procedure: &mut Procedure,
    ) -> (Vec<ExprId>, Vec<ExprId>) {
        let known = procedure.solved.len();
        if self.is_by_itself(graph) && definiteness(graph, &self.mass) == Definiteness::Definite {
            let (values, multipliers, rows) = self.solve_by_complement(graph, procedure);
            return (self.noted(graph, values, (rows, known), procedure), multipliers);
        }
        if !self.is_weighed_everywhere(graph) {
            return self.solve_pivoted(graph, procedure);
        }
        let mut trial = procedure.clone();
        let augmented = self.augmented(graph, &mut trial);
        let written_out = self.augmented(graph, &mut Procedure::inline());
        if definiteness(graph, &written_out.mass) == Definiteness::Definite {
            *procedure = trial;
            let (values, multipliers, rows) = augmented.solve_by_complement(graph, procedure);
            // what is weighed in adds nothing to the rows
            return (self.noted(graph, values, (rows, known), procedure), multipliers);
        }
        self.solve_pivoted(graph, procedure)
    }

    /// The accelerations as intermediate results, with the rows that f and b are mapped to them by, where these are known, in
    /// place of what was noted of parts of the equations.
    fn noted(
        &self,
        graph: &mut Graph,
        values: Vec<ExprId>,
        (rows, known): (Matrix, usize),
        procedure: &mut Procedure,
    ) -> Vec<ExprId> {
        if rows.is_empty() {
            return values;
        }
        procedure.solved.truncate(known);
        let values = named(graph, procedure, "y_dot", values);
        self.note_inverse(graph, &values, rows, procedure);
        values
    }

    /// ẏ, λ, and the rows that f and b are mapped to ẏ by; none where they are not made of orthogonal constraints.
    fn solve_by_complement(
        &self,
        graph: &mut Graph,
        procedure: &mut Procedure,
    ) -> (Vec<ExprId>, Vec<ExprId>, Matrix) {
        // 1. W = factorised
        let factors = Factorisation::of(graph, &self.mass, procedure, "w");
        // 2. free = W⁻¹ force, reach = W⁻¹ Jᵀ
        let free = factors.solve(graph, &self.force, procedure, "free");
        if self.jacobian.is_empty() {
            return (free, Vec::new(), Vec::new());
        }
        let reach: Matrix =
            self.jacobian.iter().map(|row| factors.solve(graph, row, procedure, "reach")).collect();
        // 3. (J W⁻¹ Jᵀ) λ = bias − J free
        let mut complement: Matrix = Vec::with_capacity(reach.len());
        for (a, row) in self.jacobian.iter().enumerate() {
            let entries: Vec<ExprId> = (0..reach.len())
                .map(|b| if b < a { complement[b][a] } else { graph.inner_product(row, &reach[b]) })
                .collect();
            complement.push(entries);
        }
        let right: Vec<ExprId> = self
            .jacobian
            .iter()
            .zip(&self.bias)
            .map(|(row, bias)| {
                let reached = graph.inner_product(row, &free);
                graph.formula(bias - reached)
            })
            .collect();
        // 4. ẏ = free + W⁻¹ Jᵀ λ, for constraints that do not touch each other one by one
        let mut accelerations = free;
        let mut multipliers = right.clone();
        let sizes = [self.mass.len(), self.jacobian.len()];
        let mut inverse = ConstrainedInverse::of(graph, &factors, sizes, procedure);
        for block in uncoupled(graph, &complement) {
            let pick = |rows: &Matrix| -> Matrix { block.iter().map(|a| rows[*a].clone()).collect() };
            let outer: Vec<ExprId> = block.iter().map(|a| right[*a]).collect();
            let inner = Graph::submatrix(&complement, &block);
            let touching = |equations: &Self| Touching {
                jacobian: pick(&equations.jacobian),
                reach: pick(&reach),
                bias: block.iter().map(|a| equations.bias[*a]).collect(),
            };
            let solved = closed_form(graph, &inner, &outer).or_else(|| {
                // neighbours of neighbours touch nothing here that they would touch once they are orthogonal
                touching(self).is_sparse(graph).then(|| {
                    let factors = Factorisation::of(graph, &inner, procedure, "s");
                    factors.solve(graph, &outer, procedure, "lambda")
                })
            });
            let found = if let Some(solved) = solved {
                let named: Vec<ExprId> = block
                    .iter()
                    .zip(solved)
                    .map(|(a, value)| procedure.define(graph, &format!("lambda_{a}"), value))
                    .collect();
                self.react(graph, (&block, &pick(&reach)), &named, &mut accelerations, procedure);
                // a constraint by itself may be solved for without pivots of W, by which its rows would divide
                inverse = None;
                named
            } else {
                let (found, orthogonal) = touching(self).impose(graph, &mut accelerations, procedure);
                inverse = inverse.map(|inverse| inverse.without(graph, &block, &orthogonal, procedure));
                found
            };
            for (a, value) in block.iter().zip(found) {
                multipliers[*a] = value;
            }
        }
        let rows = inverse.map(|inverse| inverse.rows(graph, procedure));
        (accelerations, multipliers, rows.unwrap_or_default())
    }

    /// Adds the reactions of a block of constraints, with their W⁻¹ Jᵀ, to the accelerations.
    fn react(
        &self,
        graph: &mut Graph,
        (block, reach): (&[usize], &Matrix),
        multipliers: &[ExprId],
        accelerations: &mut [ExprId],
        procedure: &mut Procedure,
    ) {
        if let Some(lone) = self.lone(graph, block) {
            let values = lone.accelerations(graph, procedure);
            for (alpha, value) in lone.members.iter().zip(values) {
                accelerations[*alpha] = value;
            }
            return;
        }
        for (alpha, acceleration) in accelerations.iter_mut().enumerate() {
            let column: Vec<ExprId> = reach.iter().map(|row| row[alpha]).collect();
            let reaction = graph.inner_product(&column, multipliers);
            *acceleration = graph.formula(*acceleration + reaction);
        }
    }

    /// The only constraint of a block, where the level of accuracy asks for more than its multiplier.
    fn lone(&self, graph: &Graph, block: &[usize]) -> Option<LoneConstraint> {
        let [a] = block else { return None };
        if graph.accuracy() == Accuracy::Fast {
            return None;
        }
        LoneConstraint::of(graph, (&self.mass, &self.jacobian), (&self.force, &self.bias), *a)
    }

    /// Whether W is factorised without the constraints: where it is diagonal, or couples few velocities where many
    /// constraints, weighed into it, would couple all of a chain.
    fn is_by_itself(&self, graph: &Graph) -> bool {
        if self.jacobian.is_empty() || is_diagonal(graph, &self.mass) {
            return true;
        }
        if self.jacobian.len() <= FEW {
            return false;
        }
        let largest = |matrix: &Matrix| uncoupled(graph, matrix).iter().map(Vec::len).max().unwrap_or(0);
        let mut weighed = self.mass.clone();
        for row in &self.jacobian {
            let touched = || row.iter().enumerate().filter(|(_, entry)| !graph.is_literal_zero(**entry));
            for (alpha, entry) in touched() {
                touched().for_each(|(beta, _)| weighed[alpha][beta] = *entry);
            }
        }
        FEWER * largest(&self.mass) <= largest(&weighed)
    }

    /// The mass matrix that [`Self::solve`] factorises, W or W + JᵀRJ; `None` where it pivots.
    pub fn factorised(
        &self,
        graph: &mut Graph,
        definiteness: impl Fn(&Graph, &Matrix) -> Definiteness,
    ) -> Option<Matrix> {
        if self.is_by_itself(graph) && definiteness(graph, &self.mass) == Definiteness::Definite {
            return Some(self.mass.clone());
        }
        if !self.is_weighed_everywhere(graph) {
            return None;
        }
        let weighed = self.augmented(graph, &mut Procedure::inline()).mass;
        (definiteness(graph, &weighed) == Definiteness::Definite).then_some(weighed)
    }

    /// ẏ and λ by numerical pivoting, whatever the matrices are.
    pub fn solve_pivoted(&self, graph: &mut Graph, procedure: &mut Procedure) -> (Vec<ExprId>, Vec<ExprId>) {
        let matrix = self.matrix(graph);
        let right = self.force.iter().chain(&self.bias).copied().collect();
        let unknowns: Vec<SymbolId> =
            (0..matrix.len()).map(|index| graph.new_symbol(format!("saddle{index}"))).collect();
        let mut solution: Vec<ExprId> = unknowns.iter().map(|symbol| graph.symbol(*symbol)).collect();
        procedure.definitions.push(Definition::Solve { unknowns, matrix, right });
        let multipliers = solution.split_off(self.mass.len());
        (solution, multipliers)
    }
}

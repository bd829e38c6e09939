//! A constraint that touches no other, between velocities of their own inertias.
//!
//! (f_α + λ g_α) / W_α cancels where one inertia is much smaller than the others: the reaction then balances
//! the force along it. With the multiplier of mathematics (10) put in, what cancels identically is left out, (10′):
//!
//! `N ẏ_α = Σ_{β≠α} W_{(αβ)} g_β (g_β f_α − g_α f_β) + W_{(α)} g_α b`, `N = Σ_α W_{(α)} g_α²`.

use super::free_direction::named;
use super::procedure::Procedure;
use super::projected::SaddleEquations;
use crate::algebra::{Graph, Matrix};
use crate::id::ExprId;

/// Products of so many inertias less one stay in the range of single precision, for inertias over
/// eighteen decades.
const MOST: usize = 3;

/// One row of the constraints, and the equations that it touches.
#[derive(Clone, Debug)]
pub(super) struct LoneConstraint {
    /// The velocities whose coefficient is not zero.
    pub(super) members: Vec<usize>,
    inertias: Vec<ExprId>,
    force: Vec<ExprId>,
    row: Vec<ExprId>,
    bias: ExprId,
}

impl LoneConstraint {
    /// The row `a`; `None` where it shares velocities with other rows, W is not diagonal there or the
    /// same for several velocities, or the constraint has too many terms.
    pub(super) fn of(
        graph: &Graph,
        (mass, jacobian): (&Matrix, &Matrix),
        (force, bias): (&[ExprId], &[ExprId]),
        a: usize,
    ) -> Option<Self> {
        let vanishes = |entry: ExprId| graph.vanishes_by_identity(entry);
        let members: Vec<usize> =
            (0..mass.len()).filter(|alpha| !graph.is_literal_zero(jacobian[a][*alpha])).collect();
        let is_alone = |alpha: &usize| {
            let is_diagonal = (0..mass.len()).all(|beta| beta == *alpha || vanishes(mass[*alpha][beta]));
            is_diagonal && (0..jacobian.len()).all(|b| b == a || vanishes(jacobian[b][*alpha]))
        };
        let inertias: Vec<ExprId> = members.iter().map(|alpha| mass[*alpha][*alpha]).collect();
        let all_alike = inertias.len() > 1 && inertias.windows(2).all(|pair| pair[0] == pair[1]);
        if all_alike || !(1..=MOST).contains(&members.len()) || !members.iter().all(is_alone) {
            return None;
        }
        Some(Self {
            inertias,
            force: members.iter().map(|alpha| force[*alpha]).collect(),
            row: members.iter().map(|alpha| jacobian[a][*alpha]).collect(),
            bias: bias[a],
            members,
        })
    }

    /// ẏ_α of its members, as intermediate results.
    pub(super) fn accelerations(&self, graph: &mut Graph, procedure: &mut Procedure) -> Vec<ExprId> {
        // a velocity by itself is what the constraint says
        if let [entry] = self.row.as_slice() {
            return vec![graph.formula(self.bias / entry)];
        }
        let force: Vec<ExprId> =
            self.force.iter().map(|entry| procedure.define(graph, "force", *entry)).collect();
        // 1. N
        let others = self.others(graph);
        let squares: Vec<ExprId> = self.row.iter().map(|entry| graph.square(*entry)).collect();
        let norm = graph.inner_product(&others, &squares);
        let one = graph.one();
        let over = graph.formula(one / norm);
        let over = procedure.define(graph, "over_norm", over);
        // 2. of f and b, and of each of their components by itself
        let values = self.response(graph, over, &force, procedure);
        let values = named(graph, procedure, "y_dot", values);
        let equations = self.equations(graph);
        let mut columns = Vec::with_capacity(force.len() + 1);
        for unit in equations.units(graph) {
            let alone = Self { force: unit.force.clone(), bias: unit.bias[0], ..self.clone() };
            columns.push(alone.response(graph, over, &unit.force, &mut Procedure::inline()));
        }
        equations.note_inverse(graph, &values, Graph::transposed(&columns), procedure);
        values
    }

    /// The equations of its members.
    fn equations(&self, graph: &mut Graph) -> SaddleEquations {
        let mut mass = graph.identity(self.members.len());
        for (alpha, inertia) in self.inertias.iter().enumerate() {
            mass[alpha][alpha] = *inertia;
        }
        SaddleEquations {
            mass,
            force: self.force.clone(),
            jacobian: vec![self.row.clone()],
            bias: vec![self.bias],
            rates: Vec::new(),
        }
    }

    /// W_(α).
    fn others(&self, graph: &mut Graph) -> Vec<ExprId> {
        (0..self.members.len()).map(|alpha| self.inertias_without(graph, &[alpha])).collect()
    }

    /// ẏ_α, with N⁻¹ at hand.
    fn response(
        &self,
        graph: &mut Graph,
        over: ExprId,
        force: &[ExprId],
        procedure: &mut Procedure,
    ) -> Vec<ExprId> {
        let n = self.members.len();
        let others = self.others(graph);
        // 1. what forces push out of the constraint, for every pair
        let mut terms: Vec<Vec<ExprId>> = vec![Vec::new(); n];
        for alpha in 0..n {
            for beta in alpha + 1..n {
                let moment = graph.formula(self.row[alpha] * force[beta] - self.row[beta] * force[alpha]);
                let moment = procedure.define(graph, "moment", moment);
                let weight = self.inertias_without(graph, &[alpha, beta]);
                let turn = graph.formula(weight * over * moment);
                let turn = procedure.define(graph, "turn", turn);
                terms[beta].push(graph.formula(self.row[alpha] * turn));
                terms[alpha].push(graph.formula(-(self.row[beta] * turn)));
            }
        }
        // 2. what the constraint asks for by itself
        if !graph.is_literal_zero(self.bias) {
            let pull = graph.formula(self.bias * over);
            let pull = procedure.define(graph, "pull", pull);
            for (alpha, terms) in terms.iter_mut().enumerate() {
                terms.push(graph.formula(others[alpha] * self.row[alpha] * pull));
            }
        }
        terms.iter().map(|terms| graph.sum(terms)).collect()
    }

    /// The product of the inertias, some left out.
    fn inertias_without(&self, graph: &mut Graph, left_out: &[usize]) -> ExprId {
        let mut product = graph.one();
        for (alpha, inertia) in self.inertias.iter().enumerate() {
            if !left_out.contains(&alpha) {
                product = graph.formula(product * inertia);
            }
        }
        product
    }
}

//! The nonholonomic bracket in the variables of the state: mathematics (15), (17) and (18).

use crate::algebra::{Graph, Matrix};
use crate::geometry::ConstraintDistribution;
use crate::id::{ExprId, Id, SymbolId};
use crate::mechanics::{Definiteness, LagrangianSystem, Procedure, ReducedEquations, SaddleEquations};

/// The almost-Poisson structure Π of a constrained system, in the coordinates (x, v) of the state:
/// the velocities of D in the adapted formulation, all of E in the projected one.
///
/// Antisymmetric, with the Leibniz rule, and in general without the Jacobi identity.
#[derive(Clone, Debug)]
pub struct NonholonomicBracket {
    /// The base coordinates.
    pub coordinates: Vec<SymbolId>,
    /// The velocities of the state.
    pub velocities: Vec<SymbolId>,
    /// ρ^i_a: a row for each coordinate, a column for each section of the state.
    anchor: Matrix,
    /// p_γ [B_a, B_b]^γ.
    curl: Matrix,
    /// ∂_iπ_a: a row for each section, a column for each coordinate.
    gradients: Matrix,
    /// ∂_iφ^A: a row for each constraint that the state does not solve, a column for each coordinate.
    constraint_gradients: Matrix,
    /// The matrix of the equations for accelerations and multipliers.
    saddle: SaddleEquations,
}

impl NonholonomicBracket {
    /// On D, in its basis.
    pub fn adapted(
        graph: &mut Graph,
        system: &LagrangianSystem,
        distribution: &ConstraintDistribution,
        equations: &ReducedEquations,
    ) -> Self {
        let algebroid = &system.algebroid;
        let momenta = momenta_on(graph, system, distribution);
        let sections = distribution.sections();
        let columns: Matrix = sections.iter().map(|b| algebroid.anchor.vector_field(graph, b)).collect();
        let curl = antisymmetric(graph, sections.len(), |graph, a, b| {
            let bracket = algebroid.bracket(graph, &sections[a], &sections[b]);
            graph.inner_product(&momenta, &bracket)
        });
        let projected = graph.image(&sections, &momenta);
        let coordinates = algebroid.anchor.coordinates.clone();
        let zero = graph.zero();
        let anchor =
            (0..coordinates.len()).map(|i| columns.iter().map(|column| column[i]).collect()).collect();
        Self {
            gradients: gradients(graph, &projected, &coordinates),
            anchor,
            curl,
            constraint_gradients: Matrix::new(),
            saddle: SaddleEquations {
                mass: equations.mass.clone(),
                force: vec![zero; sections.len()],
                jacobian: Matrix::new(),
                bias: Vec::new(),
                rates: Vec::new(),
            },
            coordinates,
            velocities: distribution.independent.clone(),
        }
    }

    /// On all of E, where every φ^A is a Casimir function: no basis of D is needed.
    pub fn projected(
        graph: &mut Graph,
        system: &LagrangianSystem,
        residuals: &[ExprId],
        equations: &SaddleEquations,
    ) -> Self {
        let algebroid = &system.algebroid;
        let momenta = system.momenta(graph);
        let mut curl = vec![vec![graph.zero(); algebroid.rank()]; algebroid.rank()];
        let brackets: Vec<_> = algebroid
            .structure
            .nonzero(graph)
            .map(|(alpha, beta, components)| (alpha, beta, components.to_vec()))
            .collect();
        for (alpha, beta, components) in brackets {
            let entry = graph.inner_product(&components, &momenta);
            curl[alpha.index()][beta.index()] = entry;
            curl[beta.index()][alpha.index()] = graph.formula(-entry);
        }
        let coordinates = algebroid.anchor.coordinates.clone();
        Self {
            gradients: gradients(graph, &momenta, &coordinates),
            anchor: algebroid.anchor.entries.clone(),
            curl,
            constraint_gradients: gradients(graph, residuals, &coordinates),
            saddle: equations.clone(),
            coordinates,
            velocities: algebroid.velocities.clone(),
        }
    }

    /// Π applied to a covector (∂/∂x components, then ∂/∂v components): the rates of coordinates and
    /// velocities under the function with this differential, mathematics (18).
    ///
    /// With S the inverse of the kinetic metric on D and M = W⁻¹Jᵀ(JW⁻¹Jᵀ)⁻¹, both by solving the
    /// saddle system: u = S g_v, ẋ = ρ u, and v̇ = S F − M ∂φ ẋ with
    /// F_a = −p([B_a, u]) − ẋ^i ∂_iπ_a + ρ^i_a (u^b ∂_iπ_b + (Mᵀg_v)_A ∂_iφ^A − g_i).
    pub fn sharp(
        &self,
        graph: &mut Graph,
        definiteness: impl Fn(&Graph, &Matrix) -> Definiteness,
        covector: (&[ExprId], &[ExprId]),
        procedure: &mut Procedure,
    ) -> (Vec<ExprId>, Vec<ExprId>) {
        let zero = graph.zero();
        // 1. u = S g_v and λ = −Mᵀ g_v
        let first = SaddleEquations {
            force: covector.1.to_vec(),
            bias: vec![zero; self.constraint_gradients.len()],
            ..self.saddle.clone()
        };
        let (velocity, multipliers) = first.solve(graph, &definiteness, procedure);
        let velocity: Vec<ExprId> =
            velocity.into_iter().map(|value| procedure.define(graph, "u", value)).collect();
        // 2. ẋ = ρ u
        let rates = graph.image(&self.anchor, &velocity);
        // 3. what pushes along each coordinate
        let mut pushes = Vec::with_capacity(rates.len());
        for (i, slope) in covector.0.iter().enumerate() {
            let column: Vec<ExprId> = self.gradients.iter().map(|row| row[i]).collect();
            let carried = graph.inner_product(&column, &velocity);
            let column: Vec<ExprId> = self.constraint_gradients.iter().map(|row| row[i]).collect();
            let reaction = graph.inner_product(&column, &multipliers);
            let push = graph.linear_combination(&[
                (1.into(), carried),
                ((-1).into(), reaction),
                ((-1).into(), *slope),
            ]);
            pushes.push(procedure.define(graph, "push", push));
        }
        // 4. v̇
        let mut force = Vec::with_capacity(velocity.len());
        for (a, (curl, gradient)) in self.curl.iter().zip(&self.gradients).enumerate() {
            let turned = graph.inner_product(curl, &velocity);
            let carried = graph.inner_product(gradient, &rates);
            let column: Vec<ExprId> = self.anchor.iter().map(|row| row[a]).collect();
            let pushed = graph.inner_product(&column, &pushes);
            force.push(graph.linear_combination(&[
                ((-1).into(), turned),
                ((-1).into(), carried),
                (1.into(), pushed),
            ]));
        }
        let bias = self
            .constraint_gradients
            .iter()
            .map(|row| {
                let change = graph.inner_product(row, &rates);
                graph.formula(-change)
            })
            .collect();
        let second = SaddleEquations { force, bias, ..self.saddle.clone() };
        let (accelerations, _) = second.solve(graph, &definiteness, procedure);
        (rates, accelerations)
    }
}

/// p_α = ∂L/∂y^α where the constraints hold, at y = B v + y₀.
pub(super) fn momenta_on(
    graph: &mut Graph,
    system: &LagrangianSystem,
    distribution: &ConstraintDistribution,
) -> Vec<ExprId> {
    let mut restriction = distribution.restriction(graph, &system.algebroid.velocities);
    let momenta = system.momenta(graph);
    momenta
        .into_iter()
        .map(|momentum| {
            let restricted = restriction.apply(graph, momentum);
            graph.simplify(restricted)
        })
        .collect()
}

/// ∂_if for each function and coordinate.
pub(super) fn gradients(graph: &mut Graph, functions: &[ExprId], coordinates: &[SymbolId]) -> Matrix {
    functions.iter().map(|f| coordinates.iter().map(|symbol| graph.partial(*f, *symbol)).collect()).collect()
}

/// The antisymmetric matrix with these entries above the diagonal.
pub(super) fn antisymmetric(
    graph: &mut Graph,
    size: usize,
    mut entry: impl FnMut(&mut Graph, usize, usize) -> ExprId,
) -> Matrix {
    let mut matrix = vec![vec![graph.zero(); size]; size];
    let pairs = (0..size).flat_map(|a| (a + 1..size).map(move |b| (a, b)));
    for (a, b) in pairs {
        let value = entry(graph, a, b);
        let value = graph.simplify(value);
        matrix[a][b] = value;
        matrix[b][a] = graph.formula(-value);
    }
    matrix
}

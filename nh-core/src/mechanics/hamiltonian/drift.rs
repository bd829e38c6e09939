//! R_L, what the motion has beyond the bracket with the energy: mathematics (28), CLMM section 7.

use super::bracket::{gradients, momenta_on};
use crate::algebra::{Graph, Matrix};
use crate::geometry::{Algebroid, ConstraintDistribution, Manifold};
use crate::id::{ExprId, SymbolId};
use crate::mechanics::{
    Definiteness, LagrangianSystem, Procedure, ReducedEquations, SaddleEquations, solve_symmetric,
};

/// R_L in (x, v), as a procedure's intermediate results.
#[derive(Debug)]
pub struct Drift {
    /// z: the part of the velocity that is orthogonal to D in the kinetic metric.
    pub normal: Vec<ExprId>,
    /// R_L(x^i) = ρ^i(z).
    pub rates: Vec<ExprId>,
    /// R_L(v^a).
    pub accelerations: Vec<ExprId>,
}

/// z = y₀ − B C⁻¹ Bᵀ W y₀, the same for all velocities in D of a system of mechanical type.
pub(super) fn normal_velocity(
    graph: &mut Graph,
    system: &LagrangianSystem,
    distribution: &ConstraintDistribution,
    mass: &Matrix,
    definiteness: Definiteness,
    procedure: &mut Procedure,
) -> Vec<ExprId> {
    let offset = &distribution.offset;
    if offset.iter().all(|entry| graph.vanishes_by_identity(*entry)) {
        return vec![graph.zero(); offset.len()];
    }
    // 1. W y₀, with W on the constraint manifold
    let mut restriction = distribution.restriction(graph, &system.algebroid.velocities);
    let momenta = system.momenta(graph);
    let mut weighed = Vec::with_capacity(momenta.len());
    for momentum in momenta {
        let mut terms = Vec::new();
        for (velocity, entry) in system.algebroid.velocities.iter().zip(offset) {
            let inertia = graph.partial(momentum, *velocity);
            let inertia = restriction.apply(graph, inertia);
            terms.push(graph.formula(inertia * entry));
        }
        weighed.push(graph.sum(&terms));
    }
    // 2. C s = Bᵀ W y₀
    let right: Vec<ExprId> = (0..distribution.rank())
        .map(|a| {
            let along = graph.inner_product(&distribution.section(a), &weighed);
            graph.simplify(along)
        })
        .collect();
    let along = solve_symmetric(graph, mass, &right, definiteness, procedure, "along");
    // 3. y₀ − B s
    let tangent = graph.image(&distribution.basis, &along);
    offset
        .iter()
        .zip(tangent)
        .map(|(offset, tangent)| {
            let rest = graph.formula(offset - tangent);
            let rest = graph.simplify(rest);
            procedure.define(graph, "normal", rest)
        })
        .collect()
}

/// dp(e_α, z) = z·ρ_α(p) − ρ(z)(p_α) − p([e_α, z]) for each α, with z of constant components.
fn curl_along(
    graph: &mut Graph,
    algebroid: &Algebroid,
    momenta: &[ExprId],
    slopes: &Matrix,
    normal: &[ExprId],
    rates: &[ExprId],
) -> Vec<ExprId> {
    let carried: Vec<ExprId> = (0..rates.len())
        .map(|i| {
            let column: Vec<ExprId> = slopes.iter().map(|row| row[i]).collect();
            graph.inner_product(&column, normal)
        })
        .collect();
    let forth = algebroid.anchor.pull_back(graph, &carried);
    let back = graph.image(slopes, rates);
    // C^γ_{αβ} z^β p_γ
    let bracket = algebroid.structure.bracket_term(graph, normal, momenta);
    (0..momenta.len())
        .map(|alpha| {
            graph.linear_combination(&[
                (1.into(), forth[alpha]),
                ((-1).into(), back[alpha]),
                ((-1).into(), bracket[alpha]),
            ])
        })
        .collect()
}

impl Drift {
    /// In a basis of D: C R_L(v) = dp̂(B_a, z) + Υ(B_a) − B_a·∂_tp̂, p̂ = p(t, x, Bv + y₀).
    pub fn adapted(
        graph: &mut Graph,
        system: &LagrangianSystem,
        distribution: &ConstraintDistribution,
        equations: &ReducedEquations,
        definiteness: Definiteness,
        procedure: &mut Procedure,
    ) -> Self {
        let algebroid = &system.algebroid;
        let normal = normal_velocity(graph, system, distribution, &equations.mass, definiteness, procedure);
        let rates = algebroid.rates(graph, &normal);
        let momenta = momenta_on(graph, system, distribution);
        let slopes = gradients(graph, &momenta, &algebroid.anchor.coordinates);
        let turned = curl_along(graph, algebroid, &momenta, &slopes, &normal, &rates);
        let mut restriction = distribution.restriction(graph, &algebroid.velocities);
        let forces = restriction.apply_all(graph, &system.forces);
        let mut total = Vec::with_capacity(turned.len());
        for ((turned, force), momentum) in turned.iter().zip(&forces).zip(&momenta) {
            let change = system.clock.rate(graph, *momentum);
            total.push(graph.linear_combination(&[
                (1.into(), *turned),
                (1.into(), *force),
                ((-1).into(), change),
            ]));
        }
        let force: Vec<ExprId> = (0..distribution.rank())
            .map(|a| {
                let mut terms = vec![graph.inner_product(&distribution.section(a), &total)];
                for value in system.forces_along(distribution.independent[a]) {
                    terms.push(restriction.apply(graph, value));
                }
                graph.sum(&terms)
            })
            .collect();
        let accelerations = if force.iter().all(|entry| graph.is_literal_zero(*entry)) {
            force
        } else {
            solve_symmetric(graph, &equations.mass, &force, definiteness, procedure, "beyond")
        };
        Self { normal, rates, accelerations }
    }

    /// On all of E, with W z = Jᵀν, J z = J y: W R_L(y) = dp(e_α, z) − ν_A ρ_α(φ^A) + Υ_α − ∂_tp_α + Jᵀλ
    /// where J R_L(y) = −ρ(z)φ − ∂_tφ.
    pub fn projected(
        graph: &mut Graph,
        system: &LagrangianSystem,
        (residuals, manifold): (&[ExprId], &Manifold),
        equations: &SaddleEquations,
        definiteness: impl Fn(&Graph, &Matrix) -> Definiteness,
        procedure: &mut Procedure,
    ) -> Self {
        let algebroid = &system.algebroid;
        let zero = graph.zero();
        let velocity = algebroid.velocity(graph);
        // 1. z and ν, zero where the constraints are homogeneous
        let degree = graph.image(&equations.jacobian, &velocity);
        let is_homogeneous = degree.iter().all(|value| manifold.zero_test(graph, *value).is_zero());
        let (normal, multipliers) = if is_homogeneous {
            (vec![zero; velocity.len()], vec![zero; degree.len()])
        } else {
            let split =
                SaddleEquations { force: vec![zero; velocity.len()], bias: degree, ..equations.clone() };
            let (normal, multipliers) = split.solve(graph, &definiteness, procedure);
            let normal = normal.into_iter().map(|z| procedure.define(graph, "normal", z)).collect();
            (normal, multipliers)
        };
        let rates = algebroid.rates(graph, &normal);
        // 2. the force
        let momenta = system.momenta(graph);
        let coordinates: &[SymbolId] = &algebroid.anchor.coordinates;
        let slopes = gradients(graph, &momenta, coordinates);
        let turned = curl_along(graph, algebroid, &momenta, &slopes, &normal, &rates);
        let inclines = gradients(graph, residuals, coordinates);
        let pushes: Vec<ExprId> = (0..coordinates.len())
            .map(|i| {
                let column: Vec<ExprId> = inclines.iter().map(|row| row[i]).collect();
                graph.inner_product(&column, &multipliers)
            })
            .collect();
        let pushes = algebroid.anchor.pull_back(graph, &pushes);
        let mut force = Vec::with_capacity(velocity.len());
        for alpha in 0..velocity.len() {
            let change = system.clock.rate(graph, momenta[alpha]);
            force.push(graph.linear_combination(&[
                (1.into(), turned[alpha]),
                ((-1).into(), pushes[alpha]),
                (1.into(), system.forces[alpha]),
                ((-1).into(), change),
            ]));
        }
        // 3. tangent to the constraints
        let bias: Vec<ExprId> = residuals
            .iter()
            .zip(&inclines)
            .map(|(residual, row)| {
                let moved = graph.inner_product(row, &rates);
                let change = system.clock.rate(graph, *residual);
                graph.formula(-(moved + change))
            })
            .collect();
        let accelerations = if force.iter().chain(&bias).all(|entry| graph.is_literal_zero(*entry)) {
            force
        } else {
            let beyond = SaddleEquations { force, bias, ..equations.clone() };
            beyond.solve(graph, &definiteness, procedure).0
        };
        Self { normal, rates, accelerations }
    }
}

//! The Legendre transformation of a constrained system, and Hamilton's equations on D*.

use super::bracket::{antisymmetric, gradients, momenta_on};
use super::drift::normal_velocity;
use crate::algebra::{Derivation, Graph, Matrix, Substitution, Verdict};
use crate::geometry::ConstraintDistribution;
use crate::id::{ExprId, SymbolId};
use crate::mechanics::{
    Definiteness, Definition, LagrangianSystem, Procedure, ReducedEquations, complete_lift, energy,
    solve_symmetric,
};

/// The Hamiltonian side: functions of (t, x, π) with π_a = B^α_a p_α on the constraint manifold.
#[derive(Clone, Debug)]
pub struct HamiltonianSide {
    /// The momenta π_a.
    pub momenta: Vec<SymbolId>,
    /// Outputs: π_a at a state.
    pub legendre: Procedure,
    /// Outputs: the velocities v^a of the state, from the momenta.
    pub inverse: Procedure,
    /// One output: h = E_L.
    pub hamiltonian: Procedure,
    /// Outputs: ẋ^i, then π̇_a: mathematics (16) where the constraints are linear.
    pub equations: Procedure,
    /// Outputs: the matrix of {·, ·}_nh in (x, π), row by row: mathematics (15), (17).
    pub bracket: Procedure,
    /// Outputs: R_L of mathematics (17) and (28), what the equations add to the bracket with h.
    pub drift: Procedure,
}

/// Why there is no Hamiltonian side in closed form.
#[derive(Clone, Debug)]
pub struct NoInverse {
    /// The momentum that is not affine in the velocities.
    pub momentum: ExprId,
    /// The velocity along which it belongs.
    pub velocity: SymbolId,
}

/// v in terms of π, as intermediate results of the procedure.
struct Inversion<'a> {
    system: &'a LagrangianSystem,
    distribution: &'a ConstraintDistribution,
    equations: &'a ReducedEquations,
    definiteness: Definiteness,
    /// π_a(t, x, v).
    projected: Vec<ExprId>,
    /// π_a where v = 0.
    at_rest: Vec<ExprId>,
    /// The momenta.
    symbols: Vec<SymbolId>,
    /// Calls of the user's methods, in the variables of the state.
    calls: &'a [Definition],
}

impl Inversion<'_> {
    /// C v = π − π|₀.
    fn velocities(&self, graph: &mut Graph, procedure: &mut Procedure) -> Vec<ExprId> {
        let right: Vec<ExprId> = self
            .symbols
            .iter()
            .zip(&self.at_rest)
            .map(|(symbol, offset)| {
                let momentum = graph.symbol(*symbol);
                graph.formula(momentum - offset)
            })
            .collect();
        let solved = solve_symmetric(graph, &self.equations.mass, &right, self.definiteness, procedure, "v");
        let names: Vec<String> =
            self.distribution.independent.iter().map(|v| graph.symbols()[*v].clone()).collect();
        solved.into_iter().zip(names).map(|(value, name)| procedure.define(graph, &name, value)).collect()
    }

    /// Functions of (t, x, v) as functions of (t, x, π).
    fn transformed(&self, graph: &mut Graph, functions: &[ExprId]) -> Procedure {
        let mut procedure = Procedure::default();
        let velocities = self.velocities(graph, &mut procedure);
        let images = self.distribution.independent.iter().copied().zip(velocities);
        let mut put = Substitution::new(images);
        for definition in self.calls {
            if let Definition::Call { symbol, method, arguments, derivatives } = definition {
                let arguments = put.apply_all(graph, arguments);
                let (symbol, method, derivatives) = (*symbol, method.clone(), derivatives.clone());
                procedure.definitions.push(Definition::Call { symbol, method, arguments, derivatives });
            }
        }
        procedure.outputs = put.apply_all(graph, functions);
        procedure
    }
}

/// Derives the Hamiltonian side in a basis of D; `calls` are those of the user's methods.
///
/// # Errors
/// Where the momenta are not affine in the velocities, so that the inverse has no closed form.
pub fn hamiltonian_side(
    graph: &mut Graph,
    system: &LagrangianSystem,
    distribution: &ConstraintDistribution,
    equations: &ReducedEquations,
    definiteness: Definiteness,
    calls: &[Definition],
) -> Result<HamiltonianSide, NoInverse> {
    // 1. π_a = B^α_a p_α, affine in v
    let momenta = momenta_on(graph, system, distribution);
    let sections = distribution.sections();
    let projected: Vec<ExprId> = sections
        .iter()
        .map(|section| {
            let momentum = graph.inner_product(section, &momenta);
            graph.simplify(momentum)
        })
        .collect();
    for (row, (momentum, velocity)) in
        equations.mass.iter().zip(projected.iter().zip(&distribution.independent))
    {
        if row.iter().any(|entry| graph.depends_on(*entry, &distribution.independent))
            && !is_constant_in(graph, row, &distribution.independent)
        {
            return Err(NoInverse { momentum: *momentum, velocity: *velocity });
        }
    }
    let names: Vec<String> = distribution
        .independent
        .iter()
        .map(|v| graph.free_name(&format!("p_{}", graph.symbols()[*v])))
        .collect();
    let symbols: Vec<SymbolId> = names.into_iter().map(|name| graph.new_symbol(name)).collect();
    let at_rest = projected.iter().map(|p| graph.at_zero(*p, &distribution.independent)).collect();
    let inversion =
        Inversion { system, distribution, equations, definiteness, projected, at_rest, symbols, calls };
    // 2. h, Hamilton's equations, the bracket
    let hamiltonian = hamiltonian(graph, &inversion);
    let rates = momentum_rates(graph, &inversion);
    let equations_of_motion: Vec<ExprId> = equations.rates.iter().copied().chain(rates).collect();
    let matrix = phase_bracket(graph, &inversion, &momenta);
    let velocities: Vec<ExprId> = distribution.independent.iter().map(|v| graph.symbol(*v)).collect();
    let equations = inversion.transformed(graph, &equations_of_motion);
    let bracket = inversion.transformed(graph, &matrix.concat());
    Ok(HamiltonianSide {
        drift: drift(graph, &inversion, &momenta),
        inverse: inversion.transformed(graph, &velocities),
        hamiltonian,
        equations,
        bracket,
        legendre: Procedure::of(inversion.projected),
        momenta: inversion.symbols,
    })
}

/// R_L(x^i) = ρ^i(z), R_L(π_a) = z·ρ_a(p̂) + p_γ [z, B_a]^γ + Υ(B_a) + p·∂_tB_a, mathematics (28), with
/// z of constant components: zero where the constraints are homogeneous and nothing depends on the
/// time or is forced.
fn drift(graph: &mut Graph, inversion: &Inversion<'_>, momenta: &[ExprId]) -> Procedure {
    let Inversion { system, distribution, equations, definiteness, .. } = inversion;
    let algebroid = &system.algebroid;
    // 1. z is a function of (t, x) alone
    let mut before = Procedure::default();
    let normal = normal_velocity(graph, system, distribution, &equations.mass, *definiteness, &mut before);
    let rates = algebroid.rates(graph, &normal);
    // 2. R_L(π_a)
    let slopes = gradients(graph, momenta, &algebroid.anchor.coordinates);
    let carried: Vec<ExprId> = (0..rates.len())
        .map(|i| {
            let column: Vec<ExprId> = slopes.iter().map(|row| row[i]).collect();
            graph.inner_product(&column, &normal)
        })
        .collect();
    let coordinates = algebroid.anchor.coordinates.iter().copied();
    let mut along = Derivation::new(coordinates.zip(rates.iter().copied()));
    let mut outputs = rates;
    for a in 0..distribution.rank() {
        let section = distribution.section(a);
        let field = algebroid.anchor.vector_field(graph, &section);
        let turned = algebroid.structure.contract(graph, &normal, &section);
        let mut terms = vec![graph.inner_product(&field, &carried), force_along(graph, inversion, a)];
        for ((entry, turned), momentum) in section.iter().zip(turned).zip(momenta) {
            let moved = along.apply(graph, *entry);
            let change = system.clock.rate(graph, *entry);
            let sum = graph.sum(&[moved, turned, change]);
            terms.push(graph.formula(sum * momentum));
        }
        outputs.push(graph.sum(&terms));
    }
    let mut procedure = inversion.transformed(graph, &outputs);
    procedure.definitions = before.definitions.into_iter().chain(procedure.definitions).collect();
    procedure
}

/// Υ(B_a) on the constraint manifold.
fn force_along(graph: &mut Graph, inversion: &Inversion<'_>, a: usize) -> ExprId {
    let Inversion { system, distribution, .. } = inversion;
    let mut restriction = distribution.restriction(graph, &system.algebroid.velocities);
    let forces = restriction.apply_all(graph, &system.forces);
    let mut terms = vec![graph.inner_product(&distribution.section(a), &forces)];
    for value in system.forces_along(distribution.independent[a]) {
        terms.push(restriction.apply(graph, value));
    }
    graph.sum(&terms)
}

fn is_constant_in(graph: &mut Graph, row: &[ExprId], velocities: &[SymbolId]) -> bool {
    row.iter().all(|entry| {
        velocities.iter().all(|velocity| {
            let slope = graph.partial(*entry, *velocity);
            graph.zero_test(slope) == Verdict::Zero
        })
    })
}

/// h = ½ (π − π|₀ + 2e)·v + E_L|₀ with e = ∂E_L/∂v|₀: nothing is multiplied out.
fn hamiltonian(graph: &mut Graph, inversion: &Inversion<'_>) -> Procedure {
    let Inversion { system, distribution, .. } = inversion;
    let energy = energy(graph, system);
    let mut restriction = distribution.restriction(graph, &system.algebroid.velocities);
    let energy = restriction.apply(graph, energy);
    let rest = graph.at_zero(energy, &distribution.independent);
    let rest = graph.simplify(rest);
    let mut procedure = Procedure::default();
    let velocities = inversion.velocities(graph, &mut procedure);
    let mut terms = vec![(1.into(), rest)];
    for (a, velocity) in velocities.iter().enumerate() {
        let slope = graph.partial(energy, distribution.independent[a]);
        let slope = graph.at_zero(slope, &distribution.independent);
        let momentum = graph.symbol(inversion.symbols[a]);
        let factor = graph.linear_combination(&[
            (1.into(), momentum),
            ((-1).into(), inversion.at_rest[a]),
            (2.into(), slope),
        ]);
        terms.push((crate::algebra::Rational::new(1, 2), graph.formula(factor * velocity)));
    }
    procedure.outputs = vec![graph.linear_combination(&terms)];
    procedure
}

/// π̇_a = B_a^C(L) + Υ(B_a), the momentum equation (12) for the basis of D: for linear
/// constraints −ρ^i_a ∂_ih − D^c_{ab} π_c ∂h/∂π_b + Υ_a, mathematics (16).
fn momentum_rates(graph: &mut Graph, inversion: &Inversion<'_>) -> Vec<ExprId> {
    let Inversion { system, distribution, .. } = inversion;
    let mut restriction = distribution.restriction(graph, &system.algebroid.velocities);
    (0..distribution.rank())
        .map(|a| {
            let section = distribution.section(a);
            let mut lift = complete_lift(graph, &system.algebroid, &section, &system.clock);
            let lifted = lift.apply(graph, system.lagrangian);
            let lifted = restriction.apply(graph, lifted);
            let force = force_along(graph, inversion, a);
            let sum = graph.formula(lifted + force);
            graph.simplify(sum)
        })
        .collect()
}

/// {x^i, π_a} = ρ^i_α B^α_a, {π_a, π_b} = −p_γ [B_a, B_b]^γ, in (t, x, v): mathematics (17), which is
/// (15) where the constraints are linear and L is of mechanical type.
fn phase_bracket(graph: &mut Graph, inversion: &Inversion<'_>, momenta: &[ExprId]) -> Matrix {
    let Inversion { system, distribution, .. } = inversion;
    let algebroid = &system.algebroid;
    let sections = distribution.sections();
    let fields: Matrix = sections.iter().map(|b| algebroid.anchor.vector_field(graph, b)).collect();
    let n = algebroid.anchor.coordinates.len();
    antisymmetric(graph, n + sections.len(), |graph, row, column| match (row < n, column < n) {
        (true, true) => graph.zero(),
        (true, false) => fields[column - n][row],
        (false, _) => {
            let bracket = algebroid.bracket(graph, &sections[row - n], &sections[column - n]);
            let value = graph.inner_product(momenta, &bracket);
            graph.formula(-value)
        }
    })
}

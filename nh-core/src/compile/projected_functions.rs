//! The functions of a system in the projected formulation.

use super::completion::{Derivation, complete};
use super::differentiated::{requested_linearized, requested_output_jacobian, requested_parameter_jacobian};
use super::gibbs_appell_function;
use super::given;
use super::gyroscopic;
use super::impact_functions;
use super::levels;
use super::momenta::momenta;
use super::on_request;
use super::position_return::position_return;
use super::power::{power, work_of_constraints};
use super::proved::{Derived, Proved, fence};
use super::proved_functions::Parts;
use super::saddle_competition::{Solved, proved_solution};
use super::velocities_of_state::{
    claims_in_state, divides_by_free_parameters, observables, parameter_divisors,
};
use crate::algebra::{Graph, Matrix, Substitution};
use crate::check;
use crate::choose::Reference;
use crate::forms::Registry;
use crate::functions::{ENERGY, GYROSCOPIC, OUTPUT_JACOBIAN, PARAMETER_JACOBIAN, POWER, RESIDUAL, VELOCITY};
use crate::id::{ExprId, SymbolId};
use crate::limits::{Subject, about};
use crate::mechanics::{Definiteness, Flow, Procedure, SaddleEquations, energy, saddle_equations};
use crate::model::Model;
use crate::system::{Projection, System};
use crate::violation::Violation;

/// Derives everything on E, with multipliers.
pub(super) fn derive(
    mut proved: Proved,
    registry: &Registry,
    reason: &str,
) -> Result<System, Vec<Violation>> {
    // 1. the saddle equations, proved regular on the constraint manifold
    let residuals = proved.constraints.residuals.clone();
    let equations = saddle_equations(&mut proved.model.graph, &proved.system, &residuals);
    let singular = check::saddle_regularity(&mut proved.model, &equations, proved.constraints.generic_mut());
    fence(singular.into_iter().collect())?;
    // the motion keeps the levels by itself: only the way back knows of them
    let all_residuals = levels::residuals(&mut proved)?;
    let on_levels = saddle_equations(&mut proved.model.graph, &proved.system, &all_residuals);
    // 2. ẏ and λ
    about(Subject::Solution);
    let facts = proved.facts.clone();
    let judge = on_request::judge(&proved);
    let mut everywhere = Substitution::new([]);
    let given = given::definitions(&mut proved.model, &mut proved.motion, &mut everywhere);
    let gibbs_appell = gibbs_appell_function::with_multipliers(&mut proved, &equations, &given);
    let declared = given::given(&mut proved.model, &mut proved.motion);
    let graph = &mut proved.model.graph;
    let reference = Reference::projected(graph, &proved.system, declared, residuals.clone());
    gibbs_appell_function::prove_it(&mut proved, &reference, gibbs_appell.as_ref())?;
    let Solved { derivative, regular, multipliers, reactions } =
        proved_solution(&mut proved, registry, &equations, (&reference, &given), &judge)?;
    let judge = on_request::judge_beside(&proved);
    // 3. E_L, y and the observables
    about(Subject::Requests);
    let graph = &mut proved.model.graph;
    let velocity = proved.system.algebroid.velocity(graph);
    let energy = energy(graph, &proved.system);
    let energy = graph.simplify(energy);
    let observables = observables(&mut proved.model, &mut proved.motion, &mut everywhere);
    let work = work_of_constraints(&mut proved, residuals.len());
    let power = power(&mut proved, &mut everywhere, &given, &multipliers, &work);
    // 4. the claims, along the flow
    about(Subject::Claims);
    let claims = claims_in_state(&mut proved.model, &mut proved.motion, &mut everywhere);
    let velocities = proved.system.algebroid.velocities.clone();
    let output_jacobian = requested_output_jacobian(&mut proved, &observables, &velocities)?;
    if !claims.is_empty() {
        let graph = &mut proved.model.graph;
        let flow = Flow::of(graph, &derivative, &proved.system, &velocities);
        let manifold = levels::manifold(&mut proved);
        let Proved { model, positions, facts, .. } = &mut proved;
        fence(check::claims(model, &claims, flow, (&manifold, &positions.unsolved), facts))?;
    }
    about(Subject::Requests);
    let linearized = requested_linearized(&mut proved, &derivative, &velocities)?;
    let (momenta, mut functions) = momenta(&mut proved, &mut everywhere, &derivative, &velocities);
    functions.add_if(&PARAMETER_JACOBIAN, requested_parameter_jacobian(&mut proved, &derivative)?);
    let (gyroscopic, force) = gyroscopic::derive(&mut proved, None)?;
    functions.add_if(&GYROSCOPIC, force);
    // 5. the way back to the constraint manifold; parameters that the motion may have at 0 are no divisors of it
    let divisors = parameter_divisors(&mut proved.model, &regular);
    let is_free =
        |model: &mut Model, step: &Procedure| divides_by_free_parameters(model, step, &divisors, &facts);
    let moving = (velocities.as_slice(), velocity.as_slice(), all_residuals.as_slice());
    let rates = change(&mut proved.model.graph, &velocities, &on_levels, &all_residuals);
    let found = (&equations, rates.clone());
    let mut positions = position_return(&mut proved, found, &mut everywhere, moving, &judge);
    if let Some(found) = &positions
        && [&found.step].into_iter().chain(&found.velocities).any(|step| is_free(&mut proved.model, step))
    {
        let found = (&equations, rates);
        positions = position_return(&mut proved, found, &mut everywhere, moving, by_pivots);
    }
    let is_projected = positions.as_ref().is_none_or(|positions| positions.velocities.is_none());
    let projection = is_projected.then(|| {
        let equations = (&on_levels, all_residuals.as_slice());
        projection(&mut proved.model, &velocities, equations, &judge, is_free)
    });
    let impacts = impact_functions::projected(&mut proved, &equations, &judge);
    // 6. what both formulations end with
    functions.add(&ENERGY, Procedure::of(vec![energy]));
    functions.add(&VELOCITY, Procedure::of(velocity));
    functions.add_if(&POWER, power);
    functions.add_if(&OUTPUT_JACOBIAN, output_jacobian);
    let on_positions = positions.iter().flat_map(|positions| positions.residual.outputs.clone());
    functions.add(&RESIDUAL, Procedure::of(on_positions.chain(all_residuals.iter().copied()).collect()));
    let parts = Parts {
        linearized,
        functions,
        momenta,
        gyroscopic,
        projection,
        positions,
        impacts,
        ..Parts::default()
    };
    let derivation = Derivation {
        derived: Derived::Projected { residuals: &residuals, equations: &equations },
        reason,
        reference: &reference,
        conditions: &[],
        divisors,
        residuals: &all_residuals,
        claims: &claims,
        derivative,
        regular,
        multipliers,
        reactions,
        gibbs_appell,
        observables,
        parts,
    };
    complete(proved, registry, derivation)
}

/// The change that leads to where the constraints hold, with least kinetic energy: `W Δ = Jᵀ μ`, `J Δ = −φ(y)`; `None`
/// where it does not lead there, as φ is not affine, or depends on where it starts, as W does.
fn change(
    graph: &mut Graph,
    velocities: &[SymbolId],
    equations: &SaddleEquations,
    residuals: &[ExprId],
) -> Option<SaddleEquations> {
    let entries: Vec<ExprId> = equations.mass.iter().chain(&equations.jacobian).flatten().copied().collect();
    if graph.symbols_in(&entries).iter().any(|symbol| velocities.contains(symbol)) {
        return None;
    }
    let force = vec![graph.zero(); equations.mass.len()];
    let bias = residuals.iter().map(|residual| graph.formula(-*residual)).collect();
    Some(SaddleEquations { force, bias, ..equations.clone() })
}

/// No matrix is known to be definite: pivots are numerical.
fn by_pivots(_: &Graph, _: &Matrix) -> Definiteness {
    Definiteness::Unknown
}

/// A step back, with numerical pivots where it would divide by parameters that are free to be 0.
fn projection(
    model: &mut Model,
    velocities: &[SymbolId],
    equations: (&SaddleEquations, &[ExprId]),
    judge: &dyn Fn(&Graph, &Matrix) -> Definiteness,
    is_free: impl Fn(&mut Model, &Procedure) -> bool,
) -> Projection {
    let back = step_back(model, velocities, equations, judge);
    if is_free(model, &back.step) { step_back(model, velocities, equations, &by_pivots) } else { back }
}

/// One Newton step towards the point of the constraint manifold that is nearest to y₀ in the
/// kinetic metric: `W (y⁺ − y₀) = Jᵀ μ`, `J (y⁺ − y) = −φ(y)`.
fn step_back(
    model: &mut Model,
    velocities: &[SymbolId],
    (equations, residuals): (&SaddleEquations, &[ExprId]),
    judge: &dyn Fn(&Graph, &Matrix) -> Definiteness,
) -> Projection {
    let graph = &mut model.graph;
    let start: Vec<_> =
        velocities.iter().map(|symbol| format!("{}_start", graph.symbols()[*symbol])).collect();
    let start: Vec<_> = start.into_iter().map(|name| graph.new_symbol(name)).collect();
    let gaps: Vec<ExprId> = velocities
        .iter()
        .zip(&start)
        .map(|(now, start)| {
            let (now, start) = (graph.symbol(*now), graph.symbol(*start));
            graph.formula(now - start)
        })
        .collect();
    let zero = graph.zero();
    let bias = equations
        .jacobian
        .iter()
        .zip(residuals)
        .map(|(row, residual)| {
            let moved = graph.inner_product(row, &gaps);
            graph.formula(moved - residual)
        })
        .collect();
    let step = SaddleEquations { force: vec![zero; velocities.len()], bias, ..equations.clone() };
    let mut procedure = Procedure::default();
    let (moves, _) = step.solve(graph, judge, &mut procedure);
    procedure.outputs = moves
        .into_iter()
        .zip(&start)
        .map(|(change, start)| {
            let start = graph.symbol(*start);
            graph.formula(start + change)
        })
        .collect();
    Projection { start, step: procedure }
}

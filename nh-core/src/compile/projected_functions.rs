//! The functions of a system in the projected formulation.

use super::cancellation::without_needless_cancellation;
use super::completion::{Derivation, complete};
use super::differentiated::{requested_jacobian, requested_output_jacobian, requested_parameter_jacobian};
use super::gibbs_appell_function;
use super::given;
use super::gyroscopic;
use super::impact_functions;
use super::levels;
use super::momenta::momenta;
use super::position_return::position_return;
use super::power::{power, work_of_constraints};
use super::proved::{Derived, Proved, fence, nothing_proved};
use super::proved_functions::Parts;
use super::velocities_of_state::{
    claims_in_state, divides_by_free_parameters, observables, parameter_divisors, requested,
};
use crate::algebra::{Graph, Matrix, Substitution};
use crate::check;
use crate::choose::{Claim, Contender, Decision, Fate, Reference, Regular, fate, prove};
use crate::forms::Registry;
use crate::functions::{ENERGY, GYROSCOPIC, OUTPUT_JACOBIAN, PARAMETER_JACOBIAN, POWER, RESIDUAL, VELOCITY};
use crate::id::ExprId;
use crate::limits::{Subject, about, attempt};
use crate::mechanics::{
    Definiteness, Flow, Procedure, SaddleEquations, definiteness, energy, saddle_equations,
};
use crate::model::{Model, Request};
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
    let singular = check::saddle_regularity(&mut proved.model, &equations, proved.constraints.generic());
    fence(singular.into_iter().collect())?;
    // the motion keeps the levels by itself: only the way back knows of them
    let all_residuals = levels::residuals(&mut proved)?;
    let on_levels = saddle_equations(&mut proved.model.graph, &proved.system, &all_residuals);
    // 2. ẏ and λ
    about(Subject::Solution);
    let parameters: Vec<_> = proved.model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let facts = proved.facts.clone();
    let judge = |graph: &Graph, matrix: &Matrix| definiteness(graph, matrix, &parameters, &facts);
    let mut everywhere = Substitution::new([]);
    let given = given::definitions(&mut proved.model, &mut proved.motion, &mut everywhere);
    let gibbs_appell = gibbs_appell_function::with_multipliers(&mut proved, &equations, &given);
    let declared = given::given(&mut proved.model, &mut proved.motion);
    let graph = &mut proved.model.graph;
    let reference = Reference::projected(graph, &proved.system, declared, residuals.clone());
    gibbs_appell_function::prove_it(&mut proved, &reference, gibbs_appell.as_ref())?;
    let Solved { derivative, multipliers, reactions } =
        proved_solution(&mut proved, &equations, &reference, &given, judge)?;
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
        fence(check::claims(&mut proved.model, &claims, flow, &manifold))?;
    }
    about(Subject::Requests);
    let jacobian = requested_jacobian(&mut proved, &derivative, &velocities)?;
    let (momenta, mut functions) = momenta(&mut proved, &mut everywhere, &derivative, &velocities);
    functions.add_if(&PARAMETER_JACOBIAN, requested_parameter_jacobian(&mut proved, &derivative)?);
    let (gyroscopic, force) = gyroscopic::derive(&mut proved, None)?;
    functions.add_if(&GYROSCOPIC, force);
    // 5. the way back to the constraint manifold; parameters that the motion may have at 0 are no divisors of it
    let divisors = parameter_divisors(&mut proved.model, &derivative);
    let is_free =
        |model: &mut Model, step: &Procedure| divides_by_free_parameters(model, step, &divisors, &facts);
    let by_pivots = |_: &Graph, _: &Matrix| Definiteness::Unknown;
    let model = &mut proved.model;
    let mut back = projection(model, &velocities, &on_levels, &all_residuals, judge);
    if is_free(model, &back.step) {
        back = projection(model, &velocities, &on_levels, &all_residuals, by_pivots);
    }
    let moving = (velocities.as_slice(), velocity.as_slice(), all_residuals.as_slice());
    let mut positions = position_return(&mut proved, &equations, &mut everywhere, moving, judge);
    if let Some(found) = &positions
        && is_free(&mut proved.model, &found.step)
    {
        positions = position_return(&mut proved, &equations, &mut everywhere, moving, by_pivots);
    }
    let impacts = impact_functions::projected(&mut proved, &equations);
    // 6. what both formulations end with
    functions.add(&ENERGY, Procedure::of(vec![energy]));
    functions.add(&VELOCITY, Procedure::of(velocity));
    functions.add_if(&POWER, power);
    functions.add_if(&OUTPUT_JACOBIAN, output_jacobian);
    let on_positions = positions.iter().flat_map(|positions| positions.residual.outputs.clone());
    functions.add(&RESIDUAL, Procedure::of(on_positions.chain(all_residuals.iter().copied()).collect()));
    let projection = Some(back);
    let parts = Parts {
        jacobian,
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
        multipliers,
        reactions,
        gibbs_appell,
        observables,
        parts,
    };
    complete(proved, registry, derivation)
}

/// What the question may take whether a solution adds a condition; numerical pivoting adds none.
const CONDITIONS: u64 = 6_000_000;

/// What solves the saddle equations.
struct Solved {
    derivative: Procedure,
    multipliers: Procedure,
    reactions: Procedure,
}

/// The solution of the saddle equations that is proved to be what is declared: by elimination without
/// pivoting where that is known to be possible, else with it.
fn proved_solution(
    proved: &mut Proved,
    equations: &SaddleEquations,
    reference: &Reference,
    given: &Procedure,
    judge: impl Fn(&Graph, &Matrix) -> Definiteness,
) -> Result<Solved, Vec<Violation>> {
    let mut decision = Decision { site: "derivative", ..Decision::default() };
    let [asks_multipliers, asks_reactions] =
        [Request::Multipliers, Request::Reactions].map(|request| requested(&proved.model, request));
    let parameters: Vec<_> = proved.model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let graph = &mut proved.model.graph;
    let factorised = equations.factorised(graph, &judge);
    for is_pivoted in [false, true] {
        let mut procedure = given.clone();
        let (accelerations, multipliers) = if is_pivoted {
            equations.solve_pivoted(graph, &mut procedure)
        } else {
            equations.solve(graph, &judge, &mut procedure)
        };
        let reactions = (0..accelerations.len())
            .map(|alpha| {
                let column: Vec<ExprId> = equations.jacobian.iter().map(|row| row[alpha]).collect();
                graph.inner_product(&column, &multipliers)
            })
            .collect();
        procedure.outputs =
            equations.rates.iter().chain(&accelerations).chain(&given.outputs).copied().collect();
        // those of levels are zero
        let declared = proved.constraints.residuals.len();
        let multipliers = procedure.with_outputs(multipliers.into_iter().take(declared).collect());
        let reactions = procedure.with_outputs(reactions);
        let fixed = &proved.system.algebroid.anchor.coordinates;
        let derivative = without_needless_cancellation(graph, procedure, fixed);
        let mut proof = prove(graph, reference, &Claim::Motion(&derivative));
        if asks_multipliers {
            let claim = Claim::Multipliers(&derivative, &multipliers, None);
            proof = proof.and_then(|_| prove(graph, reference, &claim));
        }
        if asks_reactions {
            let claim = Claim::Reactions(&derivative, &reactions);
            proof = proof.and_then(|_| prove(graph, reference, &claim));
        }
        let form = if is_pivoted { "with pivoting" } else { "by complement" };
        let mut fate = fate(proof);
        if let (Some(mass), Fate::Chosen(_), false) = (&factorised, &fate, is_pivoted) {
            let regular = Regular {
                reference,
                definitions: &Procedure::default(),
                mass,
                definiteness: Definiteness::Definite,
                jacobian: &equations.jacobian,
                parameters: &parameters,
                facts: &proved.facts,
            };
            let solved = [&derivative, &multipliers, &reactions];
            let asked =
                attempt(CONDITIONS, || solved.into_iter().find_map(|solved| regular.added(graph, solved)));
            fate = match asked {
                Some(None) => fate,
                Some(Some(divisor)) => Fate::adds(graph, divisor),
                None => Fate::NotAdmitted("whether it adds a condition would take too many steps".into()),
            };
        }
        let is_admitted = matches!(fate, Fate::Chosen(_));
        decision.contenders.push(Contender { form, cost: None, rounding: None, fate });
        if is_admitted {
            proved.ledger.decisions.push(decision);
            return Ok(Solved { derivative, multipliers, reactions });
        }
    }
    proved.ledger.decisions.push(decision);
    Err(nothing_proved(proved.model.origin, &proved.ledger))
}

/// One Newton step towards the point of the constraint manifold that is nearest to y₀ in the
/// kinetic metric: `W (y⁺ − y₀) = Jᵀ μ`, `J (y⁺ − y) = −φ(y)`.
fn projection(
    model: &mut Model,
    velocities: &[crate::id::SymbolId],
    equations: &SaddleEquations,
    residuals: &[ExprId],
    judge: impl Fn(&Graph, &Matrix) -> Definiteness,
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
    let entries: Vec<ExprId> = equations.mass.iter().chain(&equations.jacobian).flatten().copied().collect();
    let is_affine = graph.symbols_in(&entries).iter().all(|symbol| !velocities.contains(symbol));
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
    Projection { start, step: procedure, is_affine }
}

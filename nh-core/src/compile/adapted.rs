//! The functions of a system in the adapted formulation.

use super::cancellation::without_needless_cancellation;
use super::embedded::embedding;
use super::gibbs_appell;
use super::gyroscopic;
use super::levels::{Leveled, again};
use super::momenta::momenta;
use super::phase_space;
use super::restricted::{
    calls, coordinates, in_state, observables, parameter_checks, parameter_divisors, requested,
    requested_jacobian, requested_parameter_jacobian,
};
use super::{Proved, fence, nothing_proved};
use crate::algebra::{Graph, Matrix};
use crate::check;
use crate::choose::{
    Claim, Contender, Decision, Entry, Fate, Reference, Regular, admitted, fate, limits, prove,
};
use crate::count::Count;
use crate::forms::{Form, Registry, Setting};
use crate::functions::{
    ENERGY, GIBBS_APPELL, GYROSCOPIC, MULTIPLIERS, OUTPUTS, PARAMETER_JACOBIAN, REACTIONS, VELOCITY,
};
use crate::geometry::ConstraintDistribution;
use crate::id::{ExprId, Id};
use crate::mechanics::{
    Definiteness, Definition, Flow, Procedure, ReducedEquations, definiteness, energy, reaction_forces,
    reduced_equations, solve_symmetric,
};
use crate::model::{Formulation, Request};
use crate::report::{Derived, equations_of_motion, report};
use crate::system::System;
use crate::violation::Violation;

/// Derives everything from a basis of D and the velocities that levels of momenta leave.
pub(super) fn derive(
    mut proved: Proved,
    registry: &Registry,
    (distribution, leveled): (&ConstraintDistribution, &Leveled),
    (conditions, reason): (&[ExprId], &str),
) -> Result<System, Vec<Violation>> {
    let conditions = &[conditions, &leveled.conditions].concat();
    let kept = &leveled.kept;
    // 1. C v̇ = f, proved to be what is declared, and regular
    let reference = reference(&mut proved, distribution, kept);
    let (mut shown, mut chosen) = (Decision::default(), Decision::default());
    let mut candidates = candidates(&mut proved, registry, distribution, kept, &mut chosen);
    show_proved(&proved.model.graph, &reference, kept, &mut candidates, &mut shown);
    if candidates.is_empty() {
        candidates.push(plain(&mut proved, kept));
        show_proved(&proved.model.graph, &reference, kept, &mut candidates, &mut shown);
    }
    proved.ledger.decisions.push(shown);
    let Some(first) = candidates.first() else {
        return Err(nothing_proved(proved.model.origin, &proved.ledger));
    };
    let equations = first.equations.clone();
    let singular = check::reduced_regularity(&mut proved.model, &equations, &proved.base);
    fence(singular.into_iter().collect())?;
    // 2. v̇
    let velocities = &proved.system.algebroid.velocities;
    let mut restriction = kept.restriction(&proved.model.graph, velocities);
    let calls = calls(&mut proved.model, &mut proved.motion, &mut restriction);
    let derivative = proved_derivative(&mut proved, &reference, &candidates, &calls, &mut chosen)
        .or_else(|| plain_derivative(&mut proved, &reference, kept, &calls, &mut chosen));
    proved.ledger.decisions.push(chosen);
    let derivative = derivative.ok_or_else(|| nothing_proved(proved.model.origin, &proved.ledger))?;
    let gibbs_appell = gibbs_appell::on_distribution(&mut proved, kept, &calls);
    let (multipliers, reactions) =
        if requested(&proved.model, Request::Multipliers) || requested(&proved.model, Request::Reactions) {
            let accelerations = &derivative.outputs[equations.rates.len()..];
            constraint_forces(&mut proved, &reference, kept, &derivative, accelerations)?
        } else {
            Default::default()
        };
    let jacobian = requested_jacobian(&mut proved.model, &derivative, &kept.independent)
        .map_err(|violation| vec![violation])?;
    let parameter_jacobian =
        requested_parameter_jacobian(&mut proved.model, &derivative).map_err(|violation| vec![violation])?;
    let (momenta, mut functions) = momenta(&mut proved, &mut restriction, &derivative, &kept.independent);
    let (gyroscopic, gyroscopic_force) = gyroscopic::derive(&mut proved, Some(distribution))?;
    let graph = &mut proved.model.graph;
    // 3. E_L, y and the observables on D
    let energy = energy(graph, &proved.system);
    let energy = restriction.apply(graph, energy);
    let energy = if is_large(&proved) { energy } else { proved.model.graph.simplify(energy) };
    let observables = observables(&mut proved.model, &mut proved.motion, &mut restriction);
    // 4. the claims, along the flow
    let claims: Vec<ExprId> = proved
        .model
        .claims
        .iter()
        .map(|claim| in_state(&mut proved.model.graph, &mut proved.motion, &mut restriction, claim.value))
        .collect();
    if !claims.is_empty() {
        let flow = Flow::of(&mut proved.model.graph, &derivative, &proved.system, &equations.independent);
        fence(check::claims(&mut proved.model, &claims, flow, &proved.base))?;
    }
    // 5. the report
    let embedding = embedding(&mut proved.model, &proved.base);
    let derived = Derived::Adapted { distribution, kept, equations: &equations };
    let (phase_space, sections) =
        phase_space::derive(&mut proved, &derived, &derivative, &observables, &claims, &mut functions)?;
    let text = report(&mut proved, &derived, reason, conditions, sections);
    let lines = equations_of_motion(&proved.model, &derived);
    let divisors = parameter_divisors(&mut proved.model, &derivative);
    let conditions = [conditions.as_slice(), &divisors].concat();
    let model = proved.model;
    functions.add(&ENERGY, Procedure::of(vec![energy]));
    functions.add(&VELOCITY, Procedure::of(equations.velocity.clone()));
    functions.add(&OUTPUTS, observables);
    functions.add_if(&MULTIPLIERS, requested(&model, Request::Multipliers).then_some(multipliers));
    functions.add_if(&REACTIONS, requested(&model, Request::Reactions).then_some(reactions));
    functions.add_if(&GIBBS_APPELL, gibbs_appell);
    functions.add_if(&PARAMETER_JACOBIAN, parameter_jacobian);
    functions.add_if(&GYROSCOPIC, gyroscopic_force);
    Ok(System {
        formulation: Formulation::Adapted,
        state_coordinates: coordinates(&model),
        state_velocities: kept.independent.clone(),
        derivative,
        functions,
        momenta,
        gyroscopic,
        quadratures: Vec::new(),
        jacobian,
        projection: None,
        phase_space,
        embedding,
        parameter_checks: parameter_checks(&model, &conditions),
        ledger: proved.ledger,
        report: text,
        equations: lines,
        model,
    })
}

/// What forms are proved against: (8), with the velocities that `kept` leaves.
fn reference(
    proved: &mut Proved,
    distribution: &ConstraintDistribution,
    kept: &ConstraintDistribution,
) -> Reference {
    let calls = proved.called();
    let mut residuals = proved.constraints.residuals.clone();
    residuals.extend(proved.levels.iter().map(|level| level.residual));
    Reference::adapted(&proved.system, calls, residuals, distribution, kept)
}

/// Whether expressions of the size of the Lagrangian are left as they are.
fn is_large(proved: &Proved) -> bool {
    proved.model.graph.operation_count(&[proved.system.lagrangian]) > limits::EXPANDED
}

/// Equations with the name of their form.
struct Candidate {
    form: &'static dyn Form,
    equations: ReducedEquations,
}

/// (8) as it stands.
fn plain(proved: &mut Proved, kept: &ConstraintDistribution) -> Candidate {
    let form = Registry::plain();
    let equations = reduced_equations(&mut proved.model.graph, &proved.system, kept);
    Candidate { form, equations }
}

/// The equations in the forms worth comparing, the one to show first.
fn candidates(
    proved: &mut Proved,
    registry: &Registry,
    distribution: &ConstraintDistribution,
    kept: &ConstraintDistribution,
    decision: &mut Decision,
) -> Vec<Candidate> {
    let is_orthonormal = proved.model.orthonormal.is_some();
    let chained = (!is_orthonormal).then(|| {
        let (system, graph) = (&proved.system, &mut proved.model.graph);
        let velocities = &system.algebroid.velocities;
        let chained = distribution.chained(graph, &proved.constraints.residuals, velocities);
        again(proved, &chained, &kept.eliminated)
    });
    let (system, graph) = (&proved.system, &mut proved.model.graph);
    // some forms solve the constraints anew, and know nothing of levels
    let residuals = proved.levels.is_empty().then_some(proved.constraints.residuals.as_slice());
    let size = graph.operation_count(&[system.lagrangian]);
    let setting = Setting { system, distribution: kept, chained: chained.as_ref(), residuals, size };
    let mut found: Vec<Candidate> = Vec::new();
    let mut most = if is_orthonormal { Count::TOO_MANY } else { Count::new(limits::EXPANDED) };
    for form in registry.forms() {
        if form.expands() && size > most {
            let name = form.name();
            decision.limits.push(format!("{name}: the Lagrangian has {size} operations, more than {most}"));
            continue;
        }
        let Some(mut equations) = form.derive(graph, &setting) else { continue };
        if is_orthonormal {
            in_orthonormal_basis(graph, &mut equations);
        }
        most = most.min(form.others_expand_up_to());
        found.push(Candidate { form: *form, equations });
    }
    found.sort_by_key(|candidate| candidate.form.rank());
    found
}

/// Where the basis was made orthonormal, C is the identity: what is proved to be 0 or 1 is written so.
fn in_orthonormal_basis(graph: &mut Graph, equations: &mut ReducedEquations) {
    for (a, row) in equations.mass.iter_mut().enumerate() {
        for (b, entry) in row.iter_mut().enumerate() {
            let unit = if a == b { graph.one() } else { graph.zero() };
            let defect = graph.sub(*entry, unit);
            if graph.zero_test(defect).is_zero() {
                *entry = unit;
            }
        }
    }
}

/// The first equations that are proved to be (8) come first: regularity, claims and the report are about them.
fn show_proved(
    graph: &Graph,
    reference: &Reference,
    kept: &ConstraintDistribution,
    candidates: &mut Vec<Candidate>,
    decision: &mut Decision,
) {
    decision.site = "equations";
    let sections: Vec<_> = kept.independent.iter().copied().zip(kept.sections()).collect();
    while let Some(Candidate { form, equations }) = candidates.first() {
        let fate = fate(prove(graph, reference, &Claim::Equations(equations, &sections)));
        let is_proved = matches!(fate, Fate::Chosen(_));
        decision.contenders.push(Contender { form: form.name(), cost: None, rounding: None, fate });
        if is_proved {
            return;
        }
        candidates.remove(0);
    }
}

/// The derivative by whichever form of the equations takes less work, unless that loses more accuracy
/// than is allowed, or is not proved to be what is declared; `None` where no form is.
fn proved_derivative(
    proved: &mut Proved,
    reference: &Reference,
    candidates: &[Candidate],
    calls: &Procedure,
    decision: &mut Decision,
) -> Option<Procedure> {
    decision.site = "derivative";
    let parameters: Vec<_> = proved.model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let graph = &mut proved.model.graph;
    // the mass matrix is the same in all forms, and the first is written out
    let shown = &candidates.first()?.equations;
    let definite = definiteness(graph, &shown.mass, &parameters, &proved.facts);
    let facts = &proved.facts;
    let regular =
        Regular { reference, equations: shown, definiteness: definite, parameters: &parameters, facts };
    let fixed = &proved.system.algebroid.anchor.coordinates;
    let mut left: Vec<&Candidate> = candidates.iter().collect();
    while !left.is_empty() {
        decision.limits.retain(|limit| !limit.contains(limits::BESIDE));
        let entries = solved_forms(graph, &left, definite, calls, decision);
        let finish = |graph: &mut Graph, procedure: &Procedure| {
            without_needless_cancellation(graph, procedure.clone(), fixed)
        };
        match admitted(graph, (reference, Some(&regular)), &entries, finish, decision) {
            Ok(procedure) => return Some(procedure),
            // no limit, and no comparison, is by a form that is wrong
            Err(refused) => left.retain(|candidate| Some(candidate.form.name()) != refused),
        }
    }
    None
}

/// The derivatives by forms that are not much longer than the shortest.
fn solved_forms(
    graph: &mut Graph,
    candidates: &[&Candidate],
    definite: Definiteness,
    calls: &Procedure,
    decision: &mut Decision,
) -> Vec<Entry> {
    let lengths: Vec<Count> = candidates.iter().map(|candidate| candidate.equations.length(graph)).collect();
    let shortest = lengths.iter().copied().min().unwrap_or_default();
    let mut entries: Vec<Entry> = Vec::with_capacity(candidates.len());
    let mut compared: Vec<Vec<ExprId>> = Vec::new();
    for (Candidate { form, equations }, length) in candidates.iter().zip(lengths) {
        let form = form.name();
        if limits::is_much_longer(length, shortest) {
            decision.limits.push(format!("{form}: {length} operations{}{shortest}", limits::BESIDE));
            continue;
        }
        let procedure = solved(graph, equations, definite, calls);
        // different ways often lead to the same equations
        let values = procedure.values(graph);
        if !compared.contains(&values) {
            compared.push(values);
            entries.push(Entry { form, procedure });
        }
    }
    entries
}

/// (8) as it stands, where no form is admitted: with the pivots that its solution has, which `validate` names
/// where they are of parameters alone.
fn plain_derivative(
    proved: &mut Proved,
    reference: &Reference,
    kept: &ConstraintDistribution,
    calls: &Procedure,
    decision: &mut Decision,
) -> Option<Procedure> {
    let Candidate { equations, .. } = plain(proved, kept);
    let parameters: Vec<_> = proved.model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let graph = &mut proved.model.graph;
    let definite = definiteness(graph, &equations.mass, &parameters, &proved.facts);
    let kinds = [("plain", definite), ("plain, with pivoting", Definiteness::Unknown)];
    kinds.into_iter().find_map(|(form, definite)| {
        let entry = Entry { form, procedure: solved(graph, &equations, definite, calls) };
        let finish = |_: &mut Graph, procedure: &Procedure| procedure.clone();
        admitted(graph, (reference, None), &[entry], finish, decision).ok()
    })
}

/// ẋ and v̇ by the equations.
fn solved(
    graph: &mut Graph,
    equations: &ReducedEquations,
    definite: Definiteness,
    calls: &Procedure,
) -> Procedure {
    let mut procedure = calls.clone();
    procedure.definitions.extend(equations.definitions.definitions.iter().cloned());
    let ReducedEquations { mass, force, .. } = equations;
    let accelerations = solve_symmetric(graph, mass, force, definite, &mut procedure, "v_dot");
    procedure.outputs = equations.rates.iter().chain(&accelerations).copied().collect();
    procedure
}

/// Forces of constraint are differences of inertial and applied forces, which may cancel. Where the
/// accelerations put in and simplified give short expressions with no more rounding error, these
/// are evaluated instead.
fn without_cancellation(graph: &mut Graph, procedure: &Procedure) -> Option<Procedure> {
    const SHORT: u64 = 240;
    let written_out = procedure.written_out(graph);
    if graph.operation_count(&written_out) > 2 * SHORT {
        return None;
    }
    let simplified = graph.simplify_all(&written_out);
    let accurate =
        simplified.iter().zip(&written_out).all(|(short, long)| graph.error_growth(*short, *long) <= 1.0);
    if !accurate || graph.operation_count(&simplified) > SHORT {
        return None;
    }
    let mut short = Procedure::of(simplified);
    let is_call = |definition: &&Definition| matches!(definition, Definition::Call { .. });
    short.definitions.extend(procedure.definitions.iter().filter(is_call).cloned());
    Some(short)
}

/// λ and λ_A Φ^A_α from δL_α − Υ_α = λ_A Φ^A_α, mathematics (7), at the accelerations found.
///
/// # Errors
/// Where they could not be proved to be that.
fn constraint_forces(
    proved: &mut Proved,
    reference: &Reference,
    distribution: &ConstraintDistribution,
    derivative: &Procedure,
    accelerations: &[ExprId],
) -> Result<(Procedure, Procedure), Vec<Violation>> {
    let graph = &mut proved.model.graph;
    // 1. δL_α − Υ_α
    let reactions = reaction_forces(graph, &proved.system, distribution, accelerations);
    // 2. the dependent rows determine λ
    let annihilator = &distribution.constraints.annihilator;
    let matrix: Vec<Vec<ExprId>> = distribution
        .dependent
        .iter()
        .map(|section| annihilator.iter().map(|row| row[section.index()]).collect())
        .collect();
    let right: Vec<Vec<ExprId>> =
        distribution.dependent.iter().map(|section| vec![reactions[section.index()]]).collect();
    let solved = graph.solve_linear(&matrix, &right).map(|solution| solution.values).unwrap_or_default();
    let multipliers = solved.into_iter().map(|row| row[0]).collect();
    let [multipliers, reactions] = [multipliers, reactions].map(|outputs| derivative.with_outputs(outputs));
    let site = Site { name: "multipliers", motion: derivative, rows: Some(annihilator) };
    let multipliers = proved_forces(proved, reference, &site, multipliers)?;
    let site = Site { name: "reactions", motion: derivative, rows: None };
    let reactions = proved_forces(proved, reference, &site, reactions)?;
    Ok((multipliers, reactions))
}

/// Forces of constraint that are asked for: λ_A along the rows Φ^A, or all of λ_A Φ^A.
struct Site<'s> {
    name: &'static str,
    motion: &'s Procedure,
    rows: Option<&'s Matrix>,
}

/// Forces without needless cancellation, or else as they are derived, whichever is proved first.
fn proved_forces(
    proved: &mut Proved,
    reference: &Reference,
    site: &Site,
    derived: Procedure,
) -> Result<Procedure, Vec<Violation>> {
    let graph = &mut proved.model.graph;
    let short = without_cancellation(graph, &derived);
    let mut decision = Decision { site: site.name, ..Decision::default() };
    let forms = [("written out", short), ("by the accelerations", Some(derived))];
    for (form, procedure) in forms.into_iter().filter_map(|(form, procedure)| Some((form, procedure?))) {
        let claim = match site.rows {
            Some(rows) => Claim::Multipliers(site.motion, &procedure, Some(rows)),
            None => Claim::Reactions(site.motion, &procedure),
        };
        let fate = fate(prove(graph, reference, &claim));
        let is_admitted = matches!(fate, Fate::Chosen(_));
        decision.contenders.push(Contender { form, cost: None, rounding: None, fate });
        if is_admitted {
            proved.ledger.decisions.push(decision);
            return Ok(procedure);
        }
    }
    proved.ledger.decisions.push(decision);
    Err(nothing_proved(proved.model.origin, &proved.ledger))
}

//! The forms of the equations on D: derived, shown, compared and proved.

use super::cancellation::without_needless_cancellation;
use super::common_turn::counted_from_an_angle;
use super::given::given;
use super::levels::again;
use super::proved::Proved;
use crate::algebra::Graph;
use crate::choose::{
    Claim, Contender, Decision, Entry, Fate, Reference, Regular, admitted, fate, prove, sizes,
};
use crate::count::Count;
use crate::forms::{Form, Registry, Setting};
use crate::geometry::ConstraintDistribution;
use crate::id::ExprId;
use crate::mechanics::{
    Definiteness, Definition, OtherAxes, Procedure, ReducedEquations, definiteness, reduced_equations,
    solve_symmetric,
};
use crate::model::Body;

/// What forms are proved against: (8), with the velocities that `kept` leaves.
pub(super) fn reference(
    proved: &mut Proved,
    distribution: &ConstraintDistribution,
    kept: &ConstraintDistribution,
) -> Reference {
    let given = given(&mut proved.model, &mut proved.motion);
    let mut residuals = proved.constraints.residuals.clone();
    residuals.extend(proved.levels.iter().map(|level| level.residual));
    Reference::adapted(&proved.system, given, residuals, distribution, kept)
}

/// The equations in several forms, and the accelerations of forms that solve for them on their own.
#[derive(Default)]
pub(super) struct Candidates {
    pub(super) equations: Vec<Candidate>,
    solved: Vec<Entry>,
    /// Along which axes they eliminate velocities.
    turned: Vec<OtherAxes>,
}

/// Equations with the name of their form.
pub(super) struct Candidate {
    form: &'static dyn Form,
    pub(super) equations: ReducedEquations,
}

/// (8) as it stands.
pub(super) fn plain(proved: &mut Proved, kept: &ConstraintDistribution) -> Candidate {
    let form = Registry::plain();
    let equations = reduced_equations(&mut proved.model.graph, &proved.system, kept);
    Candidate { form, equations }
}

/// The equations in the forms worth comparing, the one to show first.
pub(super) fn candidates(
    proved: &mut Proved,
    registry: &Registry,
    distribution: &ConstraintDistribution,
    kept: &ConstraintDistribution,
    decision: &mut Decision,
) -> Candidates {
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
    let mut bodies: Vec<Body> = Vec::with_capacity(proved.model.bodies.len());
    for body in &proved.model.bodies {
        let body = Body { energy: proved.motion.rates.apply(graph, body.energy), ..body.clone() };
        if bodies.iter().all(|known| Body { origin: known.origin, ..body.clone() } != *known) {
            bodies.push(body);
        }
    }
    let mut requests = proved.model.requests.iter();
    let setting = Setting {
        system,
        bodies: &bodies,
        distribution: kept,
        chained: chained.as_ref(),
        residuals,
        size,
        is_differentiated: requests.any(|(request, _)| request.differentiates_the_motion()),
    };
    let mut found = Candidates::default();
    let is_constrained = !kept.dependent.is_empty();
    let mut most = if is_orthonormal { Count::TOO_MANY } else { Count::new(sizes::expanded(is_constrained)) };
    for form in registry.forms() {
        if form.expands() && size > most {
            let name = form.name();
            decision.limits.push(format!("{name}: the Lagrangian has {size} operations, more than {most}"));
            continue;
        }
        if let Some((procedure, turned)) = form.solve(graph, &setting) {
            for axes in turned {
                if found.turned.iter().all(|known| known.velocities != axes.velocities) {
                    found.turned.push(axes);
                }
            }
            most = most.min(form.others_expand_up_to(&setting));
            found.solved.push(Entry { form: form.name(), procedure });
        }
        let Some(mut equations) = form.derive(graph, &setting) else { continue };
        if is_orthonormal {
            in_orthonormal_basis(graph, &mut equations);
        }
        most = most.min(form.others_expand_up_to(&setting));
        found.equations.push(Candidate { form: *form, equations });
    }
    found.equations.sort_by_key(|candidate| candidate.form.rank());
    found
}

/// Where the basis was made orthonormal, C is the identity: what is proved to be 0 or 1 is written so.
fn in_orthonormal_basis(graph: &mut Graph, equations: &mut ReducedEquations) {
    for (a, row) in equations.mass.iter_mut().enumerate() {
        for (b, entry) in row.iter_mut().enumerate() {
            let unit = if a == b { graph.one() } else { graph.zero() };
            let defect = graph.formula(*entry - unit);
            if graph.zero_test(defect).is_zero() {
                *entry = unit;
            }
        }
    }
}

/// The first equations that are proved to be (8) come first: regularity, claims and the report are about them.
pub(super) fn show_proved(
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
pub(super) fn proved_derivative(
    proved: &mut Proved,
    reference: &Reference,
    candidates: &Candidates,
    given: &Procedure,
    decision: &mut Decision,
) -> Option<Procedure> {
    let Candidates { equations: candidates, solved: alone, turned } = candidates;
    decision.site = "derivative";
    let parameters: Vec<_> = proved.model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let graph = &mut proved.model.graph;
    // the mass matrix is the same in all forms, and the first is written out
    let shown = &candidates.first()?.equations;
    let definite = definiteness(graph, &shown.mass, &parameters, &proved.facts);
    let facts = &proved.facts;
    let regular = Regular {
        reference,
        definitions: &shown.definitions,
        mass: &shown.mass,
        definiteness: definite,
        jacobian: &Vec::new(),
        turned,
        parameters: &parameters,
        facts,
    };
    let fixed = &proved.system.algebroid.anchor.coordinates;
    let mut left: Vec<&Candidate> = candidates.iter().collect();
    let mut alone: Vec<&Entry> = alone.iter().filter(|_| definite == Definiteness::Definite).collect();
    while !left.is_empty() || !alone.is_empty() {
        decision.limits.retain(|limit| !limit.contains(sizes::BESIDE));
        let mut entries: Vec<Entry> = Vec::with_capacity(left.len() + alone.len());
        for Entry { form, procedure } in &alone {
            let solved = procedure.solved.clone();
            let mut procedure = moving(given, &procedure.definitions, &procedure.outputs);
            procedure.solved.extend(solved);
            entries.push(Entry { form, procedure });
        }
        solved_forms(graph, &left, definite, given, (&mut entries, decision));
        let finish = |graph: &mut Graph, procedure: &Procedure| {
            without_needless_cancellation(graph, procedure.clone(), fixed)
        };
        match admitted(graph, (reference, Some(&regular)), &entries, finish, decision) {
            Ok(procedure) => {
                let admit = |graph: &mut Graph, procedure: &Procedure| {
                    let fate = fate(prove(graph, reference, &Claim::Motion(procedure)));
                    regular.added(graph, procedure).map_or(fate, |divisor| Fate::adds(graph, divisor))
                };
                let judged = (admit, &mut proved.ledger.decisions);
                return Some(
                    counted_from_an_angle(graph, &procedure, fixed, judged, &mut proved.before_counting)
                        .unwrap_or(procedure),
                );
            }
            // no limit, and no comparison, is by a form that is wrong
            Err(refused) => {
                left.retain(|candidate| Some(candidate.form.name()) != refused);
                alone.retain(|entry| Some(entry.form) != refused);
            }
        }
    }
    None
}

/// Adds the derivatives by forms that are not much longer than the shortest. What is there already, by forms that solve
/// for the accelerations on their own, counts among these.
fn solved_forms(
    graph: &mut Graph,
    candidates: &[&Candidate],
    definite: Definiteness,
    given: &Procedure,
    (entries, decision): (&mut Vec<Entry>, &mut Decision),
) {
    let lengths: Vec<Count> = candidates.iter().map(|candidate| candidate.equations.length(graph)).collect();
    let alone = entries.iter().map(|entry| graph.operation_count(&entry.procedure.values(graph)));
    let shortest = alone.chain(lengths.iter().copied()).min().unwrap_or_default();
    let mut compared: Vec<Vec<ExprId>> = Vec::new();
    for (Candidate { form, equations }, length) in candidates.iter().zip(lengths) {
        let form = form.name();
        if sizes::is_much_longer(length, shortest) {
            decision.limits.push(format!("{form}: {length} operations{}{shortest}", sizes::BESIDE));
            continue;
        }
        let procedure = solved(graph, equations, definite, given);
        // different ways often lead to the same equations
        let values = procedure.values(graph);
        if !compared.contains(&values) {
            compared.push(values);
            entries.push(Entry { form, procedure });
        }
    }
}

/// (8) as it stands, where no form is admitted: with the pivots that its solution has, which `validate` names
/// where they are of parameters alone.
pub(super) fn plain_derivative(
    proved: &mut Proved,
    reference: &Reference,
    kept: &ConstraintDistribution,
    given: &Procedure,
    decision: &mut Decision,
) -> Option<Procedure> {
    let Candidate { equations, .. } = plain(proved, kept);
    let parameters: Vec<_> = proved.model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let graph = &mut proved.model.graph;
    let definite = definiteness(graph, &equations.mass, &parameters, &proved.facts);
    let kinds = [("plain", definite), ("plain, with pivoting", Definiteness::Unknown)];
    kinds.into_iter().find_map(|(form, definite)| {
        let entry = Entry { form, procedure: solved(graph, &equations, definite, given) };
        let finish = |_: &mut Graph, procedure: &Procedure| procedure.clone();
        admitted(graph, (reference, None), &[entry], finish, decision).ok()
    })
}

/// ẋ and v̇ by the equations, and ż as it is given.
fn solved(
    graph: &mut Graph,
    equations: &ReducedEquations,
    definite: Definiteness,
    given: &Procedure,
) -> Procedure {
    let mut procedure = moving(given, &equations.definitions.definitions, &equations.rates);
    let ReducedEquations { mass, force, .. } = equations;
    let accelerations = solve_symmetric(graph, mass, force, definite, &mut procedure, "v_dot");
    procedure.outputs.splice(equations.rates.len()..equations.rates.len(), accelerations);
    procedure
}

/// Intermediate results after those that are given, and outputs before them.
fn moving(given: &Procedure, definitions: &[Definition], outputs: &[ExprId]) -> Procedure {
    let mut procedure = given.clone();
    procedure.definitions.extend(definitions.iter().cloned());
    procedure.outputs = outputs.iter().chain(&given.outputs).copied().collect();
    procedure
}

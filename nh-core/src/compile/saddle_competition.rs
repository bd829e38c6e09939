//! The ways to solve the equations with multipliers: derived, compared and proved.

use super::cancellation::without_needless_cancellation;
use super::common_turn::counted_from_an_angle;
use super::proved::{Proved, nothing_proved};
use super::velocities_of_state::requested;
use crate::algebra::{Graph, Matrix};
use crate::choose::{
    Claim, Contender, Decision, Entry, Fate, Reference, Regular, fate as fate_of, prove, ranking, rate,
};
use crate::forms::Registry;
use crate::id::ExprId;
use crate::limits::attempt;
use crate::mechanics::{Definiteness, Procedure, SaddleEquations};
use crate::model::Request;
use crate::violation::Violation;

/// What the question may take whether a solution adds a condition; numerical pivoting adds none.
const CONDITIONS: u64 = 6_000_000;

/// What solves the saddle equations.
pub(super) struct Solved {
    pub(super) derivative: Procedure,
    /// The motion by (10), or with pivoting: it has a value where W and the constraints are regular, for which the
    /// functions beside it are derived.
    pub(super) regular: Procedure,
    pub(super) multipliers: Procedure,
    pub(super) reactions: Procedure,
}

/// The solution of the saddle equations that is proved to be what is declared: by elimination without pivoting where
/// that is known to be possible, else with it. The motion alone may be found in another way that is proved, too.
pub(super) fn proved_solution(
    proved: &mut Proved,
    registry: &Registry,
    equations: &SaddleEquations,
    (reference, given): (&Reference, &Procedure),
    judge: &dyn Fn(&Graph, &Matrix) -> Definiteness,
) -> Result<Solved, Vec<Violation>> {
    let mut decision = Decision { site: "derivative", ..Decision::default() };
    let [asks_multipliers, asks_reactions] =
        [Request::Multipliers, Request::Reactions].map(|request| requested(&proved.model, request));
    let parameters: Vec<_> = proved.model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let mut requests = proved.model.requests.iter();
    let is_differentiated = requests.any(|(request, _)| request.differentiates_the_motion());
    let given = &given.differentiated(is_differentiated);
    let graph = &mut proved.model.graph;
    let fixed = &proved.system.algebroid.anchor.coordinates;
    let factorised = equations.factorised(graph, judge);
    let nothing = Procedure::default();
    let regular = factorised.as_ref().map(|mass| Regular {
        reference,
        definitions: &nothing,
        mass,
        definiteness: Definiteness::Definite,
        jacobian: &equations.jacobian,
        turned: &[],
        parameters: &parameters,
        facts: &proved.facts,
    });
    let moving = |mut procedure: Procedure, accelerations: &[ExprId]| {
        procedure.outputs =
            equations.rates.iter().chain(accelerations).chain(&given.outputs).copied().collect();
        procedure
    };
    for is_pivoted in [false, true] {
        let regular = regular.as_ref().filter(|_| !is_pivoted);
        // 1. by complement, or with pivoting, and the multipliers
        let mut procedure = given.clone();
        let (accelerations, multipliers) = if is_pivoted {
            equations.solve_pivoted(graph, &mut procedure)
        } else {
            equations.solve(graph, judge, &mut procedure)
        };
        let reactions = (0..accelerations.len())
            .map(|alpha| {
                let column: Vec<ExprId> = equations.jacobian.iter().map(|row| row[alpha]).collect();
                graph.inner_product(&column, &multipliers)
            })
            .collect();
        // those of levels are zero
        let declared = proved.constraints.residuals.len();
        let multipliers = procedure.with_outputs(multipliers.into_iter().take(declared).collect());
        let reactions = procedure.with_outputs(reactions);
        let form = if is_pivoted { "with pivoting" } else { "by complement" };
        let procedure = moving(procedure, &accelerations);
        // 2. whether it is what is declared
        let finish = |graph: &mut Graph, procedure: &Procedure| {
            without_needless_cancellation(graph, procedure.clone(), fixed)
        };
        let asked = [&multipliers, &reactions];
        let admit = |graph: &mut Graph, derivative: &Procedure| {
            let mut proof = prove(graph, reference, &Claim::Motion(derivative));
            if asks_multipliers {
                let claim = Claim::Multipliers(derivative, &multipliers, None);
                proof = proof.and_then(|_| prove(graph, reference, &claim));
            }
            if asks_reactions {
                let claim = Claim::Reactions(derivative, &reactions);
                proof = proof.and_then(|_| prove(graph, reference, &claim));
            }
            without_conditions(graph, regular, fate_of(proof), &[[derivative].as_slice(), &asked].concat())
        };
        let own = finish(graph, &procedure);
        let fate = admit(graph, &own);
        if !matches!(fate, Fate::Chosen(_)) {
            decision.contenders.push(Contender { form, cost: None, rounding: None, fate });
            continue;
        }
        // 3. what else there is, and may be better
        let mut entries = vec![Entry { form, procedure }];
        for solution in registry.solutions().iter().filter(|_| regular.is_some()) {
            let mut procedure = given.clone();
            if let Some(accelerations) = solution.solve(graph, equations, judge, &mut procedure) {
                entries.push(Entry { form: solution.name(), procedure: moving(procedure, &accelerations) });
            }
        }
        let admit_motion = |graph: &mut Graph, derivative: &Procedure| {
            let fate = fate_of(prove(graph, reference, &Claim::Motion(derivative)));
            without_conditions(graph, regular, fate, &[derivative])
        };
        let better = better(graph, (entries, fate), (finish, &admit_motion), &mut decision);
        proved.ledger.decisions.push(decision);
        let derivative = better.unwrap_or_else(|| own.clone());
        let judged = (admit_motion, &mut proved.ledger.decisions);
        let derivative =
            counted_from_an_angle(graph, &derivative, fixed, judged, &mut proved.before_counting)
                .unwrap_or(derivative);
        proved.is_pivoted = is_pivoted;
        return Ok(Solved { derivative, regular: own, multipliers, reactions });
    }
    proved.ledger.decisions.push(decision);
    Err(nothing_proved(proved.model.origin, &proved.ledger))
}

/// What becomes of a solution that is proved, if it adds a condition.
fn without_conditions(
    graph: &mut Graph,
    regular: Option<&Regular>,
    fate: Fate,
    solved: &[&Procedure],
) -> Fate {
    let (Some(regular), Fate::Chosen(_)) = (regular, &fate) else { return fate };
    let added = || solved.iter().find_map(|solved| regular.added(graph, solved));
    match attempt(CONDITIONS, added) {
        Some(None) => fate,
        Some(Some(divisor)) => Fate::adds(graph, divisor),
        None => Fate::NotAdmitted("whether it adds a condition would take too many steps".into()),
    }
}

/// What is better than the first entry, which is admitted, and admitted itself, as it is finished; none is compared with
/// one that is not.
fn better(
    graph: &mut Graph,
    (mut entries, first): (Vec<Entry>, Fate),
    (finish, admit): (impl Fn(&mut Graph, &Procedure) -> Procedure, impl Fn(&mut Graph, &Procedure) -> Fate),
    decision: &mut Decision,
) -> Option<Procedure> {
    while entries.len() > 1 {
        let procedures: Vec<Procedure> = entries.iter().map(|entry| entry.procedure.clone()).collect();
        let ratings = rate(graph, &procedures);
        let order = ranking(&ratings);
        let best = order[0];
        let (found, fate) = if best == 0 {
            (None, first.clone())
        } else {
            let finished = finish(graph, &procedures[best]);
            let fate = admit(graph, &finished);
            (Some(finished), fate)
        };
        let is_admitted = matches!(fate, Fate::Chosen(_));
        decision.contenders.push(ratings[best].contender(entries[best].form, fate));
        if is_admitted {
            let losers = order[1..].iter();
            decision.contenders.extend(
                losers.map(|index| ratings[*index].contender(entries[*index].form, ratings[*index].loss())),
            );
            return found;
        }
        entries.remove(best);
    }
    // a single one needs no comparison
    decision.contenders.push(Contender { form: entries[0].form, cost: None, rounding: None, fate: first });
    None
}

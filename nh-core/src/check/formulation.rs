//! The formulation, and the velocities that the adapted state keeps.

use super::assumptions::on_the_base;
use super::constraints::Constraints;
use super::evidence::{counted, listed, shown};
use crate::algebra::{Demand, Facts, Graph};
use crate::geometry::independent_velocities::{Choice, NoChoice, Subsets, judge, search};
use crate::geometry::{ConstraintDistribution, LinearConstraints, Manifold, PivotSetting, is_excluded};
use crate::id::{ExprId, Id, Origin, SectionId, SymbolId};
use crate::model::{Formulation, Model};
use crate::violation::{Law, Violation};

/// How many sets of velocities are considered where more are named than the constraints determine.
const LIMIT: usize = 256;

/// The outcome of the choice.
#[derive(Clone, Debug)]
pub enum Chosen {
    /// A basis of D, valid wherever the conditions hold.
    Adapted {
        /// D.
        distribution: Box<ConstraintDistribution>,
        /// Expressions of parameters that must not vanish.
        conditions: Vec<ExprId>,
        /// What to say of the choice in the report.
        reason: String,
    },
    /// All velocities are kept, with multipliers.
    Projected {
        /// What to say of the choice in the report.
        reason: String,
    },
}

/// Chooses as the declaration asks, else an adapted basis valid everywhere, else the projected
/// formulation.
///
/// # Errors
/// A choice of the user that the constraints do not allow.
pub fn choose_formulation(
    model: &mut Model,
    constraints: &Constraints,
    facts: &Facts,
    base: &Manifold,
) -> Result<Chosen, Vec<Violation>> {
    let forced = model.formulation;
    if let (Some((Formulation::Projected, origin)), Some(_)) = (forced, &model.independent) {
        return Err(vec![contradictory(origin)]);
    }
    if let Some((Formulation::Projected, _)) = forced {
        return Ok(Chosen::Projected { reason: "the declaration asks for it".into() });
    }
    let Some(constraints) = &constraints.linear else { return nonlinear(model) };
    if constraints.annihilator.is_empty() {
        if let Some(named) = model.independent.clone() {
            dependent_of(model, &named, 0)?;
        }
        let velocities = velocities(model);
        let distribution = ConstraintDistribution::unconstrained(&mut model.graph, &velocities);
        return Ok(Chosen::Adapted {
            distribution: Box::new(distribution),
            conditions: Vec::new(),
            reason: "there are no constraints: D is all of E".into(),
        });
    }
    if !model.positions.is_empty() && model.independent.is_none() && forced.is_none() {
        let reason = "with position constraints the state keeps every velocity, whatever the configuration, \
                      unless `independent { … }` names those to keep";
        return Ok(Chosen::Projected { reason: reason.into() });
    }
    let parameters: Vec<SymbolId> = model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let on_base = base.restrict_matrix(&mut model.graph, &constraints.annihilator);
    let setting = PivotSetting {
        annihilator: &constraints.annihilator,
        on_base: &on_base,
        parameters: &parameters,
        facts,
    };
    match model.independent.clone() {
        Some(named) => named_choice(model, &setting, &named, constraints),
        None => searched_choice(model, &setting, forced, constraints),
    }
}

/// Nonlinear constraints leave no linear space of velocities to choose a basis of.
fn nonlinear(model: &Model) -> Result<Chosen, Vec<Violation>> {
    let asked = model
        .independent
        .as_ref()
        .and_then(|named| named.first().map(|(_, origin)| ("`independent`", *origin)))
        .or(model.formulation.map(|(_, origin)| ("the adapted formulation", origin)));
    match asked {
        None => Ok(Chosen::Projected { reason: "a constraint is nonlinear in the velocities".into() }),
        Some((what, origin)) => Err(vec![Violation {
            law: Law::Choice,
            origin,
            what: format!("{what} needs constraints that are linear or affine in the velocities"),
            evidence: "a constraint is nonlinear: the velocities that it allows are no linear space".into(),
            way_out: "leave it out: the projected formulation keeps every velocity".into(),
        }]),
    }
}

fn contradictory(origin: Origin) -> Violation {
    Violation {
        law: Law::Choice,
        origin,
        what: "`independent` has no meaning in the projected formulation".into(),
        evidence: "there every velocity is part of the state".into(),
        way_out: "leave out `independent`, or `formulation`".into(),
    }
}

/// The velocities that are not named, if as many are named as there have to be: as the constraints leave,
/// or as these and the levels of momenta do.
fn dependent_of(
    model: &Model,
    named: &[(SymbolId, Origin)],
    constraints: usize,
) -> Result<Vec<SectionId>, Vec<Violation>> {
    let on_constraints = model.sections.len() - constraints;
    let wanted = on_constraints.saturating_sub(model.routh.len());
    let velocities = velocities(model);
    if let Some((stranger, origin)) = named.iter().find(|(symbol, _)| !velocities.contains(symbol)) {
        return Err(vec![Violation {
            law: Law::Choice,
            origin: *origin,
            what: format!("`{}` is not a velocity of the basis", model.graph.symbols()[*stranger]),
            evidence: "the frame has put another section in its place".into(),
            way_out: "name velocities of the frame, or of declared sections that it leaves".into(),
        }]);
    }
    if named.len() == wanted || named.len() == on_constraints {
        let is_kept = |id: &SectionId| named.iter().any(|(symbol, _)| *symbol == model.sections[*id].symbol);
        return Ok(model.sections.ids().filter(|id| !is_kept(id)).collect());
    }
    Err(vec![Violation {
        law: Law::Choice,
        origin: named.first().map_or(model.origin, |(_, origin)| *origin),
        what: format!(
            "{} named as independent, but the number of independent velocities is {wanted}",
            counted(named.len(), "velocity is", "velocities are")
        ),
        evidence: format!(
            "{} less {}{}",
            counted(model.sections.len(), "velocity", "velocities"),
            counted(constraints, "constraint", "constraints"),
            match model.routh.len() {
                0 => String::new(),
                levels => format!(" and {}", counted(levels, "level", "levels")),
            }
        ),
        way_out: format!("name {wanted}, or leave `independent` out"),
    }])
}

fn velocities(model: &Model) -> Vec<SymbolId> {
    model.sections.iter().map(|section| section.symbol).collect()
}

fn names(model: &Model, sections: &[SectionId]) -> Vec<String> {
    sections.iter().map(|section| format!("`{}`", model.sections[*section].name)).collect()
}

fn undecided(model: &Model, why: String) -> Vec<Violation> {
    vec![Violation {
        law: Law::Decidable,
        origin: model.constraints.iter().next().map_or(model.origin, |constraint| constraint.origin),
        what: "the constraints could not be solved for any velocities".into(),
        evidence: why,
        way_out: "write them without roots of negative numbers and divisions by zero".into(),
    }]
}

fn named_choice(
    model: &mut Model,
    setting: &PivotSetting<'_>,
    named: &[(SymbolId, Origin)],
    constraints: &LinearConstraints,
) -> Result<Chosen, Vec<Violation>> {
    let dependent = dependent_of(model, named, constraints.annihilator.len())?;
    let judged = judged(model, setting, &dependent)?;
    let Some(choice) = judged else {
        return Err(vec![Violation {
            law: Law::Choice,
            origin: named.first().map_or(model.origin, |(_, origin)| *origin),
            what: "these velocities are not independent on the constraints".into(),
            evidence: format!("the constraints do not determine {}", listed(&names(model, &dependent))),
            way_out: "name others, or leave `independent` out and let them be chosen".into(),
        }]);
    };
    let mut reason = "the declaration names the independent velocities".to_owned();
    if !choice.breaks_down.is_empty() {
        reason = format!("{reason}; they break down where {}", zeros(&model.graph, &choice.breaks_down));
    }
    adapted(model, choice, constraints, reason)
}

/// The choice to eliminate these; if they are more than the constraints determine, as many of them, with a
/// pivot that vanishes nowhere if there is such: levels of momenta determine the rest.
fn judged(
    model: &mut Model,
    setting: &PivotSetting<'_>,
    dependent: &[SectionId],
) -> Result<Option<Choice>, Vec<Violation>> {
    let mut first = None;
    for places in Subsets::of(dependent.len(), setting.annihilator.len()).take(LIMIT) {
        let some: Vec<SectionId> = places.iter().map(|place| dependent[place.index()]).collect();
        let mut judged = judge(&mut model.graph, setting, &some).map_err(|why| undecided(model, why))?;
        if let Some(choice) = &mut judged {
            choice.breaks_down = reached(model, &choice.breaks_down);
        }
        if judged.as_ref().is_some_and(|choice| choice.breaks_down.is_empty()) {
            return Ok(judged);
        }
        first = first.or(judged);
    }
    Ok(first)
}

/// Those functions that what holds does not keep from 0.
pub(super) fn reached(model: &mut Model, functions: &[ExprId]) -> Vec<ExprId> {
    let mut holding = on_the_base(model);
    holding.extend(model.positions.iter().map(|position| (position.value, Demand::Zero)));
    let is_reached = |function: &&ExprId| !is_excluded(&mut model.graph, &holding, &[**function]);
    functions.iter().filter(is_reached).copied().collect()
}

/// `a = 0 or b = 0`.
pub(crate) fn zeros(graph: &Graph, factors: &[ExprId]) -> String {
    let zeros: Vec<String> = factors.iter().map(|f| format!("{} = 0", shown(graph, *f))).collect();
    zeros.join(" or ")
}

fn searched_choice(
    model: &mut Model,
    setting: &PivotSetting<'_>,
    forced: Option<(Formulation, Origin)>,
    constraints: &LinearConstraints,
) -> Result<Chosen, Vec<Violation>> {
    let preferred = solved_for(model);
    let rank = model.sections.len();
    let found = search(&mut model.graph, setting, &preferred, rank).map_err(|why| undecided(model, why))?;
    match (found, forced) {
        (Ok(choice), _) => {
            let eliminated = listed(&names(model, &choice.dependent));
            let reason = if choice.conditions.is_empty() {
                format!("{eliminated} can be eliminated wherever the constraints are independent")
            } else {
                let pivots: Vec<String> =
                    choice.conditions.iter().map(|e| format!("{} != 0", shown(&model.graph, *e))).collect();
                format!("{eliminated} can be eliminated where {}, which `validate` checks", listed(&pivots))
            };
            adapted(model, choice, constraints, reason)
        }
        (Err(failure), Some((_, origin))) => Err(vec![Violation {
            law: Law::Choice,
            origin,
            what: "no choice of independent velocities is valid everywhere".into(),
            evidence: tried(model, &failure),
            way_out: "name them in `independent { … }` and accept where they break down, or leave \
                      `formulation` out for the projected one"
                .into(),
        }]),
        (Err(failure), None) => Ok(Chosen::Projected {
            reason: format!(
                "no choice of independent velocities is valid everywhere: {}",
                tried(model, &failure)
            ),
        }),
    }
}

/// Velocities alone on the left of a constraint, each once.
fn solved_for(model: &Model) -> Vec<SectionId> {
    let mut sections: Vec<SectionId> = Vec::new();
    for symbol in model.constraints.iter().filter_map(|constraint| constraint.solved_for) {
        let section =
            model.sections.iter_ids().find(|(_, section)| section.symbol == symbol).map(|(id, _)| id);
        if let Some(section) = section.filter(|section| !sections.contains(section)) {
            sections.push(section);
        }
    }
    sections
}

fn tried(model: &Model, failure: &NoChoice) -> String {
    eliminations(&model.graph, failure, |dependent| listed(&names(model, dependent)))
}

/// What the choices that were tried divide by; `names` are those of the velocities.
pub(crate) fn eliminations(
    graph: &Graph,
    failure: &NoChoice,
    names: impl Fn(&[SectionId]) -> String,
) -> String {
    const SHOWN: usize = 3;
    let mut parts: Vec<String> = Vec::new();
    for (dependent, factor) in &failure.tried {
        let eliminated = names(dependent);
        let part = format!("eliminating {eliminated} divides by {}", shown(graph, *factor));
        if !parts.contains(&part) {
            parts.push(part);
        }
    }
    if parts.len() > SHOWN {
        parts.truncate(SHOWN);
        parts.push("and so on".into());
    }
    parts.join("; ")
}

fn adapted(
    model: &mut Model,
    choice: Choice,
    constraints: &LinearConstraints,
    reason: String,
) -> Result<Chosen, Vec<Violation>> {
    let velocities = velocities(model);
    let solved = ConstraintDistribution::solved_for(
        &mut model.graph,
        constraints.clone(),
        &choice.dependent,
        &velocities,
    );
    if let Some(distribution) = solved {
        let distribution = Box::new(distribution);
        return Ok(Chosen::Adapted { distribution, conditions: choice.conditions, reason });
    }
    let list = listed(&names(model, &choice.dependent));
    Err(undecided(model, format!("no solution for {list} was found")))
}

//! The velocities that a declaration might name, in its own words.

use crate::check::evidence::{counted, listed, shown};
use crate::geometry::independent_velocities::Choice;
use crate::geometry::suggested_velocities::Suggested;
use crate::id::{ExprId, SectionId};
use crate::model::Model;

/// What to write, what becomes of it, and where it is valid.
pub(crate) fn suggestion(model: &Model, suggested: &Suggested) -> String {
    let kept: Vec<String> = model
        .sections
        .ids()
        .filter(|section| !suggested.dependent.contains(section))
        .map(|section| as_written(model, section))
        .collect();
    let (sections, multipliers) = (model.sections.len(), suggested.dependent.len());
    let (one, accelerations) = ("acceleration", "accelerations");
    format!(
        "`independent {{ {} }}` would keep {} in the state, with {} to solve for in place of {} and {}; {}",
        kept.join(", "),
        counted(kept.len(), "velocity", "velocities"),
        counted(kept.len(), one, accelerations),
        counted(sections, one, accelerations),
        counted(multipliers, "multiplier", "multipliers"),
        suggested.judged.as_ref().map_or_else(
            || "where it breaks down was not found out".to_owned(),
            |choice| validity(model, choice)
        )
    )
}

/// The velocity as `independent` names it.
fn as_written(model: &Model, section: SectionId) -> String {
    let section = &model.sections[section];
    let of = model.coordinates.iter().find(|coordinate| coordinate.rate == section.symbol);
    of.map_or_else(|| section.name.clone(), |coordinate| format!("der({})", coordinate.name))
}

/// Where a choice is valid, and what it asks of the parameters.
pub(super) fn validity<I>(model: &Model, choice: &Choice<I>) -> String {
    let independent = choice.rank_drops.first().map(|_| "the constraints are independent".to_owned());
    let places: Vec<String> = independent.into_iter().chain(nonzero(model, &choice.breaks_down)).collect();
    let place = match places.as_slice() {
        [] => "everywhere".to_owned(),
        places => format!("where {}", listed(places)),
    };
    match nonzero(model, &choice.conditions).as_slice() {
        [] => format!("it is valid {place}"),
        conditions => format!("it is valid {place}, for parameters with {}", listed(conditions)),
    }
}

/// That factors are not 0, those that are short in so many words.
fn nonzero(model: &Model, factors: &[ExprId]) -> Vec<String> {
    let texts = factors.iter().map(|factor| shown(&model.graph, *factor));
    let (long, short): (Vec<String>, Vec<String>) = texts.partition(|text| text.contains('…'));
    let long = match long.len() {
        0 => None,
        1 => Some("a divisor that is too long to be shown is not 0".to_owned()),
        several => Some(format!("{several} divisors that are too long to be shown are not 0")),
    };
    short.into_iter().map(|text| format!("{text} != 0")).chain(long).collect()
}

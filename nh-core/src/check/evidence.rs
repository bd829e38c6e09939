//! The wording of evidence, shared by the checks.

use crate::algebra::{Graph, Witness};
use crate::geometry::{Drops, Manifold};
use crate::id::{ConstraintId, ExprId, Id};
use crate::model::Model;

/// Longest expression shown in a message, in bytes.
const SHOWN: usize = 160;

/// The expression as shown in messages.
pub(crate) fn shown(graph: &Graph, expression: ExprId) -> String {
    graph.text_within(expression, SHOWN)
}

/// How a constraint is called in messages.
pub(crate) fn name_of(model: &Model, id: ConstraintId) -> String {
    match &model.constraints[id].label {
        Some(label) => format!("`{label}`"),
        None => format!("constraint {}", id.index() + 1),
    }
}

/// What should have been zero, and where it is not.
pub(crate) fn not_zero(graph: &Graph, defect: ExprId, witness: &Witness) -> String {
    let place = witness.place(graph);
    let at = if place.is_empty() { String::new() } else { format!(" at {place}") };
    let shown = shown(graph, defect);
    if place.is_empty() {
        format!("{shown} should be 0")
    } else {
        format!("{shown} should be 0, {}{at}", but_is(witness.value))
    }
}

/// The same of what should vanish on a manifold: the place is one on it, in the symbols that are shown.
pub(crate) fn not_zero_on(graph: &Graph, defect: ExprId, witness: &Witness, manifold: &Manifold) -> String {
    if manifold.is_whole() {
        return not_zero(graph, defect, witness);
    }
    let shown = shown(graph, defect);
    let Some(point) = manifold.point(graph, witness, &graph.symbols_in(&[defect])) else {
        return format!("{shown} should be 0");
    };
    let place: Vec<String> = point
        .iter()
        .map(|(symbol, value)| format!("{} = {}", graph.symbols()[*symbol], short(*value)))
        .collect();
    format!("{shown} should be 0, {} at {}", but_is(witness.value), place.join(", "))
}

/// A value that is not 0, unless floating point cannot hold it.
pub(super) fn seen(value: f64) -> Option<String> {
    (value != 0.0 && value.is_finite()).then(|| short(value))
}

/// What should be 0, `but is 3 at x = 2`.
fn but_is(value: f64) -> String {
    format!("but is {}", seen(value).unwrap_or_else(|| "not".into()))
}

/// A number with four digits.
fn short(value: f64) -> String {
    let text = format!("{value:.4}");
    let trimmed = text.trim_end_matches('0').trim_end_matches('.');
    if trimmed == "0" || trimmed == "-0" { format!("{value:.3e}") } else { trimmed.to_owned() }
}

/// `1 constraint`, `2 constraints`.
pub(crate) fn counted(number: usize, one: &str, several: &str) -> String {
    format!("{number} {}", if number == 1 { one } else { several })
}

/// `a`, `a and b`, `a, b and c`.
pub(crate) fn listed<S: AsRef<str>>(names: &[S]) -> String {
    match names {
        [] => String::new(),
        [only] => only.as_ref().to_owned(),
        [first @ .., last] => {
            let first: Vec<&str> = first.iter().map(AsRef::as_ref).collect();
            format!("{} and {}", first.join(", "), last.as_ref())
        }
    }
}

/// `x = 0 and y = 0, or cos(theta) = 0`: where a rank drops; `None` where it drops nowhere or that is not
/// known.
pub(crate) fn places(graph: &Graph, drops: &Drops) -> Option<String> {
    let Drops::Where(sets) = drops else { return None };
    let zeros = |set: &Vec<ExprId>| {
        let mut zeros: Vec<String> = set.iter().map(|e| format!("{} = 0", shown(graph, *e))).collect();
        zeros.sort_by_key(String::len);
        zeros.join(" and ")
    };
    let text: Vec<String> = sets.iter().map(zeros).collect();
    let separator = if sets.iter().any(|set| set.len() > 1) { ", or " } else { " or " };
    (!text.is_empty()).then(|| text.join(separator))
}

//! Contradictions between units, in words.

use std::collections::BTreeSet;

use super::consistency::{Condition, Conflict, Equation, Side, WrongLine, given, solved};
use super::dimension::Dimension;
use super::elimination::Elimination;
use super::form::Unknown;
use crate::algebra::Graph;
use crate::id::Origin;
use crate::violation::{Law, Violation};

/// Names whose units are shown, and terms.
const SHOWN: usize = 6;

/// What a contradiction looks like, at the term that was met last, and at the others where it takes several.
pub(super) fn violations(graph: &Graph, conditions: &[Condition], conflict: &Conflict) -> Vec<Violation> {
    let Conflict { equations, declared } = conflict;
    let Some(last) = equations.first() else { return between_declared(graph, conditions, declared) };
    let others: Vec<&Equation> = declared.iter().chain(&equations[1..]).collect();
    let elsewhere = given(conditions, others.iter().copied());
    if equations.len() == 1 {
        return vec![unequal(graph, conditions, *last, &elsewhere)];
    }
    for equation in equations {
        if let Some(found) = twice(graph, conditions, conflict, *equation) {
            return found;
        }
    }
    let mut violation = unequal(graph, conditions, *last, &elsewhere);
    violation.evidence = listed(conditions, equations).join("\n");
    vec![violation]
}

/// A line of `units` that contradicts several terms, by the units that these have without it; or several lines of which
/// one does.
pub(super) fn wrong_lines(conditions: &[Condition], lines: &[WrongLine], rest: &Elimination) -> Violation {
    let told: Vec<Blamed> = match lines {
        [line] => vec![Blamed::of(conditions, line, rest)],
        several => several.iter().map(|line| Blamed::of(conditions, line, &line.rest)).collect(),
    };
    let what = match told.as_slice() {
        [Blamed { names, units, .. }] => format!("the unit of {names} does not fit: it is {units}"),
        several => {
            let each =
                several.iter().map(|Blamed { names, units, .. }| format!("that of {names} is {units}"));
            format!("one of these units does not fit: {}", each.collect::<Vec<_>>().join("; "))
        }
    };
    let way_out = if told.iter().all(|blamed| blamed.follows) {
        "correct it, or leave it out: it follows from the rest; or correct each of these terms"
    } else {
        "correct it: without it the rest has no contradiction; or correct each of these terms"
    };
    let mut terms: Vec<Equation> = Vec::new();
    for term in lines.iter().flat_map(|line| &line.terms) {
        if terms.iter().all(|known| known.condition != term.condition) {
            terms.push(*term);
        }
    }
    let evidence = listed(conditions, &terms).join("\n");
    Violation { law: Law::Units, origin: told[0].origin, what, evidence, way_out: way_out.into() }
}

/// How the unit that a line of `units` gives is called: the first side of a condition.
pub const IN_UNITS: &str = "its unit in `units`";

/// The names in a line of `units` that are wrong there.
struct Blamed {
    names: String,
    units: String,
    /// Whether their units follow from the rest.
    follows: bool,
    origin: Origin,
}

impl Blamed {
    fn of(conditions: &[Condition], line: &WrongLine, rest: &Elimination) -> Self {
        // what is expected, its unit, is said first
        let sides = |k: &usize| -> (&Side, &Side) {
            let sides = &conditions[*k].sides;
            (&sides[0], &sides[sides.len() - 1])
        };
        let of = |side: &Side| rest.reduced(side.form.as_ref()?).value().cloned();
        let unit = line.names.first().and_then(|k| of(sides(k).0)).unwrap_or_default();
        let elsewhere = |k: &usize| Some((*k, of(sides(k).1).filter(|found| *found != unit)?));
        let known: Vec<(usize, Dimension)> = line.names.iter().filter_map(elsewhere).collect();
        let blamed: Vec<usize> = match known.as_slice() {
            [] => line.contradicted.iter().copied().collect(),
            known => known.iter().map(|(k, _)| *k).collect(),
        };
        let names: Vec<&str> = blamed.iter().map(|k| sides(k).1.text.as_str()).collect();
        let by_rest = match known.as_slice() {
            [] => String::new(),
            [(_, first), others @ ..] if others.iter().all(|(_, other)| other == first) => {
                format!(", and {} by all the rest", said(first))
            }
            several => {
                let each = several.iter().map(|(k, unit)| format!("{} is {}", sides(k).1.text, said(unit)));
                format!(", and by all the rest {}", each.collect::<Vec<_>>().join(", "))
            }
        };
        Self {
            names: names.join(", "),
            units: format!("{} in `units`{by_rest}", said(&unit)),
            follows: !known.is_empty(),
            // a line is in a contradiction by one of its names at least
            origin: sides(&blamed[0]).1.origin,
        }
    }
}

/// One equation whose sides have different units by what `units` says.
fn unequal(graph: &Graph, conditions: &[Condition], equation: Equation, given: &Elimination) -> Violation {
    let condition = &conditions[equation.condition];
    let (left, right) = (&condition.sides[equation.left], &condition.sides[equation.right]);
    let dimension = |side: &Side| given.reduced(side.form.as_ref()?).value().cloned();
    // what is expected is said first
    let (first, second) = if equation.left < equation.right { (left, right) } else { (right, left) };
    let is_given = first.text == IN_UNITS;
    let what = if let (Some(a), Some(b)) = (dimension(first), dimension(second)) {
        let (a, b) = (said(&a), said(&b));
        if is_given {
            format!("the units do not fit: {} is {b}, and {a} in `units`", second.text)
        } else {
            format!("the units do not fit: {} is {a}, {} is {b}", first.text, second.text)
        }
    } else {
        let quotient = equation.of(conditions).map(|(_, _, quotient)| given.reduced(&quotient));
        let by = quotient.and_then(|quotient| quotient.value().cloned()).unwrap_or_default();
        format!("the units do not fit: {} is {} times {}", left.text, said(&by), right.text)
    };
    let relation = format!("{} {} {}", left.text, condition.relation, right.text);
    let units = units_of_names(graph, [left, right], given).join(", ");
    let parts = [if is_given { String::new() } else { relation }, units];
    let evidence = parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join("; ");
    let way_out =
        "a factor is missing, is too much or has a wrong power, or `units` gives a name a wrong unit";
    Violation { law: Law::Units, origin: left.origin, what, evidence, way_out: way_out.into() }
}

/// The units of the names in two terms.
fn units_of_names(graph: &Graph, sides: [&Side; 2], given: &Elimination) -> Vec<String> {
    let unknowns: BTreeSet<&Unknown> =
        sides.iter().filter_map(|side| side.form.as_ref()).flat_map(|form| form.unknowns.keys()).collect();
    let named = unknowns.into_iter().filter_map(|unknown| {
        let name = name(graph, unknown);
        // that of the time goes without saying
        let is_time = name == "`t`";
        let is_side = is_time || sides.iter().any(|side| side.text == name);
        let unit = solved(given, unknown).filter(|_| !is_side)?;
        Some(format!("{name} is {}", said(&unit)))
    });
    named.take(SHOWN).collect()
}

/// A name that would have one unit here and another one there.
fn twice(
    graph: &Graph,
    conditions: &[Condition],
    conflict: &Conflict,
    here: Equation,
) -> Option<Vec<Violation>> {
    let is_here = |equation: &&Equation| equation.condition == here.condition;
    let Conflict { equations, declared } = conflict;
    let by_this = given(conditions, declared.iter().chain(equations.iter().filter(is_here)));
    let by_others = given(conditions, declared.iter().chain(equations.iter().filter(|e| !is_here(e))));
    let (left, right, quotient) = here.of(conditions)?;
    let by_units = given(conditions, declared);
    let (unknown, one, other) = quotient.unknowns.keys().find_map(|unknown| {
        if solved(&by_units, unknown).is_some() {
            return None;
        }
        Some((unknown, solved(&by_this, unknown)?, solved(&by_others, unknown)?))
    })?;
    let name = name(graph, unknown);
    let there: Vec<Equation> = equations.iter().filter(|e| !is_here(e)).copied().collect();
    let what = format!(
        "the units contradict each other: {name} would be {} here, {} elsewhere",
        said(&one),
        said(&other)
    );
    let relation = conditions[here.condition].relation;
    let mut evidence = vec![format!("here {} {relation} {}", left.text, right.text)];
    evidence.extend(listed(conditions, &there));
    let way_out = match unknown {
        Unknown::Method(_) | Unknown::Argument(..) => {
            "in all calls of a method an argument has one unit, and so has the value: correct one of them, or call \
             another method"
                .into()
        }
        Unknown::Symbol(_) | Unknown::Constant(_) | Unknown::Lagrangian => {
            format!("give the unit of {name} in `units` to see which of these is wrong")
        }
    };
    let origin = left.origin;
    let evidence = evidence.join("\n");
    let mut found = vec![Violation { law: Law::Units, origin, what, evidence, way_out }];
    if let [there] = there.as_slice() {
        let (left, right, _) = there.of(conditions)?;
        let what = format!("{name} would be {} here", said(&other));
        let evidence = format!("{} {} {}", left.text, conditions[there.condition].relation, right.text);
        found.push(Violation {
            law: Law::Units,
            origin: left.origin,
            what,
            evidence,
            way_out: String::new(),
        });
    }
    Some(found)
}

/// The equations as lines.
fn listed(conditions: &[Condition], equations: &[Equation]) -> Vec<String> {
    let line = |equation: &Equation| {
        let condition = &conditions[equation.condition];
        let (left, right) = (&condition.sides[equation.left], &condition.sides[equation.right]);
        format!("in `{}` {} {} {}", condition.section, left.text, condition.relation, right.text)
    };
    let mut lines: Vec<String> = Vec::new();
    for line in equations.iter().map(line) {
        if !lines.contains(&line) {
            lines.push(line);
        }
    }
    let more = lines.len().saturating_sub(SHOWN);
    lines.truncate(SHOWN);
    if more > 0 {
        lines.push(format!("and {more} more"));
    }
    lines
}

/// Lines of `units` that contradict each other.
fn between_declared(graph: &Graph, conditions: &[Condition], declared: &[Equation]) -> Vec<Violation> {
    let Some((last, others)) = declared.split_last() else { return Vec::new() };
    let elsewhere = given(conditions, others);
    let mut violation = unequal(graph, conditions, *last, &elsewhere);
    let texts: Vec<&str> =
        declared.iter().map(|e| conditions[e.condition].sides[e.left].text.as_str()).collect();
    violation.evidence = format!("the units of {} belong together", texts.join(", "));
    violation.way_out = "leave one of them out: it follows from the others".into();
    vec![violation]
}

/// A dimension in a sentence.
fn said(dimension: &Dimension) -> String {
    if dimension.is_none() { "a pure number".into() } else { dimension.to_string() }
}

/// What an unknown is called.
fn name(graph: &Graph, unknown: &Unknown) -> String {
    match unknown {
        Unknown::Symbol(symbol) => format!("`{}`", graph.symbols()[*symbol]),
        Unknown::Constant(constant) => format!("`{}`", graph.constants()[*constant].name),
        Unknown::Lagrangian => "the Lagrangian".into(),
        Unknown::Method(method) => format!("`self.{method}(…)`"),
        Unknown::Argument(method, k) => format!("argument {} of `self.{method}`", k + 1),
    }
}

//! All conditions of a declaration together: what follows of units, or what contradicts what.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use super::elimination::{Elimination, Taken};
use super::form::Form;
use super::inferred::Inferred;
use super::wording;
use crate::algebra::{Graph, Rational};
use crate::id::Origin;
use crate::violation::Violation;

/// Something in a condition.
#[derive(Clone, Debug)]
pub struct Side {
    /// How a message names it: a term in backquotes, or what is expected in words.
    pub text: String,
    /// Its dimension; none for 0, whose dimension is any.
    pub form: Option<Form>,
    /// Where it stands.
    pub origin: Origin,
}

/// Things that have the same dimension.
#[derive(Clone, Debug)]
pub struct Condition {
    /// At least one of them; what is expected comes first.
    pub sides: Vec<Side>,
    /// What makes them equal, as in "`a` *is added to* `b`".
    pub relation: &'static str,
    /// The keyword of the section in which it stands; empty for what `units` declares.
    pub section: &'static str,
    /// A number for its place in the declaration: what a loop comes by again has the same one.
    pub place: usize,
    /// The conditions that stand inside this one, and in what it is made of.
    pub within: Vec<Range<usize>>,
}

/// The place of what is taken for granted and stands nowhere.
pub const USUAL: usize = 0;

impl Condition {
    /// Whether it is a line of `units`.
    #[must_use]
    pub fn is_declared(&self) -> bool {
        self.section.is_empty()
    }
}

/// One equation: a side of a condition over another one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Equation {
    pub(super) condition: usize,
    pub(super) left: usize,
    pub(super) right: usize,
}

impl Equation {
    pub(super) fn of(self, conditions: &[Condition]) -> Option<(&Side, &Side, Form)> {
        let sides = &conditions[self.condition].sides;
        let (left, right) = (&sides[self.left], &sides[self.right]);
        let quotient = left.form.clone()?.over(right.form.as_ref()?);
        Some((left, right, quotient))
    }
}

/// A contradiction: equations of which none can be left out.
#[derive(Clone, Debug)]
pub struct Conflict {
    /// Those of the declaration, the one that was met last in front.
    pub(super) equations: Vec<Equation>,
    /// Those of `units`.
    pub(super) declared: Vec<Equation>,
}

/// What follows of units.
///
/// # Errors
/// Every contradiction, shown by an irreducible set of terms; or a line of `units` that
/// contradicts several terms.
pub fn infer(graph: &Graph, conditions: &[Condition]) -> Result<Inferred, Vec<Violation>> {
    let search = Search::of(conditions, |_| true);
    if search.conflicts.is_empty() {
        return Ok(Inferred { equations: search.elimination });
    }
    let (wrong, rest) = wrong_lines(conditions, search);
    let wrong = wrong.iter().map(|lines| wording::wrong_lines(conditions, lines, &rest.elimination));
    let others = rest.conflicts.iter().flat_map(|conflict| wording::violations(graph, conditions, conflict));
    Err(wrong.chain(others).collect())
}

/// A line of `units` that contradicts several terms.
pub(super) struct WrongLine {
    /// The conditions of its names.
    pub(super) names: Vec<usize>,
    /// Those that are in a contradiction, one at least.
    pub(super) contradicted: BTreeSet<usize>,
    /// What is contradicted no longer without it.
    pub(super) terms: Vec<Equation>,
    /// What the rest says.
    pub(super) rest: Elimination,
}

/// Lines in contradictions beyond which none is left out: each takes all conditions up anew.
const MOST_LINES: usize = 64;

/// Lines of `units` without each of which there are several contradictions less, each with others that may be to blame
/// instead; and what is left without them.
fn wrong_lines(conditions: &[Condition], mut search: Search) -> (Vec<Vec<WrongLine>>, Search) {
    let mut found: Vec<Vec<WrongLine>> = Vec::new();
    let mut left_out = BTreeSet::new();
    while search.conflicts.len() > 1 {
        let lines = search.lines_in_conflicts(conditions);
        if lines.len() > MOST_LINES {
            break;
        }
        // 1. without each of them, what helps most first
        let mut tried: Vec<(usize, Involved, Search)> = Vec::new();
        for (place, involved) in lines {
            let kept =
                |condition: &Condition| condition.place != place && !left_out.contains(&condition.place);
            tried.push((place, involved, Search::of(conditions, kept)));
        }
        let gain = |rest: &Search| search.conflicts.len().saturating_sub(rest.conflicts.len());
        tried.retain(|(.., rest)| gain(rest) > 1);
        tried.sort_by_key(|(.., rest)| rest.conflicts.len());
        // 2. those that have no contradiction in common are wrong beside each other, those of one gain that have, instead
        let mut told: BTreeSet<usize> = BTreeSet::new();
        let before = found.len();
        for (index, (place, involved, rest)) in tried.iter().enumerate() {
            if !involved.terms.is_disjoint(&told) {
                continue;
            }
            let others = tried[index..].iter();
            let instead = others.filter(|(_, other, without)| {
                gain(without) == gain(rest)
                    && !other.terms.is_disjoint(&involved.terms)
                    && other.terms.is_disjoint(&told)
            });
            let instead: Vec<&(usize, Involved, Search)> = instead.collect();
            let line = |(place, involved, rest): &&(usize, Involved, Search)| {
                search.wrong_line(conditions, *place, involved, rest)
            };
            found.push(instead.iter().map(line).collect());
            told.extend(instead.iter().flat_map(|(_, other, _)| other.terms.iter().copied()));
            left_out.insert(*place);
        }
        if found.len() == before {
            break;
        }
        search = Search::of(conditions, |condition| !left_out.contains(&condition.place));
    }
    (found, search)
}

/// What a line of `units` has to do with contradictions.
#[derive(Default)]
struct Involved {
    /// The conditions of its names that are in one.
    names: BTreeSet<usize>,
    /// The conditions that were met last in these.
    terms: BTreeSet<usize>,
}

#[derive(Default)]
struct Search {
    elimination: Elimination,
    /// The equations that were taken up, by their numbers.
    equations: Vec<Equation>,
    /// Conditions that are in a contradiction.
    bad: BTreeSet<usize>,
    places: BTreeSet<usize>,
    conflicts: Vec<Conflict>,
}

impl Search {
    /// All conditions that are `kept`, the lines of `units` first.
    fn of(conditions: &[Condition], kept: impl Fn(&Condition) -> bool) -> Self {
        let mut search = Self::default();
        let all = (0..conditions.len()).filter(|k| kept(&conditions[*k]));
        let (declared, written): (Vec<usize>, Vec<usize>) = all.partition(|k| conditions[*k].is_declared());
        for k in declared.into_iter().chain(written) {
            search.take(conditions, k);
        }
        search
    }

    /// The lines of `units` that are in a contradiction, by their places.
    fn lines_in_conflicts(&self, conditions: &[Condition]) -> BTreeMap<usize, Involved> {
        let mut found: BTreeMap<usize, Involved> = BTreeMap::new();
        for conflict in &self.conflicts {
            for line in &conflict.declared {
                let place = conditions[line.condition].place;
                // what is usual stands in no line
                if place != USUAL {
                    let involved = found.entry(place).or_default();
                    involved.names.insert(line.condition);
                    involved.terms.extend(conflict.equations.first().map(|equation| equation.condition));
                }
            }
        }
        found
    }

    /// A line that contradicts the terms of these contradictions, and what the rest says.
    fn wrong_line(
        &self,
        conditions: &[Condition],
        place: usize,
        involved: &Involved,
        rest: &Self,
    ) -> WrongLine {
        let last = |conflict: &Conflict| conflict.equations.first().copied();
        let is_its = |equation: &Equation| involved.terms.contains(&equation.condition);
        let is_named = |k: &usize| conditions[*k].is_declared() && conditions[*k].place == place;
        WrongLine {
            names: (0..conditions.len()).filter(is_named).collect(),
            contradicted: involved.names.clone(),
            terms: self.conflicts.iter().filter_map(last).filter(is_its).collect(),
            rest: rest.elimination.clone(),
        }
    }

    fn take(&mut self, conditions: &[Condition], k: usize) {
        let condition = &conditions[k];
        // what is made of a contradiction contradicts much: one of them is said
        if condition.within.iter().any(|inside| self.bad.range(inside.clone()).next().is_some()) {
            self.bad.insert(k);
            return;
        }
        let right = self.reference(condition);
        for left in (0..condition.sides.len()).filter(|left| *left != right) {
            let equation = Equation { condition: k, left, right };
            let Some((_, _, quotient)) = equation.of(conditions) else { continue };
            let number = self.equations.len();
            self.equations.push(equation);
            if let Taken::Contradiction(numbers) = self.elimination.take(number, quotient) {
                self.contradict(conditions, number, &numbers);
            }
        }
    }

    /// The side with which the others are compared: what most of them agree with, and of these the first.
    fn reference(&self, condition: &Condition) -> usize {
        let forms: Vec<Option<Form>> = condition
            .sides
            .iter()
            .map(|side| side.form.as_ref().map(|form| self.elimination.reduced(form)))
            .collect();
        let agreeing = |k: usize| forms.iter().filter(|form| form.is_some() && **form == forms[k]).count();
        let candidates = (0..forms.len()).filter(|k| forms[*k].is_some());
        candidates.rev().max_by_key(|k| agreeing(*k)).unwrap_or(0)
    }

    fn contradict(&mut self, conditions: &[Condition], last: usize, numbers: &[usize]) {
        let all = numbers.iter().map(|number| self.equations[*number]);
        let (declared, mut equations): (Vec<_>, Vec<_>) =
            all.partition(|equation| conditions[equation.condition].is_declared());
        let own = self.equations[last].condition;
        equations.sort_by_key(|equation| equation.condition != own);
        let is_new = equations.iter().all(|equation| !self.bad.contains(&equation.condition))
            && self.places.insert(conditions[own].place);
        for equation in &equations {
            // what it is made of may be what is wrong
            self.bad.extend(conditions[equation.condition].within.iter().cloned().flatten());
            self.bad.insert(equation.condition);
        }
        if is_new {
            self.conflicts.push(Conflict { equations, declared });
        }
    }
}

/// What some of the equations say of a dimension.
pub(super) fn given<'a>(
    conditions: &[Condition],
    equations: impl IntoIterator<Item = &'a Equation>,
) -> Elimination {
    let mut elimination = Elimination::default();
    for (number, equation) in equations.into_iter().enumerate() {
        if let Some((_, _, quotient)) = equation.of(conditions) {
            elimination.take(number, quotient);
        }
    }
    elimination
}

/// `left = right`, solved for an unknown of it: `None` where that does not occur.
pub(super) fn solved(elimination: &Elimination, unknown: &super::Unknown) -> Option<super::Dimension> {
    elimination.reduced(&Form::none().times(&Form::of(unknown.clone()), &Rational::ONE)).value().cloned()
}

//! Names for the intermediate results of generated functions.

use std::collections::{BTreeMap, BTreeSet};

use nonholonomic_core::algebra::Function;
use nonholonomic_core::id::Table;
use nonholonomic_core::program::{Program, Step, Value};
use proc_macro2::Ident;

use super::layout::local;
use super::symbols::Scope;

/// Hands out each name once.
#[derive(Clone)]
pub(super) struct Names {
    taken: BTreeSet<String>,
    /// How many times a name was asked for: it was handed out with all lower numbers.
    asked: BTreeMap<String, usize>,
    counter: usize,
}

impl Names {
    pub(super) fn new() -> Self {
        let taken = [
            "t",
            "state",
            "input",
            "start",
            "present",
            "unit",
            "series",
            "workspace",
            "phase",
            "covector",
            "length",
            "given",
            "way",
            "angles",
        ]
        .map(str::to_owned)
        .into();
        Self { taken, asked: BTreeMap::new(), counter: 0 }
    }

    /// The name, made a variable's and unique.
    pub(super) fn unique(&mut self, name: &str) -> Ident {
        let mut text = String::new();
        for c in name.chars() {
            let c = if c.is_alphanumeric() { c } else { '_' };
            if c != '_' || !(text.is_empty() || text.ends_with('_')) {
                text.extend(c.to_lowercase());
            }
        }
        let text = text.trim_end_matches('_');
        let is_name = text.starts_with(|c: char| c.is_alphabetic()) && syn::parse_str::<Ident>(text).is_ok();
        let base = if is_name { text.to_owned() } else { format!("n{text}") };
        let count = self.asked.entry(base.clone()).or_insert(0);
        let mut candidate = if *count == 0 { base.clone() } else { format!("{base}_{}", *count + 1) };
        *count += 1;
        while !self.taken.insert(candidate.clone()) {
            *count += 1;
            candidate = format!("{base}_{count}");
        }
        local(&candidate)
    }

    /// `e1`, `e2`, …
    pub(super) fn numbered(&mut self) -> Ident {
        self.counter += 1;
        self.unique(&format!("e{}", self.counter))
    }

    /// The name of a coefficient of a result: `sin_theta_k`.
    pub(super) fn of_coefficient(&mut self, program: &Program, value: Value, scope: &Scope) -> Ident {
        match describe(program, value, scope) {
            Some(name) => self.unique(&format!("{name}_k")),
            None => self.numbered(),
        }
    }

    /// The name of a result: what it is, where that is short to say.
    pub(super) fn of(&mut self, program: &Program, value: Value, scope: &Scope) -> Ident {
        match describe(program, value, scope) {
            Some(name) => self.unique(&name),
            None => self.numbered(),
        }
    }
}

/// What a symbol or definition is called.
fn short(program: &Program, value: Value, scope: &Scope) -> Option<String> {
    if let Some(symbol) = program.names.get(&value) {
        return Some(scope.name(*symbol).to_owned());
    }
    match &program.steps[value] {
        Step::Load(symbol) => Some(scope.name(*symbol).to_owned()),
        _ => None,
    }
}

/// `sin_theta`, `omega_squared`, …
fn describe(program: &Program, value: Value, scope: &Scope) -> Option<String> {
    if let Some(symbol) = program.names.get(&value) {
        return Some(scope.name(*symbol).to_owned());
    }
    let steps: &Table<Value, Step> = &program.steps;
    let of = |operand: &Value| short(program, *operand, scope);
    match &steps[value] {
        Step::SinOf(pair) | Step::CosOf(pair) => {
            let function = if matches!(steps[value], Step::SinOf(_)) { "sin" } else { "cos" };
            let angle = steps[*pair].operands().first().and_then(of);
            Some(angle.map_or_else(|| function.to_owned(), |angle| format!("{function}_{angle}")))
        }
        Step::Apply(function, a) if *function != Function::Sign => {
            of(a).map(|a| format!("{}_{a}", function.name()))
        }
        Step::Sqrt(a) => of(a).map(|a| format!("sqrt_{a}")),
        Step::Recip(a) => of(a).map(|a| format!("over_{a}")),
        Step::Mul(a, b) if a == b => of(a).map(|a| format!("{a}_squared")),
        Step::Mul(a, b) => Some(format!("{}_{}", of(a)?, of(b)?)),
        _ => None,
    }
    .filter(|name| name.len() <= 24)
}

/// The values that are the components of a linear system's solution; none where one is not needed.
pub(super) fn unknowns(program: &Program, solve: Value, n: usize) -> Vec<Option<Value>> {
    let component = |index| move |(_, step): &(Value, &Step)| **step == Step::Component(solve, index);
    (0..n).map(|index| Some(program.steps.iter_ids().find(component(index))?.0)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nonholonomic_core::limits::timed;

    #[test]
    fn names_are_numbered_past_those_that_are_taken() {
        let mut names = Names::new();
        let found = ["a", "a_2", "a", "A", "a_2", "state", "a"].map(|name| names.unique(name).to_string());
        assert_eq!(found, ["a", "a_2", "a_3", "a_4", "a_2_2", "state_2", "a_5"]);
    }

    #[test]
    fn a_name_that_is_asked_for_often_is_found_at_once() {
        let mut names = Names::new();
        let (last, seconds) = timed(|| (0..20_000).map(|_| names.unique("a")).last());
        assert_eq!(last.map(|name| name.to_string()), Some("a_20000".into()));
        // a search from the first number on takes minutes
        assert!(seconds < 20.0, "{seconds} s");
    }
}

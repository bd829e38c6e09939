//! A program in two parts: what depends on parameters alone, and the rest.

use super::fuse::constants;
use super::lower::without_dead_steps;
use super::step::{Program, Step, Value};
use crate::id::{Id, SymbolId, Table};
use std::collections::BTreeMap;

/// What is computed once per parameter set, and what is computed at every evaluation.
#[derive(Clone, Debug)]
pub struct Split {
    /// The part that depends on parameters alone; its outputs go into the other part.
    pub ahead: Program,
    /// The rest, which loads the outputs of `ahead` as `symbols`.
    pub rest: Program,
    /// A symbol for each output of `ahead`.
    pub symbols: Vec<SymbolId>,
}

/// Splits a program. Symbols from `free` on must be unused: they stand for what is computed ahead.
#[must_use]
pub fn split(program: &Program, parameters: &[SymbolId], free: usize) -> Split {
    // 1. what depends on parameters alone, and is more than a number
    let fixed = program.fixed(|symbol| parameters.contains(&symbol));
    let constant = constants(program);
    // 2. of that, what the rest uses
    let mut border: BTreeMap<Value, SymbolId> = BTreeMap::new();
    let varying = program.steps.iter_ids().filter(|(value, _)| !fixed[value.index()]);
    let used = varying.flat_map(|(_, step)| step.operands()).chain(program.outputs.iter().copied());
    for value in used {
        let is_result = !matches!(program.steps[value], Step::Load(_)) && !constant[value.index()];
        if fixed[value.index()] && is_result {
            border.insert(value, SymbolId::from_index(0));
        }
    }
    for (offset, symbol) in border.values_mut().enumerate() {
        *symbol = SymbolId::from_index(free + offset);
    }
    // 3. the rest loads them
    let mut steps: Table<Value, Step> = Table::new();
    for (value, step) in program.steps.iter_ids() {
        steps.push(border.get(&value).map_or_else(|| step.clone(), |symbol| Step::Load(*symbol)));
    }
    let mut names = program.names.clone();
    names.retain(|value, _| !border.contains_key(value));
    let rest = without_dead_steps(&Program { steps, outputs: program.outputs.clone(), names });
    let ahead = Program { outputs: border.keys().copied().collect(), ..program.clone() };
    Split { ahead: without_dead_steps(&ahead), rest, symbols: border.into_values().collect() }
}

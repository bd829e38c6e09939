//! Where the steps of a program have values: what they are divided by, and what stands under roots and logarithms.

use super::step::Step;
use crate::algebra::Function;
use rustc_hash::FxHashMap;

/// Sets of conditions, each known by a number; the empty one is 0.
pub(super) struct Conditions {
    sets: Vec<Vec<usize>>,
    known: FxHashMap<Vec<usize>, usize>,
    unions: FxHashMap<(usize, usize), usize>,
}

impl Conditions {
    pub(super) fn new() -> Self {
        Self {
            sets: vec![Vec::new()],
            known: FxHashMap::from_iter([(Vec::new(), 0)]),
            unions: FxHashMap::default(),
        }
    }

    /// The set of a single condition.
    pub(super) fn single(&mut self, condition: usize) -> usize {
        self.of(vec![condition])
    }

    /// What both sets ask.
    pub(super) fn union(&mut self, a: usize, b: usize) -> usize {
        if a == b || b == 0 {
            return a;
        }
        let pair = (a.min(b), a.max(b));
        if let Some(union) = self.unions.get(&pair) {
            return *union;
        }
        let mut all: Vec<usize> = self.sets[a].iter().chain(&self.sets[b]).copied().collect();
        all.sort_unstable();
        all.dedup();
        let union = self.of(all);
        self.unions.insert(pair, union);
        union
    }

    fn of(&mut self, set: Vec<usize>) -> usize {
        let next = self.sets.len();
        let found = *self.known.entry(set.clone()).or_insert(next);
        if found == next {
            self.sets.push(set);
        }
        found
    }
}

/// Whether a step has values for some of its operands only, or has a derivative for some only.
pub(super) fn is_partial(step: &Step) -> bool {
    !matches!(
        step,
        Step::Constant(_)
            | Step::Pi
            | Step::Load(_)
            | Step::Add(..)
            | Step::Sub(..)
            | Step::Mul(..)
            | Step::MulAdd { .. }
            | Step::Neg(_)
            | Step::SinCos(_)
            | Step::SinOf(_)
            | Step::CosOf(_)
            | Step::Component(..)
            | Step::Apply(
                Function::Sin
                    | Function::Cos
                    | Function::Atan
                    | Function::Sinh
                    | Function::Cosh
                    | Function::Tanh
                    | Function::Exp,
                _
            )
    )
}

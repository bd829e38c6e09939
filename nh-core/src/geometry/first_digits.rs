//! Digits modulo a small prime at which functions vanish, found by trying all of them.

use crate::algebra::{Residue, ResidueSteps, StepsModulo};
use crate::limits;

/// At most so many first digits are given by one search.
const LEAVES: usize = 24;
/// Steps modulo a small number that count as one unit of work.
const STEPS_PER_UNIT: u64 = 8;

/// The word of a number among those of a seed.
pub(super) fn random(seed: u64, number: u64) -> u64 {
    Residue::mixed(seed, number).word()
}

/// The search for first digits of all coordinates, one after the other: a function is looked at as soon as all that is in
/// it has digits.
pub(super) struct Search<'a> {
    trial: &'a StepsModulo,
    /// The coordinates by their places, in the order in which they get digits.
    order: Vec<usize>,
    /// The steps that wait for the coordinate, and the functions among them.
    waiting: Vec<(Vec<usize>, Vec<usize>)>,
    digits: Vec<u64>,
    values: Vec<u64>,
    seed: u64,
    leaves: usize,
    /// The work that is left to it.
    pub(super) left: u64,
}

impl<'a> Search<'a> {
    pub(super) fn new(
        steps: &ResidueSteps,
        trial: &'a StepsModulo,
        coordinates: &[usize],
        functions: usize,
        seed: u64,
        left: u64,
    ) -> Self {
        let roots = &steps.roots[..functions];
        let mut is_needed = vec![false; trial.len()];
        for root in roots {
            is_needed[*root] = true;
        }
        let mut of: Vec<Vec<usize>> = vec![Vec::new(); trial.len()];
        for place in (0..trial.len()).rev() {
            if is_needed[place] {
                for operand in trial.needs(place).0 {
                    is_needed[operand] = true;
                }
            }
        }
        for place in 0..trial.len() {
            let (operands, chosen) = trial.needs(place);
            let mut coordinates_in: Vec<usize> =
                operands.iter().flat_map(|operand| of[*operand].clone()).collect();
            coordinates_in.extend(chosen.filter(|chosen| coordinates.contains(chosen)));
            coordinates_in.sort_unstable();
            coordinates_in.dedup();
            of[place] = coordinates_in;
        }
        let order = in_order(roots.iter().map(|root| of[*root].clone()).collect());
        let level = |place: usize| {
            let levels = of[place].iter().filter_map(|c| order.iter().position(|other| other == c));
            levels.map(|level| level + 1).max().unwrap_or(0)
        };
        let mut waiting = vec![(Vec::new(), Vec::new()); order.len() + 1];
        for place in (0..trial.len()).filter(|place| is_needed[*place]) {
            waiting[level(place)].0.push(place);
        }
        for root in roots {
            waiting[level(*root)].1.push(*root);
        }
        let prime = trial.power.prime();
        let digits = (0..).take(steps.chosen.len()).map(|place| random(seed, place) % prime).collect();
        Self { trial, order, waiting, digits, values: vec![0; trial.len()], seed, leaves: LEAVES, left }
    }

    /// Gives digits at which all functions vanish to `visit`, as long as it wants more.
    pub(super) fn run(&mut self, visit: &mut dyn FnMut(u64, &[u64]) -> bool) {
        if self.holds(0) {
            self.descend(0, visit);
        }
    }

    /// Takes the steps of a level; whether they have values, and the functions among them vanish.
    fn holds(&mut self, level: usize) -> bool {
        let (steps, functions) = &self.waiting[level];
        let work = 1 + u64::try_from(steps.len()).unwrap_or(u64::MAX) / STEPS_PER_UNIT;
        self.left = self.left.saturating_sub(work);
        limits::spend(usize::try_from(work).unwrap_or(usize::MAX));
        let taken = steps.iter().try_for_each(|step| self.trial.take(*step, &self.digits, &mut self.values));
        taken.is_some() && functions.iter().all(|function| self.values[*function] == 0)
    }

    /// The level at which to go on; `None` once nothing more is wanted.
    fn descend(&mut self, level: usize, visit: &mut dyn FnMut(u64, &[u64]) -> bool) -> Option<usize> {
        let Some(coordinate) = self.order.get(level).copied() else {
            self.leaves -= 1;
            let leaf = random(self.seed, u64::try_from(self.leaves).unwrap_or(0));
            let is_enough = !visit(leaf, &self.digits) || self.leaves == 0;
            // neighbours are of one part: others come sooner where earlier coordinates have other digits
            let levels = u64::try_from(level.max(1)).unwrap_or(1);
            return (!is_enough).then(|| usize::try_from(leaf % levels).unwrap_or(0));
        };
        let prime = self.trial.power.prime();
        let start = random(self.seed ^ u64::MAX, u64::try_from(coordinate).unwrap_or(0));
        for digit in 0..prime {
            if self.left == 0 {
                return None;
            }
            self.digits[coordinate] = (start % prime + digit) % prime;
            if self.holds(level + 1) {
                let going_on = self.descend(level + 1, visit)?;
                if going_on < level {
                    return Some(going_on);
                }
            }
        }
        Some(level)
    }
}

/// An order in which functions get all that is in them early.
fn in_order(mut functions: Vec<Vec<usize>>) -> Vec<usize> {
    let mut order: Vec<usize> = Vec::new();
    while let Some(next) = (0..functions.len())
        .min_by_key(|index| functions[*index].iter().filter(|place| !order.contains(place)).count())
    {
        for place in functions.swap_remove(next) {
            if !order.contains(&place) {
                order.push(place);
            }
        }
    }
    order
}

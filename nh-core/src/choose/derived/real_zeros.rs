//! Whether a divisor vanishes at real points where the motion has a value: looked for between random points, by its
//! changes of sign and by its least values.

use super::super::proof::defined;
use super::divisors::Divisor;
use super::kinetic_energy::KineticEnergy;
use super::{Allowed, Derived, Images, Motion};
use crate::algebra::{Graph, Range, Residue, eliminated};
use crate::id::{ExprId, Id, SymbolId};
use crate::mechanics::{Definition, LagrangianSystem, Procedure};
use rustc_hash::FxHashMap;

/// Pairs of points between which zeros are looked for, and places between each.
const PAIRS: u64 = 12;
const PLACES: u32 = 16;
/// Entries of mass matrices that are computed in search of a point where the kinetic energy is definite: where an inertia
/// is a matrix of parameters, few points have it so, and those matrices are small.
const ENTRIES: usize = 4000;
/// Steps by which a zero is found to the last digits.
const STEPS: u32 = 48;
/// What is so small beside the values at the ends is a zero.
const SMALL: f64 = 1e-11;
/// What is so near to the end of a range may be there, since double zeros are found to half of the digits.
const NEAR: f64 = 1e-5;
/// What is so large has no value for the purpose.
const LARGE: f64 = 1e9;

/// Values of the symbols.
type Values = FxHashMap<SymbolId, f64>;

/// Real points for a claim.
pub(super) struct RealPoints<'q> {
    graph: &'q Graph,
    procedures: Vec<&'q Procedure>,
    motion: &'q Procedure,
    images: Images<'q>,
    allowed: &'q Allowed<'q>,
    /// What may not vanish where the declaration has a value.
    declared: Vec<ExprId>,
    energy: KineticEnergy<'q>,
    symbols: Vec<SymbolId>,
    /// Whether the kinetic energy is definite at some of the random points.
    is_definite: bool,
}

impl<'q> RealPoints<'q> {
    pub(super) fn of(
        graph: &'q Graph,
        claim: &'q Derived,
        (declared, motion, images): (&[ExprId], Motion<'q>, Images<'q>),
        system: &'q LagrangianSystem,
        allowed: &'q Allowed,
    ) -> Self {
        let procedures = claim.procedures();
        let all = || procedures.iter().copied().chain([motion.derivative]);
        let roots: Vec<ExprId> = all().flat_map(Procedure::expressions).collect();
        let named: Vec<SymbolId> = all().flat_map(defined).collect();
        let images_of: Vec<ExprId> = images.iter().map(|(_, image)| *image).collect();
        let further: Vec<ExprId> = allowed.facts.expressions.keys().copied().collect();
        let mut symbols = graph.symbols_in(&[declared, &roots, &images_of, &further].concat());
        symbols.retain(|symbol| !named.contains(symbol));
        let declared = graph.divisors(declared).into_iter().collect();
        let (motion, is_definite, energy) = (motion.derivative, false, KineticEnergy::of(graph, system));
        let mut points =
            Self { graph, procedures, motion, images, allowed, declared, energy, symbols, is_definite };
        let size = system.algebroid.velocities.len().max(1);
        let tries = PAIRS.max((ENTRIES / (size * size)) as u64);
        points.is_definite = (0..tries).any(|seed| points.energy_is_definite(&points.between(seed, 0.0)));
        points
    }

    /// Whether a divisor has a zero where all else has a value.
    pub(super) fn has_zero(&self, (number, divisor): (usize, Divisor)) -> bool {
        let divisor = self.made_of(number, divisor);
        let at_zero = |seed: u64, parameter: &SymbolId| {
            let mut values = self.between(seed, 0.0);
            let before = self.determinant(&divisor, values.clone());
            values.insert(*parameter, 0.0);
            let values = self.on_images(values);
            let after = self.determinant(&divisor, values.clone());
            after.abs() <= SMALL * before.abs() && self.all_else_has_values(values)
        };
        let mut may_vanish = self.allowed.may_vanish.iter();
        if may_vanish.any(|parameter| (0..PAIRS).any(|seed| at_zero(seed, parameter))) {
            return true;
        }
        (0..PAIRS).any(|seed| {
            let value = |t: f64| self.determinant(&divisor, self.between(seed, t));
            let is_here = |t: f64| self.all_else_has_values(self.between(seed, t));
            zeros(value).into_iter().any(is_here)
        })
    }

    /// A point between two random ones.
    fn between(&self, seed: u64, t: f64) -> Values {
        let value = |symbol: &SymbolId| {
            let ends = [0, 1].map(|end| self.sample(2 * seed + end, *symbol));
            (*symbol, ends[0] + t * (ends[1] - ends[0]))
        };
        self.on_images(self.symbols.iter().map(value).collect())
    }

    fn on_images(&self, mut values: Values) -> Values {
        for (symbol, image) in self.images {
            let value = self.value(*image, &values);
            values.insert(*symbol, value);
        }
        values
    }

    /// Parameters between 1/16 and 8 beyond the bound that is known of them, all else between −3 and 3.
    fn sample(&self, seed: u64, symbol: SymbolId) -> f64 {
        let unit = unit(seed, symbol);
        if !self.allowed.parameters.contains(&symbol) {
            return unit * 6.0 - 3.0;
        }
        let size = 2f64.powf(unit * 7.0 - 4.0);
        let range = self.allowed.facts.symbols.get(&symbol).copied().unwrap_or(Range::ALL);
        match (range.low.is_finite(), range.high.is_finite()) {
            (false, false) => size,
            (true, false) => range.low + size,
            (false, true) => range.high - size,
            (true, true) => range.low + (range.high - range.low) * unit,
        }
    }

    fn value(&self, expression: ExprId, values: &Values) -> f64 {
        self.graph.evaluate(&[expression], |symbol| values.get(&symbol).copied().unwrap_or(0.0))[0].value
    }

    /// What a divisor of a procedure is made of: with the definitions that it depends on, a matrix of which it is the
    /// determinant.
    fn made_of(&self, number: usize, divisor: Divisor) -> (Procedure, Vec<Vec<ExprId>>) {
        let procedure = self.procedures[number];
        let matrix = match divisor {
            Divisor::Expression(divisor) => vec![vec![divisor]],
            Divisor::Determinant(place) => match &procedure.definitions[place] {
                Definition::Solve { matrix, .. } => matrix.clone(),
                _ => Vec::new(),
            },
        };
        (procedure.as_far_as(self.graph, &matrix.concat()), matrix)
    }

    fn determinant(&self, (before, matrix): &(Procedure, Vec<Vec<ExprId>>), mut values: Values) -> f64 {
        before.definitions.iter().for_each(|definition| self.define(definition, &mut values));
        eliminated(self.rows(matrix, &values)).0
    }

    fn rows(&self, matrix: &[Vec<ExprId>], values: &Values) -> Vec<Vec<f64>> {
        matrix.iter().map(|row| row.iter().map(|entry| self.value(*entry, values)).collect()).collect()
    }

    fn define(&self, definition: &Definition, values: &mut Values) {
        match definition {
            Definition::Value { symbol, value } => {
                let value = self.value(*value, values);
                values.insert(*symbol, value);
            }
            // some function of this value
            Definition::Call { symbol, .. } => _ = values.insert(*symbol, unit(104, *symbol)),
            Definition::Solve { unknowns, matrix, right } => {
                let mut rows = self.rows(matrix, values);
                for (row, right) in rows.iter_mut().zip(right) {
                    row.push(self.value(*right, values));
                }
                let (_, solution) = eliminated(rows);
                values.extend(unknowns.iter().copied().zip(solution));
            }
        }
    }

    /// Whether the facts hold, the motion has values, and the energy is definite if it is so anywhere.
    fn all_else_has_values(&self, mut values: Values) -> bool {
        let Self { graph, motion, allowed, declared, .. } = self;
        let lies_in = |range: &Range, value: f64| {
            range.low <= value && value <= range.high && (!range.nonzero || value.abs() > NEAR)
        };
        let facts = allowed.facts;
        let facts_hold = facts
            .symbols
            .iter()
            .all(|(symbol, range)| values.get(symbol).is_none_or(|value| lies_in(range, *value)))
            && facts
                .expressions
                .iter()
                .all(|(expression, range)| lies_in(range, self.value(*expression, &values)));
        let is_finite = |value: f64| value.is_finite() && value.abs() < LARGE;
        let is_nonzero = |value: f64| is_finite(value) && value.abs() > 1.0 / LARGE;
        if !facts_hold || (self.is_definite && !self.energy_is_definite(&values)) {
            return false;
        }
        if !allowed.conditions.iter().chain(declared).all(|divisor| is_nonzero(self.value(*divisor, &values)))
        {
            return false;
        }
        motion.definitions.iter().for_each(|definition| self.define(definition, &mut values));
        graph.divisors(&motion.expressions()).iter().all(|divisor| is_nonzero(self.value(*divisor, &values)))
            && motion.outputs.iter().all(|output| is_finite(self.value(*output, &values)))
    }

    fn energy_is_definite(&self, values: &Values) -> bool {
        self.energy.is_definite(|symbol| values.get(&symbol).copied().unwrap_or(0.0))
    }
}

/// Where a function of [0, 1] vanishes.
fn zeros(value: impl Fn(f64) -> f64) -> Vec<f64> {
    let places: Vec<(f64, f64)> = (0..=PLACES)
        .map(|place| {
            let t = f64::from(place) / f64::from(PLACES);
            (t, value(t))
        })
        .filter(|(_, value)| value.is_finite())
        .collect();
    let size = places.iter().map(|(_, value)| value.abs()).fold(0.0, f64::max);
    let mut found = Vec::new();
    let mut keep = |t: f64| {
        let left = value(t);
        if left.is_finite() && left.abs() <= SMALL * size {
            found.push(t);
        }
    };
    for pair in places.windows(2) {
        let ((mut a, of_a), (mut b, of_b)) = (pair[0], pair[1]);
        if (of_a < 0.0) == (of_b < 0.0) {
            continue;
        }
        for _ in 0..STEPS {
            let middle = f64::midpoint(a, b);
            if (value(middle) < 0.0) == (of_a < 0.0) { a = middle } else { b = middle }
        }
        keep(a);
    }
    for triple in places.windows(3) {
        let [(mut a, of_a), (_, of_m), (mut b, of_b)] = [triple[0], triple[1], triple[2]];
        // a double zero between places leaves a ninth of the larger neighbour, or less
        if of_m.abs() > of_a.abs().min(of_b.abs()) || of_m.abs() > of_a.abs().max(of_b.abs()) * 0.3 {
            continue;
        }
        for _ in 0..STEPS {
            let third = (b - a) / 3.0;
            if value(a + third).abs() < value(b - third).abs() { b -= third } else { a += third }
        }
        keep(f64::midpoint(a, b));
    }
    found
}

/// A number in [0, 1) that the seed and the symbol determine.
#[allow(clippy::cast_precision_loss, reason = "a sample needs no more digits")]
fn unit(seed: u64, symbol: SymbolId) -> f64 {
    let word = Residue::mixed(31_337 + seed, symbol.index() as u64).word();
    (word % (1 << 20)) as f64 / (1u64 << 20) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zeros_are_met_where_the_sign_changes_and_where_it_does_not() {
        let near =
            |found: Vec<f64>, zero: f64| !found.is_empty() && found.iter().all(|t| (t - zero).abs() < 1e-5);
        assert!(near(zeros(|t| t - 0.3), 0.3));
        assert!(near(zeros(|t| (t - 0.31).powi(2)), 0.31));
        assert_eq!(zeros(|t| (t - 0.31).powi(2) + 1e-6), Vec::<f64>::new());
        assert_eq!(zeros(|t| 1.0 / (t - 0.3)), Vec::<f64>::new());
    }
}

//! Whether rewriting an expression costs digits.

use super::field::Residue;
use super::graph::Graph;
use super::level::Accuracy;
use super::memory::Other;
use crate::count::Count;
use crate::id::{ExprId, Id, SymbolId};
use std::rc::Rc;

/// Points at which two forms are compared.
const POINTS: u64 = 24;
/// The same where symbols are far apart: few of these points tell.
const POINTS_APART: u64 = 48;
/// As many of them as a form is at its worst at.
const WORST: usize = 3;

/// Units in the last place that an expression may lose where symbols are far apart: more than operations add up to.
const LOST: f64 = 65536.0;
/// What is gained at least for a longer one.
const MUCH: f64 = 256.0;
/// As many operations longer it may be, or by a quarter.
const MORE: u64 = 8;
/// No form is looked for that would have to be shorter than two thirds of the expression: normal forms of pivots are
/// seldom a third shorter, and reading them is most of what a derivation takes.
const SHORTENED: [u64; 2] = [2, 3];

impl Graph {
    /// How many times larger the rounding error of `candidate` is than that of `reference`, an
    /// expression of the same value, at the worst of some points whose coordinates range over six
    /// decades with both signs.
    ///
    /// An error below a few units in the last place of the value counts as that.
    #[must_use]
    pub fn error_growth(&self, candidate: ExprId, reference: ExprId) -> f64 {
        let mut worst: f64 = 0.0;
        let points = (0..POINTS).map(|point| move |symbol| wide_sample(point, symbol));
        for values in self.evaluate_each(&[candidate, reference], points) {
            let floor = 8.0 * f64::EPSILON * values[1].value.abs();
            let growth = values[0].error / values[1].error.max(floor);
            if values[1].error.is_finite() && values[1].value != 0.0 {
                worst = if growth.is_nan() { f64::INFINITY } else { worst.max(growth) };
            }
        }
        worst
    }
    /// As [`Self::error_growth`], but by how often errors are large and how large they are then: each form
    /// at its own points, in the geometric mean over all of them, and over those where it is at its
    /// worst. Two forms whose values cancel at different points are as good as each other.
    #[must_use]
    #[allow(clippy::cast_precision_loss, reason = "there are few points")]
    pub fn error_growth_overall(&self, candidate: ExprId, reference: ExprId) -> f64 {
        let points = (0..POINTS).map(|point| move |symbol| wide_sample(point, symbol));
        let mut logarithms = [Vec::new(), Vec::new()];
        for values in self.evaluate_each(&[candidate, reference], points) {
            if values[1].error.is_finite() && values[1].value != 0.0 {
                for (logarithms, value) in logarithms.iter_mut().zip(&values) {
                    let error = if value.error.is_nan() { f64::INFINITY } else { value.error };
                    logarithms.push((error / values[1].value.abs()).max(8.0 * f64::EPSILON).ln());
                }
            }
        }
        for logarithms in &mut logarithms {
            logarithms.sort_unstable_by(|a, b| b.total_cmp(a));
        }
        let [candidate, reference] = logarithms;
        let mean_growth = |points: usize| {
            let differences = candidate.iter().zip(&reference).take(points).map(|(c, r)| c - r);
            (differences.sum::<f64>() / points.max(1) as f64).exp()
        };
        mean_growth(candidate.len()).max(mean_growth(candidate.len().min(WORST)))
    }

    /// How many times smaller the rounding error of `candidate` is than that of `reference`, an expression of the same
    /// value, where symbols are positive and up to eight decades apart: in the geometric mean over the places where
    /// most is gained.
    ///
    /// An error below a few units in the last place of the value counts as that. Infinite where the reference keeps no
    /// digit and the candidate does.
    #[must_use]
    pub fn gain_apart(&self, candidate: ExprId, reference: ExprId) -> f64 {
        self.gains_apart(&[candidate], reference)[0]
    }

    /// [`Self::gain_apart`] of several candidates, which are evaluated together.
    #[allow(clippy::cast_precision_loss, reason = "there are few points")]
    fn gains_apart(&self, candidates: &[ExprId], reference: ExprId) -> Vec<f64> {
        let points = (0..POINTS_APART).map(|point| move |symbol| sample_apart(point, symbol));
        let mut gains = vec![Vec::new(); candidates.len()];
        for values in self.evaluate_each(&[&[reference], candidates].concat(), points) {
            for (logarithms, value) in gains.iter_mut().zip(&values[1..]) {
                let floor = 8.0 * f64::EPSILON * value.value.abs();
                let gain = values[0].error.max(floor) / value.error.max(floor);
                if value.error.is_finite() && floor > 0.0 {
                    logarithms.push(if gain.is_nan() { f64::INFINITY } else { gain.ln() });
                }
            }
        }
        let worst = |mut logarithms: Vec<f64>| {
            logarithms.sort_unstable_by(|a, b| b.total_cmp(a));
            logarithms.truncate(WORST);
            (logarithms.iter().sum::<f64>() / logarithms.len().max(1) as f64).exp()
        };
        gains.into_iter().map(worst).collect()
    }

    /// The rounding error in units in the last place, in the geometric mean over the worst of the places where symbols
    /// are positive and up to eight decades apart.
    #[must_use]
    #[allow(clippy::cast_precision_loss, reason = "there are few points")]
    pub fn units_lost_apart(&self, expression: ExprId) -> f64 {
        let points = (0..POINTS_APART).map(|point| move |symbol| sample_apart(point, symbol));
        let roots = [expression];
        let units = self.evaluate_each(&roots, points).filter(|values| values[0].error > 0.0);
        let units = units.map(|values| (values[0].error / (f64::EPSILON * values[0].value.abs())).ln());
        let mut logarithms: Vec<f64> = units.filter(|units| !units.is_nan()).collect();
        logarithms.sort_unstable_by(|a, b| b.total_cmp(a));
        logarithms.truncate(WORST);
        (logarithms.iter().sum::<f64>() / logarithms.len().max(1) as f64).exp()
    }

    /// The expression so that no terms cancel identically, if it loses digits where symbols are far apart, most of them
    /// are saved by that, and the result is not much longer than `length` operations.
    #[must_use]
    pub fn without_cancellation(&mut self, expression: ExprId, length: Count) -> Option<ExprId> {
        // constants are as large as they are
        let is_open = self.accuracy() != Accuracy::Fast && self.constants().is_empty();
        let is_short = |dear: Count| dear <= length + MORE || dear * 4 <= length * 5;
        let [part, whole] = SHORTENED;
        let shortest = Count::new(self.operation_count(&[expression]).get() * part / whole);
        if !is_open || !is_short(shortest) || self.lost_apart(expression) < LOST {
            return None;
        }
        let others = self.others(expression);
        let short = || others.iter().filter(|other| is_short(other.length));
        let most = short().map(|other| other.gain).fold(MUCH, f64::max);
        let best = short().filter(|other| 16.0 * other.gain >= most && other.gain > MUCH);
        best.min_by_key(|other| other.length).map(|other| other.form)
    }

    /// [`Self::units_lost_apart`], remembered.
    fn lost_apart(&mut self, expression: ExprId) -> f64 {
        if let Some(lost) = self.cancelling.lost.get(&expression) {
            return *lost;
        }
        let lost = self.units_lost_apart(expression);
        self.cancelling.lost.insert(expression, lost);
        lost
    }

    /// The expression in other forms, remembered.
    fn others(&mut self, expression: ExprId) -> Rc<[Other]> {
        if let Some(known) = self.cancelling.others.get(&expression) {
            return Rc::clone(known);
        }
        // the same over one denominator: what cancels may stand on both sides of a fraction bar
        let divisors: Vec<ExprId> = self.divisors(&[expression]).into_iter().collect();
        let denominator =
            divisors.into_iter().fold(self.one(), |product, divisor| self.mul(product, divisor));
        let numerator = self.mul(expression, denominator);
        let mut forms = self.spelled_out(expression);
        for form in self.spelled_out(numerator) {
            forms.push(self.div(form, denominator));
        }
        let gains = self.gains_apart(&forms, expression);
        let with_length = |(form, gain)| Other { form, length: self.operation_count(&[form]), gain };
        let others: Rc<[Other]> = forms.into_iter().zip(gains).map(with_length).collect();
        self.cancelling.others.insert(expression, Rc::clone(&others));
        others
    }

    /// Whether values lose no more than the level of accuracy allows against others: overall where it allows
    /// something, since two ways of solving the same equations cancel at different places.
    #[must_use]
    pub fn is_as_accurate(&self, values: &[ExprId], reference: &[ExprId]) -> bool {
        let growth = match self.accuracy() {
            Accuracy::Fast => return true,
            Accuracy::Balanced => Self::error_growth_overall,
            Accuracy::Careful => Self::error_growth,
        };
        let allowed = self.accuracy().growth();
        values.iter().zip(reference).all(|(value, reference)| growth(self, *value, *reference) <= allowed)
    }
}

/// A number between 10⁻³ and 10³ in magnitude that the point and the symbol determine.
#[allow(clippy::cast_precision_loss, reason = "a sample needs no more digits")]
fn wide_sample(point: u64, symbol: SymbolId) -> f64 {
    let word = Residue::mixed(11_000 + point, symbol.index() as u64).word();
    let unit = (word >> 1 & 0xF_FFFF) as f64 / f64::from(1 << 20);
    let magnitude = 10f64.powf(6.0 * unit - 3.0);
    if word & 1 == 0 { magnitude } else { -magnitude }
}

/// A number between 10⁻⁴ and 10⁴ that the point and the symbol determine.
#[allow(clippy::cast_precision_loss, reason = "a sample needs no more digits")]
fn sample_apart(point: u64, symbol: SymbolId) -> f64 {
    let word = Residue::mixed(17_000 + point, symbol.index() as u64).word();
    let unit = (word & 0xF_FFFF) as f64 / f64::from(1 << 20);
    10f64.powf(8.0 * unit - 4.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::Rational;

    #[test]
    fn expanding_a_power_of_a_difference_costs_digits() {
        let mut g = Graph::new();
        let (x, y) = (g.new_symbol("x"), g.new_symbol("y"));
        let (x, y) = (g.symbol(x), g.symbol(y));
        let difference = g.sub(x, y);
        let power = g.pow(difference, Rational::from(4));
        let terms: Vec<(Rational, ExprId)> = [(0, 1), (1, -4), (2, 6), (3, -4), (4, 1)]
            .into_iter()
            .map(|(k, c)| {
                (Rational::from(c), g.product(&[(x, Rational::from(4 - k)), (y, Rational::from(k))]))
            })
            .collect();
        let expanded = g.linear_combination(&terms);
        assert!(g.error_growth(expanded, power) > 4.0 * g.error_growth(power, expanded));
        assert!(g.error_growth(power, power) <= 1.0);
    }

    #[test]
    fn what_elimination_leaves_keeps_its_digits_without_terms_that_cancel() {
        // the pivot of a pendulum on a cart: J + m l² − (m l)² / (M + m)
        let mut g = Graph::new();
        let [j, m, l, cart] = ["J", "m", "l", "M"].map(|name| {
            let symbol = g.new_symbol(name);
            g.symbol(symbol)
        });
        let lever = g.mul(m, l);
        let (turned, squared) = (g.mul(lever, l), g.square(lever));
        let mass = g.add(cart, m);
        let carried = g.div(squared, mass);
        let sum = g.add(j, turned);
        let pivot = g.sub(sum, carried);
        assert!(g.units_lost_apart(pivot) > 65536.0, "{}", g.units_lost_apart(pivot));
        let length = g.operation_count(&[pivot]);
        let short = g.without_cancellation(pivot, length).expect("a form that keeps its digits");
        assert!(g.units_lost_apart(short) < 100.0, "{}", g.text(short));
        let difference = g.sub(short, pivot);
        assert!(g.zero_test(difference).is_zero());
        // what keeps its digits is left alone, and so is everything where accuracy may go
        assert_eq!(g.without_cancellation(short, length), None);
        g.set_accuracy(Accuracy::Fast);
        assert_eq!(g.without_cancellation(pivot, length), None);
    }
}

//! Whether rewriting an expression costs digits.

use super::field::Residue;
use super::graph::Graph;
use crate::id::{ExprId, Id, SymbolId};

/// What emitted code is made for, where speed and accuracy are at odds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Accuracy {
    /// Whatever is fastest.
    Fast,
    /// What is faster, unless it loses more than a factor of four.
    #[default]
    Balanced,
    /// What is more accurate, at some cost.
    Careful,
}

impl Accuracy {
    /// How many times larger the rounding error of an expression may become for fewer operations.
    #[must_use]
    pub fn growth(self) -> f64 {
        match self {
            Self::Fast => f64::INFINITY,
            Self::Balanced => 4.0,
            Self::Careful => 1.0,
        }
    }
}

/// Points at which two forms are compared.
const POINTS: u64 = 24;
/// As many of them as a form is at its worst at.
const WORST: usize = 3;

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
}

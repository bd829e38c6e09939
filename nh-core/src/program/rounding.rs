//! How much rounding error programs of the same value accumulate.

use super::interpret::{Arithmetic, interpret_in};
use super::step::Program;
use crate::algebra::{Bounded, Function, Function2, Rational, Residue};
use crate::id::{Id, SymbolId};

/// Points at which programs are compared.
const POINTS: u32 = 16;

/// How many times larger the rounding error of each program is than that of the best of them: the
/// geometric mean over some points, for the worst of the outputs.
///
/// An error below a few units in the last place of the value counts as that. The mean, since at a point
/// where a value happens to be small the bounds of any two programs are far apart.
#[must_use]
pub fn error_growth(programs: &[Program]) -> Vec<f64> {
    let outputs = programs.iter().map(|program| program.outputs.len()).min().unwrap_or(0);
    let mut logarithms = vec![vec![0.0; outputs]; programs.len()];
    for point in 0..POINTS {
        let values: Vec<Vec<Bounded>> = programs
            .iter()
            .map(|program| {
                interpret_in(program, |symbol| Bounded { value: sample(point, symbol), error: 0.0 })
            })
            .collect();
        for output in 0..outputs {
            let errors = values.iter().map(|values| values[output].error);
            let least = errors.filter(|error| error.is_finite()).fold(f64::INFINITY, f64::min);
            let floor = 8.0 * f64::EPSILON * values[0][output].value.abs();
            if !least.is_finite() || !floor.is_normal() {
                continue;
            }
            for (sums, values) in logarithms.iter_mut().zip(&values) {
                let growth = values[output].error / least.max(floor);
                sums[output] += if growth.is_nan() { f64::INFINITY } else { growth.max(1.0).ln() };
            }
        }
    }
    let mean = |sum: f64| (sum / f64::from(POINTS)).exp();
    logarithms.into_iter().map(|sums| sums.into_iter().map(mean).fold(1.0, f64::max)).collect()
}

/// A number between 1/8 and 8 that the point and the symbol determine: masses and lengths are positive,
/// and signs of states are as good as any.
#[allow(clippy::cast_precision_loss, reason = "a sample needs no more digits")]
fn sample(point: u32, symbol: SymbolId) -> f64 {
    let word = Residue::mixed(23_000 + u64::from(point), symbol.index() as u64).word();
    let unit = (word & 0xF_FFFF) as f64 / f64::from(1 << 20);
    2f64.powf(6.0 * unit - 3.0)
}

impl Arithmetic for Bounded {
    fn number(value: &Rational) -> Self {
        Self::of_number(value)
    }
    fn pi() -> Self {
        Self::rounded(std::f64::consts::PI, 0.0)
    }
    fn add(&self, other: &Self) -> Self {
        Self::rounded(self.value + other.value, self.error + other.error)
    }
    fn sub(&self, other: &Self) -> Self {
        Self::rounded(self.value - other.value, self.error + other.error)
    }
    fn mul(&self, other: &Self) -> Self {
        let error = self.error * other.value.abs() + other.error * self.value.abs();
        Self::rounded(self.value * other.value, error)
    }
    fn div(&self, other: &Self) -> Self {
        let value = self.value / other.value;
        Self::rounded(value, (self.error + value.abs() * other.error) / other.value.abs())
    }
    fn sqrt(&self) -> Self {
        let value = self.value.sqrt();
        Self::rounded(value, 0.5 * self.error / value)
    }
    fn cbrt(&self) -> Self {
        let value = self.value.cbrt();
        Self::rounded(value, self.error / (3.0 * value * value))
    }
    fn pow(&self, exponent: &Rational) -> Self {
        let exponent = exponent.to_f64();
        let value = self.value.powf(exponent);
        Self::rounded(value, (exponent * value / self.value).abs() * self.error)
    }
    fn apply(&self, function: Function) -> Self {
        Self::of_function(function, *self)
    }
    fn apply2(&self, function: Function2, other: &Self) -> Self {
        Self::of_function2(function, *self, *other)
    }
    fn magnitude(&self) -> f64 {
        self.value.abs()
    }
}

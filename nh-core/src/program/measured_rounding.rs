//! How much rounding error programs of the same value are seen to make.

use super::interpret::{Arithmetic, interpret_in};
use super::rounding::{FEW, OnBase, POINTS_APART, logarithm, turning, worst};
use super::step::Program;
use crate::algebra::{Bounded, Function, Function2, Graph, Rational};

/// Points at which programs are run: more than bounds are compared at, since an error that is seen may be small by chance.
const POINTS: u32 = 64;

/// How many times larger the rounding error of each program is than that of `best`, as far as runs in single precision
/// show: the geometric mean over some points, for the worst of the outputs.
///
/// A bound on an error grows with the length of a chain of operations also where the error does not, since it knows of
/// no signs; what is long may have small errors all the same.
#[must_use]
pub fn error_growth_in_runs(graph: &Graph, programs: &[&Program], best: &Program) -> Vec<f64> {
    let mut logarithms = vec![vec![0.0; best.outputs.len()]; programs.len()];
    for point in 0..POINTS {
        // parameters and states that single precision has
        let on_base = OnBase::at(graph, point);
        let at = |symbol| Single::near(on_base.sample(symbol));
        let exact: Vec<f64> = interpret_in(best, |symbol| f64::from(at(symbol).0));
        let errors = |program: &Program| -> Vec<f64> {
            let values: Vec<Single> = interpret_in(program, at);
            values.iter().zip(&exact).map(|(value, exact)| (f64::from(value.0) - exact).abs()).collect()
        };
        let least = errors(best);
        for (sums, program) in logarithms.iter_mut().zip(programs) {
            let errors = errors(program);
            for (((sum, error), least), exact) in sums.iter_mut().zip(errors).zip(&least).zip(&exact) {
                let floor = FEW * f64::from(f32::EPSILON) * exact.abs();
                if floor.is_normal() && least.is_finite() {
                    *sum += logarithm(error / least.max(floor));
                }
            }
        }
    }
    let mean = |sum: f64| (sum / f64::from(POINTS)).exp();
    logarithms.into_iter().map(|sums| sums.into_iter().map(mean).fold(1.0, f64::max)).collect()
}

/// The same where symbols lie up to eight decades apart, where single precision has no numbers: in double precision, beside
/// the results of `best` with the bounds on their errors, as [`super::error_growth_apart`] judges them.
#[must_use]
pub fn error_growth_apart_in_runs(graph: &Graph, programs: &[&Program], best: &Program) -> Vec<f64> {
    let all: Vec<&Program> = programs.iter().copied().chain([best]).collect();
    let turning = turning(&all);
    let mut logarithms = vec![vec![Vec::new(); best.outputs.len()]; programs.len()];
    for point in 0..POINTS_APART {
        let on_base = OnBase::at(graph, point);
        let at = |symbol| on_base.sample_apart(symbol, &turning);
        let known: Vec<Bounded> = interpret_in(best, |symbol| Bounded { value: at(symbol), error: 0.0 });
        for (logarithms, program) in logarithms.iter_mut().zip(programs) {
            let values: Vec<f64> = interpret_in(program, at);
            for ((logarithms, value), known) in logarithms.iter_mut().zip(values).zip(&known) {
                let floor = known.error.max(FEW * f64::EPSILON * known.value.abs());
                if floor.is_normal() {
                    logarithms.push(logarithm((value - known.value).abs() / floor));
                }
            }
        }
    }
    logarithms.into_iter().map(|outputs| outputs.into_iter().map(worst).fold(1.0, f64::max)).collect()
}

/// A number of single precision.
#[derive(Clone, Copy, Debug)]
struct Single(f32);

impl Single {
    #[allow(clippy::cast_possible_truncation, reason = "rounding is what is looked for")]
    fn near(value: f64) -> Self {
        Self(value as f32)
    }
}

impl Arithmetic for Single {
    fn number(value: &Rational) -> Self {
        Self::near(value.to_f64())
    }
    fn pi() -> Self {
        Self(std::f32::consts::PI)
    }
    fn add(&self, other: &Self) -> Self {
        Self(self.0 + other.0)
    }
    fn sub(&self, other: &Self) -> Self {
        Self(self.0 - other.0)
    }
    fn mul(&self, other: &Self) -> Self {
        Self(self.0 * other.0)
    }
    fn rest(&self, other: &Self, summand: &Self) -> Self {
        Self(f32::mul_add(self.0, other.0, summand.0))
    }
    fn div(&self, other: &Self) -> Self {
        Self(self.0 / other.0)
    }
    fn sqrt(&self) -> Self {
        Self(self.0.sqrt())
    }
    fn cbrt(&self) -> Self {
        Self(self.0.cbrt())
    }
    fn pow(&self, exponent: &Rational) -> Self {
        Self::near(Arithmetic::pow(&f64::from(self.0), exponent))
    }
    fn apply(&self, function: Function) -> Self {
        Self::near(Arithmetic::apply(&f64::from(self.0), function))
    }
    fn apply2(&self, function: Function2, other: &Self) -> Self {
        Self::near(Arithmetic::apply2(&f64::from(self.0), function, &f64::from(other.0)))
    }
    fn magnitude(&self) -> f64 {
        f64::from(self.0.abs())
    }
}

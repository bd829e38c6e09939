//! Errors in units in the last place.

use std::hint::black_box;

use nh_counted::callgrind::Counts;
use nonholonomic::Scalar;

use crate::DoubleDouble;
use crate::places::{Numbers, Place, Random, Regime};
use crate::regular::{self, Regular};

/// Places at which a system is evaluated in each regime.
pub const PLACES: usize = 400;

/// The levels, as they are written.
pub const LEVELS: [&str; 3] = ["fast", "balanced", "careful"];

/// The derivative of a system emitted at one level.
pub trait Level {
    /// In any numbers.
    fn derivative<T: Scalar>(parameters: &[T], state: &[T], input: &[T]) -> Vec<T>;
    /// All velocities.
    fn velocity<T: Scalar>(parameters: &[T], state: &[T]) -> Vec<T>;
    /// In `f64`, never inlined, so that its instructions can be counted.
    fn evaluated(place: &Place);
    /// The name of that function in a profile.
    fn symbol() -> &'static str;
}

/// The same system with all velocities in its state, and multipliers.
pub trait Twin {
    /// In any numbers.
    fn derivative<T: Scalar>(parameters: &[T], state: &[T], input: &[T]) -> Vec<T>;
    /// What the constraints demand to be zero.
    fn residual<T: Scalar>(parameters: &[T], state: &[T]) -> Vec<T>;
}

/// A system emitted at every level.
pub trait Measured {
    /// The name in the table.
    const NAME: &'static str;
    /// Its numbers.
    const NUMBERS: Numbers;
    /// `accuracy { fast }`
    type Fast: Level;
    /// `accuracy { balanced }`
    type Balanced: Level;
    /// `accuracy { careful }`
    type Careful: Level;
    /// `formulation { projected }`
    type Twin: Twin;
}

/// A system of the table, whatever its type.
pub trait Study {
    /// The name.
    fn name(&self) -> &'static str;
    /// The errors of each level in a regime.
    fn errors(&self, regime: Regime) -> Errors;
    /// Evaluates a level at ordinary places.
    fn evaluate(&self, level: usize);
    /// Evaluates at regular states that look singular.
    fn regular_states(&self) -> Regular;
    /// The instructions that a profile of one level has. The function may bear the name of another level,
    /// if the code is the same.
    fn instructions(&self, counts: &Counts) -> Option<f64>;
}

/// How many units in the last place the worst component of the derivative is off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// At the median place.
    pub median: f64,
    /// At the worst place.
    pub worst: f64,
}

/// The errors in a regime.
#[derive(Clone, Debug)]
pub struct Errors {
    /// Of each level.
    pub levels: [Spread; 3],
    /// What half a unit in the last place of each input makes of the derivative: no method that rounds
    /// as little as the sine of an angle can be expected to do better.
    pub conditioning: Spread,
    /// The largest error of a level in units of one and what the inputs explain, at the same place.
    pub unexplained: [f64; 3],
}

impl<S: Measured> Study for std::marker::PhantomData<S> {
    fn name(&self) -> &'static str {
        S::NAME
    }

    fn errors(&self, regime: Regime) -> Errors {
        let mut random = Random(0x2545_f491_4f6c_dd1d);
        let mut found: [Vec<f64>; 4] = Default::default();
        let mut unexplained = [0.0_f64; 3];
        for _ in 0..PLACES {
            let place = S::NUMBERS.draw(regime, &mut random);
            let exact = precise::<S::Careful>(&place);
            let levels = [
                computed::<S::Fast>(&place),
                computed::<S::Balanced>(&place),
                computed::<S::Careful>(&place),
            ];
            let units = units(&exact);
            let explained = explained::<S::Careful>(&place, &exact, &units);
            for ((found, unexplained), level) in found.iter_mut().zip(&mut unexplained).zip(&levels) {
                let errors: Vec<f64> = level
                    .iter()
                    .zip(&exact)
                    .zip(&units)
                    .map(|((x, exact), unit)| ulps(*x, *exact, *unit))
                    .collect();
                found.push(largest(&errors));
                for (error, explained) in errors.iter().zip(&explained) {
                    *unexplained = larger(*unexplained, error / (1.0 + explained));
                }
            }
            found[3].push(largest(&explained));
        }
        let [fast, balanced, careful, inputs] = found.map(spread);
        Errors { levels: [fast, balanced, careful], conditioning: inputs, unexplained }
    }

    fn evaluate(&self, level: usize) {
        let mut random = Random(0x9e37_79b9_7f4a_7c15);
        for _ in 0..16 {
            let place = S::NUMBERS.draw(Regime::Ordinary, &mut random);
            [S::Fast::evaluated, S::Balanced::evaluated, S::Careful::evaluated][level](black_box(&place));
        }
    }

    fn regular_states(&self) -> Regular {
        regular::study::<S>()
    }

    fn instructions(&self, counts: &Counts) -> Option<f64> {
        let symbols = [S::Fast::symbol(), S::Balanced::symbol(), S::Careful::symbol()];
        symbols.into_iter().find_map(|symbol| counts.get(symbol).copied())
    }
}

fn computed<L: Level>(place: &Place) -> Vec<f64> {
    L::derivative(&place.parameters, &place.state, &place.input)
}

fn precise<L: Level>(place: &Place) -> Vec<DoubleDouble> {
    let [parameters, state, input] = [&place.parameters, &place.state, &place.input]
        .map(|list| list.iter().map(|x| DoubleDouble::from_f64(*x)).collect::<Vec<_>>());
    L::derivative(&parameters, &state, &input)
}

/// The sum of what half a unit in the last place of each input changes, in units in the last place.
fn explained<L: Level>(place: &Place, exact: &[DoubleDouble], units: &[f64]) -> Vec<f64> {
    let mut sum = vec![0.0; exact.len()];
    let mut moved = place.clone();
    let lists: [fn(&mut Place) -> &mut Vec<f64>; 3] =
        [|place| &mut place.parameters, |place| &mut place.state, |place| &mut place.input];
    for list in lists {
        for index in 0..list(&mut moved).len() {
            let entry = list(&mut moved)[index];
            list(&mut moved)[index] = entry.next_up();
            let changed = precise::<L>(&moved);
            list(&mut moved)[index] = entry;
            for (((sum, changed), exact), unit) in sum.iter_mut().zip(changed).zip(exact).zip(units) {
                *sum += 0.5 * ((changed - *exact).high / unit).abs();
            }
        }
    }
    sum
}

/// One unit in the last place of each component. One that is zero to all digits of the reference, as is
/// the rate of a velocity that a constraint forbids, has the unit of the largest.
fn units(exact: &[DoubleDouble]) -> Vec<f64> {
    let largest = largest(&exact.iter().map(|x| x.high.abs()).collect::<Vec<_>>());
    let unit = |value: f64| {
        let value = value.max(f64::MIN_POSITIVE);
        value.next_up() - value
    };
    let size = |x: &DoubleDouble| if x.high.abs() < 1e-25 * largest { largest } else { x.high.abs() };
    exact.iter().map(|x| unit(size(x))).collect()
}

/// How many units in the last place a number is off.
fn ulps(found: f64, exact: DoubleDouble, unit: f64) -> f64 {
    ((DoubleDouble::from_f64(found) - exact).high / unit).abs()
}

/// The larger number; a NaN is larger than all.
pub(crate) fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

pub(crate) fn largest(values: &[f64]) -> f64 {
    values.iter().copied().fold(0.0, larger)
}

fn spread(mut values: Vec<f64>) -> Spread {
    values.sort_by(f64::total_cmp);
    Spread { median: values[values.len() / 2], worst: values[values.len() - 1] }
}

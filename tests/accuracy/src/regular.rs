//! Regular states that look singular: coordinates where sines, cosines or embedded coordinates vanish.
//!
//! A state is regular where the constraints are independent, whatever the equations are written in.
//! There the derivative is finite and as accurate as its inputs allow, in `f64` and in `f32`.

use nonholonomic::Scalar;

use crate::DoubleDouble;
use crate::measured::{Level, Measured, Twin, larger, largest};
use crate::places::{Place, Random, Regime};

/// How many places are tried.
pub const PLACES: usize = 400;
/// The squared volume that the normalised constraints span, from which on they are independent in `f64`,
/// and in `f32`.
const INDEPENDENT: [f64; 2] = [1e-24, 1e-10];

/// What was found.
#[derive(Clone, Copy, Debug, Default)]
pub struct Regular {
    /// How many places are regular.
    pub regular: usize,
    /// How many derivatives at these have a component that is not finite, in `f64`.
    pub infinite: usize,
    /// The same in `f32`, at ordinary parameters, where the constraints are independent in `f32`.
    pub infinite_in_f32: usize,
    /// The largest error in `f64` at ordinary parameters, in units of round-off of the inputs carried on
    /// to the derivative.
    pub growth: f64,
    /// The same in `f32`.
    pub growth_of_f32: f64,
    /// By how much, relatively, the system and its twin with multipliers differ in high precision.
    pub twins_differ: f64,
}

/// Evaluates a system at regular places.
#[must_use]
pub fn study<S: Measured>() -> Regular {
    let mut random = Random(0x0123_4567_89ab_cdef);
    let mut found = Regular::default();
    for index in 0..PLACES {
        let regime = if index % 4 == 3 { Regime::Masses } else { Regime::Ordinary };
        let place = S::NUMBERS.draw_corner(regime, &mut random);
        let independence = independence::<S>(&place);
        if independence.is_nan() || independence < INDEPENDENT[0] {
            continue;
        }
        found.regular += 1;
        let single = computed::<S::Balanced, f32>(&place);
        let double = computed::<S::Balanced, f64>(&place);
        let is_finite = |list: &[f64]| list.iter().all(|x| x.is_finite());
        found.infinite += usize::from(!is_finite(&double));
        if independence < INDEPENDENT[1] || regime != Regime::Ordinary {
            continue;
        }
        found.infinite_in_f32 += usize::from(!is_finite(&single));
        let exact = precise(&place, S::Careful::derivative::<DoubleDouble>);
        let carried = carried::<S::Careful>(&place, &exact);
        let growth = |computed: &[f64], epsilon: f64| {
            let error = |(x, exact): (&f64, &DoubleDouble)| (DoubleDouble::from_f64(*x) - *exact).high.abs();
            let errors = computed.iter().zip(&exact).map(|pair| error(pair) / (epsilon * carried));
            largest(&errors.collect::<Vec<_>>())
        };
        found.growth = larger(found.growth, growth(&double, f64::EPSILON));
        found.growth_of_f32 = larger(found.growth_of_f32, growth(&single, f32::EPSILON.into()));
        found.twins_differ = larger(found.twins_differ, twins_differ::<S>(&place, &exact));
    }
    found
}

/// The derivative in some numbers.
fn computed<L: Level, T: Scalar>(place: &Place) -> Vec<f64> {
    let [parameters, state, input] = [&place.parameters, &place.state, &place.input]
        .map(|list| list.iter().map(|x| T::from_f64(*x)).collect::<Vec<_>>());
    L::derivative(&parameters, &state, &input).into_iter().map(Scalar::to_f64).collect()
}

/// A function at a place in high precision.
fn precise(
    place: &Place,
    of: impl Fn(&[DoubleDouble], &[DoubleDouble], &[DoubleDouble]) -> Vec<DoubleDouble>,
) -> Vec<DoubleDouble> {
    let [parameters, state, input] = [&place.parameters, &place.state, &place.input]
        .map(|list| list.iter().map(|x| DoubleDouble::from_f64(*x)).collect::<Vec<_>>());
    of(&parameters, &state, &input)
}

/// The determinant of Φ Φᵀ with rows of length one, where φ = Φ y + φ₀.
fn independence<S: Measured>(place: &Place) -> f64 {
    let base = S::NUMBERS.velocities;
    let residual = |velocity: Option<usize>| {
        let mut moved = place.clone();
        let sections = S::Careful::velocity(&place.parameters, &place.state).len();
        moved.state.truncate(base);
        moved.state.extend((0..sections).map(|alpha| f64::from(u8::from(Some(alpha) == velocity))));
        S::Twin::residual(&moved.parameters, &moved.state)
    };
    let rest = residual(None);
    let sections = S::Careful::velocity(&place.parameters, &place.state).len();
    let mut rows: Vec<Vec<f64>> = vec![Vec::new(); rest.len()];
    for alpha in 0..sections {
        for ((row, value), rest) in rows.iter_mut().zip(residual(Some(alpha))).zip(&rest) {
            row.push(value - rest);
        }
    }
    // Gram and Schmidt: the product of what is left of each row
    let mut determinant = 1.0;
    for index in 0..rows.len() {
        let length = norm(&rows[index]);
        for before in 0..index {
            let other = rows[before].clone();
            let along: f64 = rows[index].iter().zip(&other).map(|(x, y)| x * y).sum();
            rows[index].iter_mut().zip(&other).for_each(|(x, y)| *x -= along * y);
        }
        let left = norm(&rows[index]);
        determinant *= (left / length).powi(2);
        rows[index].iter_mut().for_each(|x| *x /= left);
    }
    determinant
}

fn norm(row: &[f64]) -> f64 {
    row.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// What a relative change of one in each number would make of the derivative, linearly, and the
/// derivative itself: of its largest component, since forces cancel.
fn carried<L: Level>(place: &Place, exact: &[DoubleDouble]) -> f64 {
    const STEP: f64 = 4096.0 * f64::EPSILON;
    let mut sum: Vec<f64> = exact.iter().map(|x| x.high.abs()).collect();
    let numbers = [place.parameters.len(), place.state.len(), place.input.len()];
    for (list, length) in numbers.into_iter().enumerate() {
        for index in 0..length {
            let changed = precise(place, |parameters, state, input| {
                let mut lists = [parameters.to_vec(), state.to_vec(), input.to_vec()];
                let entry = lists[list][index];
                lists[list][index] = entry + entry * DoubleDouble::from_f64(STEP);
                L::derivative(&lists[0], &lists[1], &lists[2])
            });
            for ((sum, changed), exact) in sum.iter_mut().zip(changed).zip(exact) {
                *sum += ((changed - *exact).high / STEP).abs();
            }
        }
    }
    largest(&sum)
}

/// The rates of all velocities by the system, along its motion, against those of its twin.
fn twins_differ<S: Measured>(place: &Place, exact: &[DoubleDouble]) -> f64 {
    let base = S::NUMBERS.velocities;
    // 1. dy/dt by a central difference
    let step = DoubleDouble::from_f64(262_144.0 * f64::EPSILON);
    let moved = |sign: f64| {
        precise(place, |parameters, state, _| {
            let along = step * DoubleDouble::from_f64(sign);
            let state: Vec<DoubleDouble> =
                state.iter().zip(exact).map(|(x, rate)| *x + *rate * along).collect();
            S::Careful::velocity(parameters, &state)
        })
    };
    let twice = step * DoubleDouble::from_f64(2.0);
    let rates: Vec<DoubleDouble> =
        moved(1.0).into_iter().zip(moved(-1.0)).map(|(after, before)| (after - before) / twice).collect();
    // 2. the twin's
    let twin = precise(place, |parameters, state, input| {
        let mut all = state[..base].to_vec();
        all.extend(S::Careful::velocity(parameters, state));
        S::Twin::derivative(parameters, &all, input)
    });
    let size = largest(&twin.iter().map(|x| x.high.abs()).collect::<Vec<_>>());
    let differences = rates.iter().zip(&twin[base..]).map(|(x, twin)| (*x - *twin).high.abs() / size);
    largest(&differences.collect::<Vec<_>>())
}

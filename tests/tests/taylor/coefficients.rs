//! Coefficients against nested dual numbers.
//!
//! The solution at t + ε is x + ε f(t, x). Done n times, with n different ε, that is the solution at
//! t + ε₁ + … + ε_n, whose component at ε₁ … ε_n is its n-th derivative: to round-off, and without
//! any recurrence.

use nh_tests::dual::Dual;
use nonholonomic::Dim;
use nonholonomic::prelude::*;

use super::systems::{
    Everything, EverythingState, Indefinite, IndefiniteInput, IndefiniteState, Sleigh, SleighInput,
    SleighState, Veselova, VeselovaState,
};

/// A system over any numbers, with parameters and input.
trait Sample {
    type Of<T: Scalar>: TaylorSeries<State: State<Scalar = T>>;
    fn system<T: Scalar>() -> (Self::Of<T>, <Self::Of<T> as Dynamics>::Input);
}

/// The rate, and from it the solution a little later.
fn later<S: Sample, T: Scalar>(t: T, x: &[T]) -> (Dual<T>, Vec<Dual<T>>) {
    let (system, input) = S::system::<T>();
    let rate = system.derivative(t, &packed(x), &input).to_array();
    let ahead = x.iter().zip(rate.as_ref()).map(|(x, rate)| Dual { value: *x, slope: *rate });
    (Dual { value: t, slope: T::ONE }, ahead.collect())
}

fn packed<X: State>(numbers: &[X::Scalar]) -> X {
    let mut array = X::Dim::vec(X::Scalar::ZERO);
    array.as_mut().copy_from_slice(numbers);
    X::from_array(array)
}

/// The derivatives of orders 0 … 6.
fn derivatives<S: Sample>(t: f64, x: &[f64]) -> Vec<Vec<f64>> {
    let mut found = vec![x.to_vec()];
    macro_rules! deeper {
        ($t:ident, $x:ident;) => {};
        ($t:ident, $x:ident; [$($slope:ident)*] $($rest:tt)*) => {
            let ($t, $x) = later::<S, _>($t, &$x);
            found.push($x.iter().map(|x| x$(.$slope)*).collect());
            deeper!($t, $x; $($rest)*);
        };
    }
    let (t, x) = (t, x.to_vec());
    deeper!(t, x; [slope] [slope slope] [slope slope slope] [slope slope slope slope]
        [slope slope slope slope slope] [slope slope slope slope slope slope]);
    let _ = (t, x);
    found
}

fn agree<S: Sample>(t: f64, x: &[f64]) {
    let (system, input) = S::system::<f64>();
    let unit = 0.4;
    let zero = packed(&vec![0.0; x.len()]);
    let (mut series, mut workspace) = ([zero; 8], Default::default());
    for _twice in 0..2 {
        system.expand::<9>(t, &packed(x), &input, unit, &mut series[..7], &mut workspace);
    }
    let plain = system.taylor::<7>(t, &packed(x), &input);
    let mut factorial = 1.0;
    let mut power = 1.0;
    for (k, expected) in derivatives::<S>(t, x).iter().enumerate() {
        if k > 0 {
            factorial *= f64::from(u32::try_from(k).unwrap());
            power *= unit;
        }
        let size = expected.iter().fold(1.0_f64, |size, x| size.max(x.abs())) / factorial;
        let found = series[k].to_array();
        for (i, expected) in expected.iter().enumerate() {
            let expected = expected / factorial;
            let error = (found.as_ref()[i] - expected * power).abs() / (power * size);
            assert!(error < 1e-13, "order {k}, component {i}: {} for {expected}", found.as_ref()[i] / power);
            let error = (plain[k].to_array().as_ref()[i] - expected).abs() / size;
            assert!(error < 1e-13, "order {k}, component {i} in units of time");
        }
    }
    // beyond the order that was asked for
    assert!(series[7].to_array().as_ref().iter().all(|x| *x == 0.0));
}

struct Sleighs;
impl Sample for Sleighs {
    type Of<T: Scalar> = Sleigh<T>;
    fn system<T: Scalar>() -> (Sleigh<T>, SleighInput<T>) {
        let c = T::from_f64;
        (Sleigh { m: c(1.3), J: c(0.4), a: c(0.7), c: c(0.2) }, SleighInput { torque: c(-0.6) })
    }
}

struct All;
impl Sample for All {
    type Of<T: Scalar> = Everything<T>;
    fn system<T: Scalar>() -> (Everything<T>, ()) {
        (Everything { c: T::from_f64(0.8) }, ())
    }
}

struct Pivoted;
impl Sample for Pivoted {
    type Of<T: Scalar> = Indefinite<T>;
    fn system<T: Scalar>() -> (Indefinite<T>, IndefiniteInput<T>) {
        let c = T::from_f64;
        (Indefinite { a: c(1.7), b: c(0.3) }, IndefiniteInput { u: c(0.5) })
    }
}

struct Projected;
impl Sample for Projected {
    type Of<T: Scalar> = Veselova<T>;
    fn system<T: Scalar>() -> (Veselova<T>, ()) {
        let inertia = [[2.0, 0.1, 0.2], [0.1, 3.0, -0.3], [0.2, -0.3, 4.0]];
        let c = T::from_f64;
        (Veselova { I: inertia.map(|row| row.map(c)), c: [0.5, -0.2, 1.1].map(c) }, ())
    }
}

#[test]
fn a_driven_sleigh() {
    agree::<Sleighs>(0.0, &[0.4, 1.0, -2.0, 0.9, -0.5]);
    // at rest only the torque is left, and the slip, of which every derivative is 0
    agree::<Sleighs>(3.0, &[0.0; 5]);
}

/// Checks mathematics (24).
#[test]
fn every_function() {
    agree::<All>(0.3, &[0.5, -0.4, 0.7, 0.2, -0.3, 0.6]);
    agree::<All>(-1.1, &[-0.6, 0.9, 0.1, 0.0, 0.0, 0.0]);
}

#[test]
fn a_system_that_needs_pivots() {
    agree::<Pivoted>(0.0, &[0.2, -0.4, 0.7, 0.3, -0.1, 0.5, -0.3, 0.4, 0.8, -0.6]);
}

#[test]
fn the_projected_formulation() {
    agree::<Projected>(0.0, &[0.0, 0.6, 0.8, 0.3, -0.8, 0.6]);
}

#[test]
fn single_precision() {
    let (system, input) = Sleighs::system::<f32>();
    let state = SleighState { theta: 0.4, x: 1.0, y: -2.0, omega: 0.9, v1: -0.5 };
    let series = system.taylor::<3>(0.0, &state, &input);
    let rate = system.derivative(0.0, &state, &input);
    assert_eq!(series[0], state);
    assert!((series[1].omega - rate.omega).abs() < 1e-6 && (series[1].x - rate.x).abs() < 1e-6);
    let _: (EverythingState<f32>, IndefiniteState<f32>, VeselovaState<f32>) = Default::default();
}

//! What an expert's shorter equations give away: digits where a denominator nearly vanishes.
#![allow(non_snake_case, reason = "parameters are written as in mechanics")]

use nh_accuracy::DoubleDouble;
use nh_bench::contest::{Contest, Random};
use nh_bench::systems::car;
use nonholonomic::prelude::*;

nh_models::car! {
    /// The car of the benchmark in numbers of any kind.
    #[derive(Clone, Copy, Debug)]
    struct Car<T> { m: T, J: T, Js: T, a: T, L: T }
}

/// The median over states of the error of the accelerations, in units of the last place of the worse.
fn median_error(
    angle_left: f64,
    accelerations: impl Fn([f64; 6], [f64; 2]) -> [f64; 2],
    exact: impl Fn([f64; 6], [f64; 2]) -> [DoubleDouble; 2],
) -> f64 {
    let mut random = Random::new();
    let mut errors: Vec<f64> = (0..101)
        .map(|_| {
            let mut state: [f64; 6] = std::array::from_fn(|_| random.draw());
            state[3] = std::f64::consts::FRAC_PI_2 - angle_left;
            let input = std::array::from_fn(|_| random.draw());
            let pairs = accelerations(state, input).into_iter().zip(exact(state, input));
            let units = pairs.map(|(found, exact)| {
                ((DoubleDouble::from_f64(found) - exact) / exact).high.abs() / (f64::EPSILON / 2.0)
            });
            units.fold(0.0, |worst, units| if units > worst || units.is_nan() { units } else { worst })
        })
        .collect();
    errors.sort_by(f64::total_cmp);
    errors[50]
}

#[test]
fn a_car_whose_wheels_are_nearly_across() {
    let by_hand = car::Car::ordinary();
    let [m, J, Js, a, L]: [f64; 5] = by_hand.parameters().try_into().expect("five parameters");
    let emitted = Car { m, J, Js, a, L };
    let of = DoubleDouble::from_f64;
    let reference = Car { m: of(m), J: of(J), Js: of(Js), a: of(a), L: of(L) };
    let exact = |state: [f64; 6], input: [f64; 2]| {
        let rate = reference.derivative(of(0.0), &state.map(of).into(), &input.map(of).into());
        [rate.v, rate.turn]
    };
    for angle_left in [0.1, 1e-3, 1e-4] {
        let ours = |state: [f64; 6], input: [f64; 2]| {
            let rate = emitted.derivative(0.0, &state.into(), &input.into());
            [rate.v, rate.turn]
        };
        let hand = |state: [f64; 6], input: [f64; 2]| {
            let rate = by_hand.by_hand(0.0, &state.into(), &input.into());
            [rate.v, rate.turn]
        };
        let (ours, hand) = (median_error(angle_left, ours, exact), median_error(angle_left, hand, exact));
        println!("{angle_left:6} before a quarter turn: emitted {ours:.1} units, by hand {hand:.1}");
        assert!(ours < 4.0, "{ours} units at {angle_left}");
        // far from there both are right, so that they are the equations of one car
        assert!(angle_left < 0.01 || hand < 8.0, "{hand} units at {angle_left}");
        assert!(angle_left > 0.01 || hand > 1e3, "{hand} units at {angle_left}");
    }
}

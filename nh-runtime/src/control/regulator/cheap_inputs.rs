//! Regulators of inputs that cost next to nothing, or far more than what they save.

use nalgebra::{Matrix2, Matrix3, SMatrix, matrix, vector};

use super::super::draws::Draws;
use super::Regulator;

/// Inputs that cost next to nothing, or far more than what they save: the gain is that of many steps backwards from
/// the end of a horizon.
#[test]
fn cheap_and_dear_inputs() {
    let mut draws = Draws(7);
    let mut number = || draws.draw() * 2.0 - 1.0;
    let mut compared = 0;
    for case in 0..120 {
        let a = Matrix3::from_fn(|_, _| number());
        let b = SMatrix::<f64, 3, 2>::from_fn(|_, _| number());
        let c = SMatrix::<f64, 2, 3>::from_fn(|_, _| number());
        let d = Matrix2::from_fn(|_, _| number()) + Matrix2::identity() * 2.0;
        let q = c.transpose() * c;
        let r = d * d.transpose() * [1e-13, 1e-10, 1e-6, 1.0, 1e6, 1e10][case % 6];
        let found = Regulator::stationary(&a, &b, &q, &r).unwrap_or_else(|error| panic!("{case}: {error}"));
        let mut last = Regulator::before(&q, &a, &b, &q, &r).unwrap();
        let mut settled = false;
        for _ in 0..2000 {
            let next = Regulator::before(&last.cost, &a, &b, &q, &r).unwrap();
            settled = (next.gain - last.gain).norm() <= 1e-15 * next.gain.norm();
            last = next;
            if settled {
                break;
            }
        }
        if settled {
            compared += 1;
            let off = (found.gain - last.gain).norm();
            assert!(off < 1e-11 * last.gain.norm(), "{case}: {off:e} of {}", last.gain);
        }
    }
    assert!(compared > 80, "{compared}");
}

/// A mode that no input reaches, and that decays in ten thousand ticks, beside inputs that cost next to nothing: what
/// they reach is a billion times what they do not. In other coordinates both are mixed.
#[test]
fn what_no_input_reaches_may_decay_slowly_however_cheap_inputs_are() {
    let mut draws = Draws(3);
    let mut number = || draws.draw() * 2.0 - 1.0;
    for decay in [0.99, 0.9999, 0.999_999] {
        for case in 0..40 {
            let mixing = Matrix3::from_fn(|_, _| number()) + Matrix3::identity() * 3.0;
            let back = mixing.try_inverse().unwrap();
            let mut a = Matrix3::from_fn(|_, _| number());
            let mut b = SMatrix::<f64, 3, 2>::from_fn(|_, _| number());
            (a[(2, 0)], a[(2, 1)], a[(2, 2)], b[(2, 0)], b[(2, 1)]) = (0.0, 0.0, decay, 0.0, 0.0);
            let (a, b) = (mixing * a * back, mixing * b);
            let r = Matrix2::identity() * 1e-9;
            let found = Regulator::stationary(&a, &b, &Matrix3::identity(), &r);
            let found = found.unwrap_or_else(|error| panic!("{decay} {case}: {error}"));
            let cost = Regulator::before(&found.cost, &a, &b, &Matrix3::identity(), &r).unwrap().cost;
            assert!((cost - found.cost).norm() < 1e-9 * cost.norm(), "{decay} {case}: {cost}");
        }
    }
}

/// Inputs so cheap that 1 + reach · cost has no inverse in the digits of the numbers: the gain is that of many steps backwards
/// from the end of a horizon.
#[test]
fn inputs_that_cost_next_to_nothing_need_no_inverse() {
    let a = matrix![6e-2_f64, 8e4; 2e-6, 0.1];
    let b = vector![2.4e11, -4.9e6];
    let (q, r) = (matrix![2.2e-12, -1.2e-7; -1.2e-7, 6.55e-2], matrix![1.1e-13]);
    let found = Regulator::stationary(&a, &b, &q, &r).unwrap();
    let mut last = Regulator::before(&q, &a, &b, &q, &r).unwrap();
    for _ in 0..200 {
        last = Regulator::before(&last.cost, &a, &b, &q, &r).unwrap();
    }
    assert!((found.gain - last.gain).norm() < 1e-12 * last.gain.norm(), "{} for {}", found.gain, last.gain);
}

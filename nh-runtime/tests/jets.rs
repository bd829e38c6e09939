//! The derivatives of numbers that carry them, where a part of an expression has none, and at the ends of the range.

#![allow(clippy::float_cmp, clippy::float_cmp_const)] // exact values are meant

use nonholonomic::{Jet, Scalar};

type Two = Jet<f64, 2>;

/// `u g` with `u = 0` has the derivative `u' g` wherever `g` is continuous, which the functions of limits show: all are
/// odd or even in one variable, so that one secant through the origin says what the derivative is.
#[test]
fn a_product_with_zero_has_the_derivative_of_its_factor() {
    let constant = Two::constant;
    let [x, y] = Two::variables([0.0, 0.0]);
    let speed = (x * x + y * y).sqrt();
    assert!(speed.by.iter().all(|by| by.is_nan()), "a speed has none at rest: {speed:?}");
    for (name, found, expected) in [
        ("drag", x * speed, [0.0, 0.0]),
        ("drag from the right", speed * y, [0.0, 0.0]),
        ("drag with a summand", (-constant(3.0) * x).mul_add(speed, constant(2.0) * y), [0.0, 2.0]),
        ("smoothed friction", x / (constant(0.5) + speed), [2.0, 0.0]),
        ("a power of three halves", x * x.sqrt(), [0.0, 0.0]),
        ("its quotient", constant(0.0) / (constant(1.0) + y.sqrt()), [0.0, 0.0]),
        ("no part of it", constant(0.0) * x.sqrt(), [0.0, 0.0]),
        ("an arc", y * (constant(1.0) - x).acos(), [0.0, 0.0]),
        ("beside an offset", (x + x) * (constant(1.0) + y.cbrt()), [2.0, 0.0]),
    ] {
        assert!(found.by == expected, "{name}: {:?}, not {expected:?}", found.by);
    }
    // each of two roots has none at zero, though their product has
    assert!(!(x.sqrt() * x.sqrt()).is_finite() && !(speed * speed).is_finite());
    // beside what is not zero nothing is left out
    assert!(!(constant(1.0) * x.sqrt()).is_finite() && !((x + constant(1.0)) * speed).is_finite());
    // numbers that are none show
    let nan = constant(f64::NAN);
    assert!(!(nan * x.sqrt()).is_finite() && !(x * nan).is_finite() && !(x / nan).is_finite());
}

/// Second derivatives are those of the product, and infinite where that has none.
#[test]
fn second_derivatives_beside_zero_are_kept() {
    type Twice = Jet<Jet<f64, 1>, 1>;
    let at = |x: f64| {
        let [inner] = Jet::<f64, 1>::variables([x]);
        let [outer] = Twice::variables([inner]);
        outer
    };
    let (x, one) = (at(0.0), Twice::ONE);
    assert_eq!((x * (one + x)).by[0].by[0], 2.0);
    assert_eq!((x / (one + x)).by[0].by[0], -2.0);
    assert!(!(x * x.sqrt()).is_finite());
    for far in [0.0_f64, 0.9, 1.1, 30.0, 800.0] {
        let (tanh, fall) = (far.tanh(), 1.0 / far.cosh().powi(2));
        let found = at(far).tanh();
        let (first, second) = (found.by[0].value, found.by[0].by[0]);
        assert!((first - fall).abs() <= 1e-14 * fall, "{far}: {first:e} {fall:e}");
        assert!((second + 2.0 * tanh * fall).abs() <= 1e-14 * fall, "{far}: {second:e}");
    }
}

#[test]
fn the_direction_of_a_place_turns_in_any_unit() {
    for unit in [1e-200, 1e-30, 1.0, 1e30, 1e200] {
        for (y, x) in [(0.6, 0.8), (-0.8, 0.6), (0.6, -0.8), (1.0, 0.0), (0.0, -1.0), (-0.8, -0.6)] {
            let [jet_y, jet_x] = Two::variables([y * unit, x * unit]);
            let found = jet_y.atan2(jet_x).by;
            for (found, expected) in found.iter().zip([x, -y]) {
                assert!((found * unit - expected).abs() < 4e-16, "{unit:e} {y} {x}: {found:e}");
            }
        }
    }
    let [y, x] = Two::variables([0.0, 0.0]);
    assert!(!y.atan2(x).is_finite(), "at the origin there is none");
}

/// A friction that has risen to its end changes by what is left: sech², to all digits.
#[test]
fn what_has_nearly_saturated_still_changes() {
    for x in [-300.0_f64, -20.0, -9.5, -1.0, -0.3, 0.0, 0.7, 1.0, 1.5, 15.0, 40.0, 340.0] {
        let [jet] = Jet::<f64, 1>::variables([x]);
        let (found, expected) = (jet.tanh().by[0], 1.0 / x.cosh().powi(2));
        assert!((found - expected).abs() <= 4e-15 * expected, "{x}: {found:e} {expected:e}");
    }
}

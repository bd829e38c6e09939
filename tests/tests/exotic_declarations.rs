//! Exotic declarations that are right: they compile, and compute what they say.
#![allow(dead_code, reason = "that they compile is the test, and of most nothing else is asked")]
#![allow(mixed_script_confusables, reason = "Greek coordinates beside Latin ones")]

use nonholonomic::prelude::*;

#[nonholonomic(base { x } basis { v } anchor { der(x) = 0; } brackets { } lagrangian { m / 2 * v^2 })]
struct AnchorZero {
    m: f64,
}

#[nonholonomic(base { x, y, z } basis { v } anchor { der(x) = v; der(y) = 0; der(z) = y * v; } brackets { } lagrangian { v^2 / 2 })]
struct UnusedNames {
    m: f64,
}

#[nonholonomic(base { x, y, z } lagrangian { exp(der(x)) + der(y)^(3/2) - m * sqrt(1 - der(z)^2) })]
struct NotQuadratic {
    m: f64,
}

#[nonholonomic(base { x } basis { v, w } anchor { der(x) = v; } brackets { [v, w] = x * w; } lagrangian { (v^2 + w^2) / 2 })]
struct BracketOnTheBase;

#[nonholonomic(basis { a, b, c } brackets so(3) { a, b, c } lagrangian { a^2 + b^2 + c^2 } constraints { a = b * sin(t); })]
struct ConstraintWithoutCoordinates {}

macro_rules! oscillator {
    ($name:ident, $gain:literal, $potential:expr, $unit:ty, $q:ident) => {
        #[nonholonomic(base { $q } lagrangian { m / 2 * der($q)^2 - $gain * $potential } assume { m > 0; })]
        #[derive(Clone, Copy)]
        struct $name {
            m: $unit,
        }
    };
}
oscillator!(Oscillator, 0.5, q * q + 1, f64, q);

#[nonholonomic(base { θ, r#type } lagrangian { m / 2 * (der(θ)^2 + der(r#type)^2) - m * cos(θ) })]
struct NotOnlyAscii {
    m: f64,
}

#[nonholonomic(base { x } lagrangian { m / 2 * der(x)^2 })]
#[derive(Clone)]
#[cfg_attr(all(), derive(Debug))]
pub struct Generic<'a, T = f64>
where
    T: Copy,
{
    m: T,
    #[nh(skip)]
    name: &'a str,
}

#[test]
fn an_anchor_of_zero_leaves_everything_where_it_is() {
    let start = AnchorZeroState { x: 1.0, v: 2.0 };
    assert_eq!(AnchorZero { m: 1.0 }.derivative(0.0, &start, &()), AnchorZeroState::default());
}

#[test]
fn declarations_made_by_macros_compute_what_was_handed_to_them() {
    let rate = Oscillator { m: 2.0 }.derivative(0.0, &OscillatorState { q: 1.0, q_dot: 0.0 }, &());
    assert!((rate.q_dot + 0.5).abs() < f64::EPSILON, "{rate:?}");
}

use nonholonomic::prelude::*;

macro_rules! oscillator {
    ($name:ident, $gain:literal, $potential:expr, $unit:ty, $q:ident) => {
        #[nonholonomic(base { $q } lagrangian { m / 2 * der($q)^2 - $gain * $potential } assume { m > 0; })]
        #[derive(Clone, Copy)]
        struct $name { m: $unit }
    };
}
oscillator!(Oscillator, 0.5, q * q + 1, f64, q);

#[nonholonomic(base { θ, r#type } lagrangian { m / 2 * (der(θ)^2 + der(r#type)^2) - m * cos(θ) })]
struct NotOnlyAscii { m: f64 }

#[nonholonomic(base { x } lagrangian { m / 2 * der(x)^2 })]
#[derive(Clone)]
#[cfg_attr(all(), derive(Debug))]
pub struct Generic<'a, T = f64> where T: Copy { m: T, #[nh(skip)] name: &'a str }

fn main() {
    let rate = Oscillator { m: 2.0 }.derivative(0.0, &OscillatorState { q: 1.0, q_dot: 0.0 }, &());
    assert_eq!(rate.q_dot, -0.5);
}

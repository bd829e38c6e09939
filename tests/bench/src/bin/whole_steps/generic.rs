//! Systems over any number, with their derivatives by hand: for steps in single precision, in lanes and with the runtime's own
//! sine, and for steps with their derivatives, which an expert without a Jacobian takes in jets.

use std::hint::black_box;

use nh_bench::contest::{Random, SAMPLES};
use nh_bench::runner::agree;
use nonholonomic::prelude::*;
use nonholonomic::wide::{f32x8, f64x4};
use nonholonomic::{D, Fast, Jet};

use super::{H, STEPS, counted_steps};

/// The columns: explicit steps in several numbers, and `Rk4` with its derivatives.
pub(crate) const COLUMNS: [&str; NUMBERS + 1] = [
    "`Rk4`, `f32`",
    "`Dop853`, `f32`",
    "`Rk4`, `Fast<f64>`",
    "`Rk4`, `f64x4`",
    "`Rk4`, `f32x8`",
    "`Rk4`, `linearized_step`",
];
/// As many columns are without derivatives.
const NUMBERS: usize = 5;
/// The rows.
pub(crate) const NAMES: [&str; 3] = ["sleigh", "snakeboard", "veselova"];

/// A system with its derivative by hand, over any number.
struct ByHand<S>(S);

nh_models::sleigh! {
    #[derive(Clone, Copy, Debug)]
    struct Sleigh<T> { m: T, J: T, a: T, b: T, c: T }
    emit { jacobian }
}

impl<T: Scalar> Dynamics for ByHand<Sleigh<T>> {
    type State = SleighState<T>;
    type Input = SleighInput<T>;
    #[inline]
    fn derivative(&self, _t: T, x: &SleighState<T>, u: &SleighInput<T>) -> SleighState<T> {
        let Self(s) = self;
        let (sin, cos) = x.theta.sin_cos();
        let ma = s.m * s.a;
        let couple = ma.mul_add(s.b.mul_add(-x.omega, x.v1), s.c);
        let omega_dot = x.omega.mul_add(-couple, u.torque) / ma.mul_add(s.a, s.J);
        SleighState {
            theta: x.omega,
            x: x.v1 * cos,
            y: x.v1 * sin,
            omega: omega_dot,
            v1: s.b.mul_add(omega_dot, s.a * x.omega * x.omega),
        }
    }
}

nh_models::snakeboard! {
    #[derive(Clone, Copy, Debug)]
    struct Snakeboard<T> { m: T, l: T, J0: T, J1: T }
    independent { u1, dpsi, dphi }
    emit { jacobian }
}

impl<T: Scalar> Dynamics for ByHand<Snakeboard<T>> {
    type State = SnakeboardState<T>;
    type Input = SnakeboardInput<T>;
    #[inline]
    fn derivative(&self, _t: T, x: &SnakeboardState<T>, u: &SnakeboardInput<T>) -> SnakeboardState<T> {
        let Self(s) = self;
        let (sin_theta, cos_theta) = x.theta.sin_cos();
        let (sin_phi, cos_phi) = x.phi.sin_cos();
        let lc = s.l * cos_phi;
        let kappa = sin_phi / lc;
        let turn = x.dphi * x.u1 / (lc * cos_phi);
        let excess = (s.m * s.l).mul_add(s.l, -s.J0);
        let mass = (excess * kappa).mul_add(kappa, s.m);
        let u1_dot = excess.mul_add(-turn, u.rotor) * kappa / mass;
        let minus_theta_ddot = kappa.mul_add(u1_dot, turn);
        SnakeboardState {
            x: x.u1 * cos_theta,
            y: x.u1 * sin_theta,
            theta: -kappa * x.u1,
            psi: x.dpsi,
            phi: x.dphi,
            u1: u1_dot,
            dpsi: u.rotor / s.J0 + minus_theta_ddot,
            dphi: u.steering / (s.J1 + s.J1),
        }
    }
}

nh_models::veselova! {
    #[derive(Clone, Copy, Debug)]
    struct Veselova<T> { I: [T; 3], c: [T; 3] }
    emit { jacobian }
}

impl<T: Scalar> Dynamics for ByHand<Veselova<T>> {
    type State = VeselovaState<T>;
    type Input = ();
    #[inline]
    fn derivative(&self, _t: T, x: &VeselovaState<T>, (): &()) -> VeselovaState<T> {
        let ([g1, g2, g3], [w1, w2, w3]) = (x.g, x.w);
        let ([i1, i2, i3], [c1, c2, c3]) = (self.0.I, self.0.c);
        let k1 = ((i2 - i3) * w2).mul_add(w3, g2.mul_add(c3, -(g3 * c2)));
        let k2 = ((i3 - i1) * w3).mul_add(w1, g3.mul_add(c1, -(g1 * c3)));
        let k3 = ((i1 - i2) * w1).mul_add(w2, g1.mul_add(c2, -(g2 * c1)));
        let (a1, a2, a3) = (i2 * i3, i3 * i1, i1 * i2);
        let (b1, b2, b3) = (a1 * g1, a2 * g2, a3 * g3);
        let norm = b1.mul_add(g1, b2.mul_add(g2, b3 * g3));
        let power = b1.mul_add(k1, b2.mul_add(k2, b3 * k3));
        let reciprocal = (norm * (i1 * a1)).recip();
        let (scale, pull) = (norm * reciprocal, -power * reciprocal);
        VeselovaState {
            g: [g2.mul_add(w3, -(g3 * w2)), g3.mul_add(w1, -(g1 * w3)), g1.mul_add(w2, -(g2 * w1))],
            w: [
                (a1 * k1).mul_add(scale, b1 * pull),
                (a2 * k2).mul_add(scale, b2 * pull),
                (a3 * k3).mul_add(scale, b3 * pull),
            ],
        }
    }
}

fn sleigh<T: Scalar>() -> Sleigh<T> {
    let [m, J, a, b, c] = [1.3, 0.7, 0.4, 0.15, 0.2].map(T::from_f64);
    Sleigh { m, J, a, b, c }
}

fn snakeboard<T: Scalar>() -> Snakeboard<T> {
    let [m, l, J0, J1] = [1.4, 0.5, 0.09, 0.03].map(T::from_f64);
    Snakeboard { m, l, J0, J1 }
}

fn veselova<T: Scalar>() -> Veselova<T> {
    Veselova { I: [1.1, 1.7, 2.3].map(T::from_f64), c: [0.4, -0.3, 0.8].map(T::from_f64) }
}

/// Compares an emitted derivative with that by hand.
fn compare<S, H, const N: usize>(
    name: &str,
    (emitted, by_hand): (S, H),
    input: &S::Input,
) -> Result<(), String>
where
    S: Dynamics<State: State<Scalar = f64, Dim = D<N>>>,
    H: Dynamics<State = S::State, Input = S::Input>,
{
    let mut random = Random::new();
    for _ in 0..SAMPLES {
        let state = State::from_array(std::array::from_fn(|_| random.draw()));
        let [found, by_hand] =
            [emitted.derivative(0.0, &state, input), by_hand.derivative(0.0, &state, input)]
                .map(|x| x.to_array());
        agree(name, "emitted", &found, &by_hand)?;
    }
    Ok(())
}

/// Compares all.
///
/// # Errors
/// Where they differ.
pub(crate) fn compare_all() -> Result<(), String> {
    let [first, second, third] = NAMES;
    compare(first, (sleigh(), ByHand(sleigh())), &SleighInput { torque: 0.3 })?;
    compare(second, (snakeboard(), ByHand(snakeboard())), &SnakeboardInput { rotor: 0.3, steering: 0.3 })?;
    compare(third, (veselova(), ByHand(veselova())), &())
}

/// Counts explicit steps of a system from random states.
macro_rules! explicit {
    ($system:expr, $input:expr, $T:ty, $Method:ident, $random:ident) => {{
        let (system, input) = ($system, $input);
        let h = <$T>::from_f64(H);
        for _ in 0..SAMPLES {
            let state = State::from_array(std::array::from_fn(|_| <$T>::from_f64($random.draw())));
            counted_steps(&mut || {
                for _ in 0..STEPS {
                    black_box($Method::step(
                        black_box(&system),
                        <$T as Scalar>::ZERO,
                        h,
                        black_box(&state),
                        &input,
                    ));
                }
            });
        }
    }};
}

/// Counts the explicit steps of all columns; `system` and `input` are functions over any number.
macro_rules! in_numbers {
    ($wrapped:path, $system:ident, $input:path, $random:ident) => {{
        explicit!($wrapped($system::<f32>()), $input(), f32, Rk4, $random);
        explicit!($wrapped($system::<f32>()), $input(), f32, Dop853, $random);
        explicit!($wrapped($system::<Fast<f64>>()), $input(), Fast<f64>, Rk4, $random);
        explicit!($wrapped($system::<f64x4>()), $input(), f64x4, Rk4, $random);
        explicit!($wrapped($system::<f32x8>()), $input(), f32x8, Rk4, $random);
    }};
}

fn torque<T: Scalar>() -> SleighInput<T> {
    SleighInput { torque: T::from_f64(0.3) }
}

fn torques<T: Scalar>() -> SnakeboardInput<T> {
    SnakeboardInput { rotor: T::from_f64(0.3), steering: T::from_f64(0.3) }
}

fn none() {}

/// Counts steps with their derivatives: emitted, or by hand in jets.
macro_rules! linearized {
    (emitted $system:expr, $input:expr, $states:literal, $inputs:literal, $random:ident) => {{
        let (system, input) = ($system, $input);
        for _ in 0..SAMPLES {
            let state = State::from_array(std::array::from_fn(|_| $random.draw()));
            counted_steps(&mut || {
                for _ in 0..STEPS {
                    black_box(Rk4::linearized_step(black_box(&system), 0.0, H, black_box(&state), &input));
                }
            });
        }
    }};
    (by_hand $system:expr, $input:expr, $states:literal, $inputs:literal, $random:ident) => {{
        let (system, input) = (ByHand($system), $input);
        for _ in 0..SAMPLES {
            let numbers: [f64; $states] = std::array::from_fn(|_| $random.draw());
            counted_steps(&mut || {
                for _ in 0..STEPS {
                    let state =
                        State::from_array(Jet::<f64, $states, $inputs>::variables(black_box(numbers)));
                    let (t, h) = (Jet::ZERO, Jet::constant(H));
                    black_box(Rk4::step(black_box(&system), t, h, &state, &input));
                }
            });
        }
    }};
}

/// An input that jets are differentiated by.
fn input<const N: usize, const M: usize>(place: usize) -> Jet<f64, N, M> {
    let by_others = std::array::from_fn(|j| if j == place { 1.0 } else { 0.0 });
    Jet { by_others, ..Jet::constant(0.3) }
}

/// What is counted by itself, in the order of the table: by rows, emitted before by hand; with the columns of each.
pub(crate) const PARTS: [(&str, usize); 12] = [
    ("sleigh", NUMBERS),
    ("sleigh, linearized", 1),
    ("sleigh, by hand", NUMBERS),
    ("sleigh, by hand, linearized", 1),
    ("snakeboard", NUMBERS),
    ("snakeboard, linearized", 1),
    ("snakeboard, by hand", NUMBERS),
    ("snakeboard, by hand, linearized", 1),
    ("veselova", NUMBERS),
    ("veselova, linearized", 1),
    ("veselova, by hand", NUMBERS),
    ("veselova, by hand, linearized", 1),
];

/// Counts the steps of one part.
pub(crate) fn count_part(part: &str) {
    let mut random = Random::new();
    let random = &mut random;
    match part {
        "sleigh" => in_numbers!(std::convert::identity, sleigh, torque, random),
        "sleigh, linearized" => linearized!(emitted sleigh(), SleighInput { torque: 0.3 }, 5, 1, random),
        "sleigh, by hand" => in_numbers!(ByHand, sleigh, torque, random),
        "sleigh, by hand, linearized" => {
            linearized!(by_hand sleigh(), SleighInput { torque: input(0) }, 5, 1, random);
        }
        "snakeboard" => in_numbers!(std::convert::identity, snakeboard, torques, random),
        "snakeboard, linearized" => {
            linearized!(emitted snakeboard(), SnakeboardInput { rotor: 0.3, steering: 0.3 }, 8, 2, random);
        }
        "snakeboard, by hand" => in_numbers!(ByHand, snakeboard, torques, random),
        "snakeboard, by hand, linearized" => {
            let inputs = SnakeboardInput { rotor: input(0), steering: input(1) };
            linearized!(by_hand snakeboard(), inputs, 8, 2, random);
        }
        "veselova" => in_numbers!(std::convert::identity, veselova, none, random),
        "veselova, linearized" => linearized!(emitted veselova(), (), 6, 0, random),
        "veselova, by hand" => in_numbers!(ByHand, veselova, none, random),
        "veselova, by hand, linearized" => linearized!(by_hand veselova(), (), 6, 0, random),
        _ => {}
    }
}

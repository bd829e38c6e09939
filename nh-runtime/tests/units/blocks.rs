//! The law over the blocks of controllers and estimators.

use nalgebra::{SMatrix, SVector};
use nonholonomic::control::{
    Entry, Estimate, Model, Regulator, Sampled, Unscented, held_noise, zero_order_hold,
};
use nonholonomic::prelude::*;
use nonholonomic::{D, Jet, State};

use crate::plans::{gradients, plans, residuals};
use crate::scaled::two;
use crate::{Part, Verdict};

/// log₂ of the units of times, states, inputs, measurements and costs.
#[derive(Clone, Copy, Debug, Default)]
struct Powers {
    time: i32,
    state: i32,
    input: i32,
    measured: i32,
    cost: i32,
}

/// The same as numbers.
pub(crate) struct Units<T> {
    pub(crate) time: T,
    pub(crate) state: T,
    pub(crate) input: T,
    pub(crate) measured: T,
    pub(crate) cost: T,
}

/// What a block gives, in the units of the problem, as bits.
#[derive(Default)]
pub(crate) struct Outcome(Vec<u64>);

impl Outcome {
    pub(crate) fn matrix<T: Entry, const R: usize, const C: usize>(&mut self, m: &SMatrix<T, R, C>, unit: T) {
        self.0.extend(m.iter().map(|x| (*x / unit).to_f64().to_bits()));
    }
    pub(crate) fn number<T: Entry>(&mut self, x: T, unit: T) {
        self.0.push((x / unit).to_f64().to_bits());
    }
    pub(crate) fn refused(&mut self, error: &nonholonomic::control::ControlError) {
        // which error it is, since the numbers in it have units
        let text = format!("{error:?}");
        self.0.extend(text.bytes().take_while(u8::is_ascii_alphabetic).map(u64::from));
    }
}

fn matrix<T: Entry, const R: usize, const C: usize>(rows: [[f64; C]; R], unit: T) -> SMatrix<T, R, C> {
    SMatrix::from_fn(|i, j| T::from_f64(rows[i][j]) * unit)
}

const A: [[f64; 3]; 3] = [[0.0, 1.0, 0.0], [-2.0, -0.3, 0.7], [0.4, 0.0, -0.1]];
const B: [[f64; 2]; 3] = [[0.0, 0.1], [1.0, 0.0], [0.3, -0.7]];
const Q: [[f64; 3]; 3] = [[2.0, 0.1, 0.0], [0.1, 0.7, 0.2], [0.0, 0.2, 0.3]];
const R: [[f64; 2]; 2] = [[0.3, 0.05], [0.05, 0.6]];
const CROSS: [[f64; 2]; 3] = [[0.02, 0.0], [0.01, 0.03], [0.0, -0.02]];
const P: [[f64; 3]; 3] = [[1.3, 0.2, -0.1], [0.2, 0.8, 0.3], [-0.1, 0.3, 0.9]];
const H: [[f64; 3]; 2] = [[1.0, 0.0, 0.3], [0.0, 0.6, -0.2]];
const S: [[f64; 2]; 2] = [[0.02, 0.003], [0.003, 0.05]];

fn held<T: Entry>(u: &Units<T>, out: &mut Outcome) {
    for dt in [0.01, 0.3, 20.0] {
        let a = matrix(A, u.time.recip());
        let b = matrix(B, u.state / u.input / u.time);
        match zero_order_hold(&a, &b, T::from_f64(dt) * u.time) {
            Ok((step, reach)) => {
                out.matrix(&step, T::ONE);
                out.matrix(&reach, u.state / u.input);
            }
            Err(error) => out.refused(&error),
        }
    }
}

fn noise<T: Entry>(u: &Units<T>, out: &mut Outcome) {
    for dt in [0.01, 0.3, 20.0] {
        let density = matrix(Q, u.state * u.state / u.time);
        match held_noise(&matrix(A, u.time.recip()), &density, T::from_f64(dt) * u.time) {
            Ok(noise) => out.matrix(&noise, u.state * u.state),
            Err(error) => out.refused(&error),
        }
    }
}

fn regulators<T: Entry>(u: &Units<T>, out: &mut Outcome) {
    let one = SMatrix::<T, 3, 3>::identity();
    let a = one + matrix::<T, 3, 3>(A, T::from_f64(0.1));
    let b = matrix(B, u.state / u.input);
    let weigh = |unit: T| unit * u.cost;
    let q = matrix(Q, weigh((u.state * u.state).recip()));
    let r = matrix(R, weigh((u.input * u.input).recip()));
    let cross = matrix(CROSS, weigh((u.state * u.input).recip()));
    let unsteered = matrix([[0.0, 0.1], [0.0, 0.0], [0.0, -0.7]], u.state / u.input);
    let growing = matrix([[1.1, 0.0, 0.0], [0.0, 1.2, 0.0], [0.0, 0.0, 0.9]], T::ONE);
    for regulator in [
        Regulator::stationary(&a, &b, &q, &r),
        Regulator::stationary_with_cross(&a, &b, &q, &r, &cross),
        Regulator::before(&q, &a, &b, &q, &r),
        Regulator::stationary(&growing, &unsteered, &q, &r),
        Regulator::stationary(&a, &b, &-q, &r),
    ] {
        match regulator {
            Ok(regulator) => {
                out.matrix(&regulator.gain, u.input / u.state);
                out.matrix(&regulator.cost, weigh((u.state * u.state).recip()));
            }
            Err(error) => out.refused(&error),
        }
    }
}

/// What a filter knows at first.
fn prior<T: Entry>(u: &Units<T>, rows: [[f64; 3]; 3]) -> Estimate<T, 3> {
    let mean = SVector::from([0.3, -1.2, 0.7].map(|x| T::from_f64(x) * u.state));
    Estimate { mean, covariance: matrix(rows, u.state * u.state) }
}

fn note<T: Entry>(estimate: &Estimate<T, 3>, u: &Units<T>, out: &mut Outcome) {
    out.matrix(&estimate.mean, u.state);
    out.matrix(&estimate.covariance, u.state * u.state);
}

fn kalman<T: Entry>(u: &Units<T>, out: &mut Outcome) {
    for rows in COVARIANCES {
        let mut estimate = prior(u, rows);
        let step = SMatrix::<T, 3, 3>::identity() + matrix::<T, 3, 3>(A, T::from_f64(0.05));
        let observation = matrix(H, u.measured / u.state);
        for _ in 0..5 {
            let noise = matrix(Q, T::from_f64(1e-3) * u.state * u.state);
            match estimate.predicted(step * estimate.mean, &step, &noise) {
                Ok(next) => estimate = next,
                Err(error) => out.refused(&error),
            }
            let seen = SVector::from([T::from_f64(0.2) * u.measured, T::from_f64(-0.4) * u.measured]);
            let spread = matrix(S, u.measured * u.measured);
            match estimate.corrected(&(seen - observation * estimate.mean), &observation, &spread) {
                Ok(correction) => {
                    out.number(correction.surprise, T::ONE);
                    estimate = correction.estimate;
                }
                Err(error) => out.refused(&error),
            }
            note(&estimate, u, out);
        }
    }
}

/// Full, of rank one, with something certain, and none.
const COVARIANCES: [[[f64; 3]; 3]; 4] = [
    P,
    [[4.0, 2.0, -6.0], [2.0, 1.0, -3.0], [-6.0, -3.0, 9.0]],
    [[1.0, 0.0, 0.2], [0.0, 0.0, 0.0], [0.2, 0.0, 1e-9]],
    [[1.0, 2.0, 0.0], [2.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
];

fn unscented<T: Entry>(u: &Units<T>, out: &mut Outcome) {
    for (rows, spread) in COVARIANCES.into_iter().zip([1.0, 0.5, 1e-3, 1.0]) {
        let filter = Unscented { spread: T::from_f64(spread), ..Unscented::default() };
        let mut estimate = prior(u, rows);
        let step = |x: SVector<T, 3>| {
            let [a, b, c] = (x * u.state.recip()).into();
            let w = T::from_f64;
            SVector::from([a + w(0.1) * b, b - w(0.1) * a.sin(), c + w(0.1) * a * b]) * u.state
        };
        let observe = |x: SVector<T, 3>| {
            let [a, b, c] = (x * u.state.recip()).into();
            SVector::from([a * b, (a * a + c * c).sqrt()]) * u.measured
        };
        for _ in 0..4 {
            let noise = matrix(Q, T::from_f64(1e-3) * u.state * u.state);
            match filter.predicted(&estimate, step, &noise) {
                Ok(next) => estimate = next,
                Err(error) => out.refused(&error),
            }
            let seen = SVector::from([T::from_f64(-0.3) * u.measured, T::from_f64(0.8) * u.measured]);
            let spread = matrix(S, u.measured * u.measured);
            match filter.corrected(&estimate, &seen, observe, |a, b| a - b, &spread) {
                Ok(correction) => {
                    out.number(correction.surprise, T::ONE);
                    estimate = correction.estimate;
                }
                Err(error) => out.refused(&error),
            }
            note(&estimate, u, out);
        }
    }
}

/// A cart that a force pushes against a spring.
struct Cart<'a, T>(&'a Units<T>);

#[derive(Clone, Copy)]
struct Place<T>([T; 2]);

#[derive(Clone, Copy)]
struct Push<T>(T);

impl<T: Scalar> Default for Push<T> {
    fn default() -> Self {
        Self(T::ZERO)
    }
}
impl<T> From<[T; 1]> for Push<T> {
    fn from([push]: [T; 1]) -> Self {
        Self(push)
    }
}
impl<T: Scalar> State for Place<T> {
    type Scalar = T;
    type Dim = D<2>;
    fn to_array(&self) -> [T; 2] {
        self.0
    }
    fn from_array(components: [T; 2]) -> Self {
        Self(components)
    }
    fn names() -> [&'static str; 2] {
        ["a", "b"]
    }
}

impl<T: Entry> Cart<'_, T> {
    fn rates<N: Scalar>([a, b]: [N; 2], push: N) -> [N; 2] {
        [b, push - a.sin()]
    }
}

impl<T: Entry> Dynamics for Cart<'_, T> {
    type State = Place<T>;
    type Input = Push<T>;
    fn derivative(&self, _t: T, x: &Place<T>, u: &Push<T>) -> Place<T> {
        let unit = self.0;
        let rates = Self::rates(x.0.map(|x| x / unit.state), u.0 / unit.input);
        Place(rates.map(|rate| rate * (unit.state / unit.time)))
    }
}

impl<T: Entry> Jacobian for Cart<'_, T> {
    type InputDim = D<1>;
    fn state_jacobian(&self, _t: T, x: &Place<T>, u: &Push<T>) -> [[T; 2]; 2] {
        let unit = self.0;
        let jets = Jet::<T, 2>::variables(x.0.map(|x| x / unit.state));
        let rates = Self::rates(jets, Jet::constant(u.0 / unit.input));
        rates.map(|rate| rate.by.map(|partial| partial / unit.time))
    }
    fn input_jacobian(&self, _t: T, _x: &Place<T>, _u: &Push<T>) -> [[T; 1]; 2] {
        [[T::ZERO], [self.0.state / self.0.input / self.0.time]]
    }
}

fn sampled<T: Entry>(u: &Units<T>, out: &mut Outcome) {
    let (system, start, dt) = (Cart(u), T::from_f64(0.7) * u.time, T::from_f64(0.2) * u.time);
    let x = SVector::from([T::from_f64(0.4) * u.state, T::from_f64(-0.3) * u.state]);
    let input = SVector::from([T::from_f64(0.9) * u.input]);
    let state = Place(x.into());
    for step in [
        Ok(Rk4::linearized_step::<_, 2, 1>(&system, start, dt, &state, &Push(input[0]))),
        ImplicitMidpoint::linearized_step::<_, 2, 1>(&system, start, dt, &state, &Push(input[0])),
        GaussLegendre4::linearized_step::<_, 2, 1>(&system, start, dt, &state, &Push(input[0])),
        GaussLegendre6::linearized_step::<_, 2, 1>(&system, start, dt, &state, &Push(input[0])),
        Radau5::linearized_step::<_, 2, 1>(&system, start, dt, &state, &Push(input[0])),
    ] {
        match step {
            Ok(step) => {
                out.matrix(&SVector::from(step.state.0), u.state);
                out.matrix(&step.by_state, T::ONE);
                out.matrix(&step.by_input, u.state / u.input);
            }
            Err(error) => out.0.extend(error.to_string().bytes().take(16).map(u64::from)),
        }
    }
    let model = Sampled { system, start, dt };
    out.matrix(&model.step(3, &x, &input), u.state);
    out.matrix(&model.linearized(3, &x, &input).1, u.state / u.input);
}

/// The changes of units: of one at a time, and of all.
fn powers(far: bool, even_costs: bool) -> Vec<(Part, Powers)> {
    let mut all = Vec::new();
    let steps: &[i32] = if far { &[-201, -31, 2, 31, 150] } else { &[-13, -3, 2, 7, 13] };
    for &power in steps {
        let cost = if even_costs { 2 * (power / 2) } else { power };
        all.push((Part::Time, Powers { time: power, ..Powers::default() }));
        for powers in [
            Powers { state: power, ..Powers::default() },
            Powers { input: power, ..Powers::default() },
            Powers { measured: power, ..Powers::default() },
            Powers { cost, ..Powers::default() },
            Powers { time: 3, state: power, input: -power / 2, measured: -power, cost: -cost },
        ] {
            all.push((Part::OneUnit, powers));
        }
    }
    all
}

/// A block by its name.
type Block<T> = (&'static str, fn(&Units<T>, &mut Outcome));

fn every_block<T: Entry>(numbers: &str, far: bool) {
    let mut verdict = Verdict::default();
    let blocks: [Block<T>; 9] = [
        ("zero_order_hold", held),
        ("held_noise", noise),
        ("Regulator", regulators),
        ("Estimate", kalman),
        ("Unscented", unscented),
        ("Ilqr", plans),
        ("Squares", residuals),
        ("shooting", gradients),
        ("Sampled", sampled),
    ];
    for (name, block) in blocks {
        let run = |powers: &Powers| {
            let [time, state, input, measured, cost] =
                [powers.time, powers.state, powers.input, powers.measured, powers.cost].map(two::<T>);
            let mut out = Outcome::default();
            block(&Units { time, state, input, measured, cost }, &mut out);
            out.0
        };
        let expected = run(&Powers::default());
        for (part, powers) in powers(far, name == "Squares") {
            let found = run(&powers);
            let place = expected.iter().zip(&found).position(|(a, b)| a != b);
            let place = place.or_else(|| (expected.len() != found.len()).then_some(expected.len()));
            let detail = place.map(|place| {
                let number = |bits: &[u64]| bits.get(place).map(|bits| f64::from_bits(*bits));
                format!("{powers:?}: {place} {:?} {:?}", number(&expected), number(&found))
            });
            verdict.note(&format!("{name}{numbers}"), part, detail);
        }
    }
    verdict.judge();
}

#[test]
fn blocks_in_double_precision() {
    every_block::<f64>("", true);
}

#[test]
fn blocks_in_single_precision() {
    every_block::<f32>(" in f32", false);
}

//! What a method keeps of what the flow keeps, measured.

use nonholonomic::Method;
use nonholonomic::prelude::*;

use super::systems::{
    ChaplyginSphere, ChaplyginSphereState, ContactOscillator, ContactOscillatorOnTq,
    ContactOscillatorOnTqState, ContactOscillatorState, HeavySuslov, HeavySuslovState, Suslov, SuslovState,
    Veselova, VeselovaState,
};

pub(crate) const CONTACT: ContactOscillator = ContactOscillator { epsilon: 0.3 };
pub(crate) const ON_TQ: ContactOscillatorOnTq = ContactOscillatorOnTq { epsilon: 0.3 };
pub(crate) const HEAVY: HeavySuslov = HeavySuslov { I: [1.0, 1.7, 2.2], c: [0.4, 0.3, 0.2] };
pub(crate) const SUSLOV: Suslov = Suslov { I: [1.0, 2.0, 3.0], k: 0.7 };
pub(crate) const VESELOVA: Veselova = Veselova { I: [1.3, 0.8, 2.1], c: [0.2, -0.5, 0.9] };
pub(crate) const SPHERE: ChaplyginSphere = ChaplyginSphere { I: [1.3, 0.8, 2.1], m: 0.9, r: 0.6 };

pub(crate) fn contact() -> ContactOscillatorState {
    ContactOscillatorState { x: 0.3, y: 0.5, z: 0.4, y_dot: 1.0, z_dot: 0.8 }
}

pub(crate) fn heavy() -> HeavySuslovState {
    HeavySuslovState { g: [0.6, 0.0, 0.8], w_0: 0.7, w_1: 0.9 }
}

pub(crate) fn veselova() -> VeselovaState {
    // orthogonal: 0.6 · 0.8 = 0.8 · 0.6
    VeselovaState { g: [0.6, 0.0, 0.8], w: [0.8, 0.5, -0.6] }
}

pub(crate) fn sphere() -> ChaplyginSphereState {
    ChaplyginSphereState { g: [0.6, 0.0, 0.8], w: [0.8, 0.5, -0.6] }
}

/// The length of the steps.
const H: f64 = 0.2;

/// How well something is kept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Kept {
    /// To round-off.
    Exactly(f64),
    /// With an error that does not grow.
    Nearly(f64),
    /// With an error that grows.
    Not(f64),
}

/// The larger of what was found so far and the size of an error; infinite where that is no number.
pub(crate) fn larger(so_far: f64, error: f64) -> f64 {
    if error.is_nan() { f64::INFINITY } else { so_far.max(error.abs()) }
}

impl Kept {
    /// From errors in the order of time.
    fn of(errors: &[f64]) -> Self {
        let largest = |errors: &[f64]| errors.iter().copied().fold(0.0, larger);
        let (all, early) = (largest(errors), largest(&errors[..errors.len() / 20]));
        match all {
            _ if all < 1e-12 => Self::Exactly(all),
            _ if all < 3.0 * early => Self::Nearly(all),
            _ => Self::Not(all),
        }
    }
}

impl std::fmt::Display for Kept {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Exactly(_) => f.pad("exactly"),
            Self::Nearly(error) => f.pad(&format!("nearly {error:.0e}")),
            Self::Not(error) => f.pad(&format!("no {error:.0e}")),
        }
    }
}

/// A row of the table.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    pub(crate) name: &'static str,
    pub(crate) order: f64,
    pub(crate) energy: Kept,
    /// |γ| = 1.
    pub(crate) identity: Kept,
    /// γ·ω = 0.
    pub(crate) constraint: Kept,
    /// The vertical angular momentum of the Chaplygin sphere.
    pub(crate) momentum: Kept,
    /// The distance to the start after steps forth and back.
    pub(crate) reversal: f64,
    /// The largest relative change of the invariant volume in a step.
    pub(crate) volume: f64,
}

/// Runs a method and collects what a function says at every step.
pub(crate) fn run<S, M>(
    system: S,
    start: S::State,
    method: M,
    steps: u32,
    error: impl Fn(&S::State) -> f64,
) -> Vec<f64>
where
    S: Dynamics<Input = ()> + Copy,
    S::State: State<Scalar = f64>,
    M: Method<S>,
{
    let mut sim = Integrator::new(system, method, 0.0, start);
    let reference = error(&start);
    let mut errors = Vec::new();
    for _ in 0..steps {
        if sim.step().is_err() {
            errors.push(f64::INFINITY);
            break;
        }
        errors.push(error(sim.state()) - reference);
    }
    errors
}

fn distance<X: State<Scalar = f64>>(a: &X, b: &X) -> f64 {
    let (a, b) = (a.to_array(), b.to_array());
    a.as_ref().iter().zip(b.as_ref()).map(|(a, b)| a - b).fold(0.0, larger)
}

fn end<S, M>(system: S, start: S::State, method: M, t: f64) -> S::State
where
    S: Dynamics<Input = ()>,
    S::State: State<Scalar = f64>,
    M: Method<S>,
{
    let mut sim = Integrator::new(system, method, 0.0, start);
    sim.advance_to(t).expect("a smooth motion");
    *sim.state()
}

/// |μ(x₁) det ∂x₁/∂x₀ / μ(x₀) − 1| at some points of a motion.
fn volume<M: Method<ContactOscillator>>(of: &impl Fn(f64) -> M) -> f64 {
    let step = |x: [f64; 5]| -> [f64; 5] {
        let mut sim = Integrator::new(CONTACT, of(H), 0.0, ContactOscillatorState::from(x));
        sim.step().expect("a smooth motion");
        (*sim.state()).into()
    };
    let mut worst: f64 = 0.0;
    for k in 1..20 {
        let state = end(CONTACT, contact(), Rk4::new(0.01), f64::from(k) * 0.37);
        let x: [f64; 5] = state.into();
        let delta = 1e-4;
        let columns: [[f64; 5]; 5] = std::array::from_fn(|j| {
            let moved = |by: f64| {
                let mut x = x;
                x[j] += by * delta;
                step(x)
            };
            // differences of fourth order
            let [a, b, c, d] = [moved(1.0), moved(-1.0), moved(2.0), moved(-2.0)];
            std::array::from_fn(|i| (8.0 * (a[i] - b[i]) - (c[i] - d[i])) / (12.0 * delta))
        });
        let density = |x: [f64; 5]| CONTACT.volume_density(0.0, &ContactOscillatorState::from(x));
        worst = larger(worst, determinant(columns) * density(step(x)) / density(x) - 1.0);
    }
    worst
}

fn determinant<const N: usize>(mut a: [[f64; N]; N]) -> f64 {
    let mut value = 1.0;
    for k in 0..N {
        let pivot = (k..N).max_by(|i, j| a[*i][k].abs().total_cmp(&a[*j][k].abs())).unwrap_or(k);
        if pivot != k {
            a.swap(pivot, k);
            value = -value;
        }
        value *= a[k][k];
        let leading = a[k];
        for row in a.iter_mut().skip(k + 1) {
            let factor = row[k] / leading[k];
            row.iter_mut().zip(leading).for_each(|(entry, lead)| *entry -= factor * lead);
        }
    }
    value
}

/// Measures a method that takes every system, over so many steps.
pub(crate) fn row<M>(name: &'static str, steps: u32, of: impl Fn(f64) -> M) -> Row
where
    M: Method<ContactOscillator> + Method<HeavySuslov> + Method<Veselova> + Method<ChaplyginSphere>,
{
    let norm = |g: [f64; 3]| g.iter().map(|x| x * x).sum::<f64>();
    let dot = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let vertical = |s: &ChaplyginSphereState| dot(s.g, std::array::from_fn(|i| SPHERE.I[i] * s.w[i]));
    Row {
        name,
        order: order_of(HEAVY, heavy(), &of, 0.2),
        energy: Kept::of(&run(CONTACT, contact(), of(H), steps, |s| CONTACT.energy(0.0, s))),
        identity: Kept::of(&run(VESELOVA, veselova(), of(H), steps, |s| norm(s.g))),
        constraint: Kept::of(&run(VESELOVA, veselova(), of(H), steps, |s| dot(s.g, s.w))),
        momentum: Kept::of(&run(SPHERE, sphere(), of(H), steps, vertical)),
        reversal: there_and_back(VESELOVA, veselova(), of(H)),
        volume: volume(&of),
    }
}

/// What is measured of a method that not every system takes.
pub(crate) struct Special {
    pub(crate) name: &'static str,
    pub(crate) order: f64,
    pub(crate) energy: Kept,
    /// The constraint of the contact oscillator on TQ.
    pub(crate) constraint: Option<Kept>,
    pub(crate) reversal: f64,
}

/// Measures a method on TQ.
pub(crate) fn on_tq<M>(name: &'static str, steps: u32, of: impl Fn(f64) -> M) -> Special
where
    M: Method<ContactOscillatorOnTq>,
{
    let start =
        ContactOscillatorOnTqState { x: 0.3, y: 0.5, z: 0.4, x_dot: -0.5 * 0.8, y_dot: 1.0, z_dot: 0.8 };
    let residual = |s: &ContactOscillatorOnTqState| s.x_dot + s.y * s.z_dot;
    Special {
        name,
        order: order_of(ON_TQ, start, &of, 0.02),
        energy: Kept::of(&run(ON_TQ, start, of(H), steps, |s| ON_TQ.energy(0.0, s))),
        constraint: Some(Kept::of(&run(ON_TQ, start, of(H), steps, residual))),
        reversal: there_and_back(ON_TQ, start, of(H)),
    }
}

/// Measures a method on a Lie algebra, while the motion settles.
pub(crate) fn on_algebra<M: Method<Suslov>>(name: &'static str, of: impl Fn(f64) -> M) -> Special {
    let start = SuslovState { w_0: 0.6, w_1: 0.8 };
    Special {
        name,
        order: order_of(SUSLOV, start, &of, 0.02),
        energy: Kept::of(&run(SUSLOV, start, of(H), 100, |s| SUSLOV.energy(0.0, s))),
        constraint: None,
        reversal: there_and_back(SUSLOV, start, of(H / 20.0)),
    }
}

/// The order, from the errors with two lengths of steps.
fn order_of<S, M>(system: S, start: S::State, of: &impl Fn(f64) -> M, h: f64) -> f64
where
    S: Dynamics<Input = ()> + Copy,
    S::State: State<Scalar = f64>,
    M: Method<S>,
{
    let exact = end(system, start, Vern9::new().rtol(1e-13).atol(1e-13), 2.0);
    let error = |h: f64| distance(&end(system, start, of(h), 2.0), &exact);
    (error(h) / error(h / 2.0)).log2()
}

/// How far 500 steps forth and back lead from the start.
fn there_and_back<S, M>(system: S, start: S::State, method: M) -> f64
where
    S: Dynamics<Input = ()> + Copy,
    S::State: State<Scalar = f64>,
    M: Method<S>,
{
    let mut sim = Integrator::new(system, method, 0.0, start);
    for _ in 0..500 {
        if sim.step().is_err() {
            return f64::INFINITY;
        }
    }
    if sim.advance_to(0.0).is_err() { f64::INFINITY } else { distance(sim.state(), &start) }
}

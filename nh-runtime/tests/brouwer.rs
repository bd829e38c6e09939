//! How the energy error of long integrations near round-off grows with the number N of steps: like √N where rounding
//! errors have no common sign (Brouwer 1937). The exponents are printed by
//! `cargo test --release -p nonholonomic --test brouwer -- --nocapture`.

use nonholonomic::prelude::*;
use nonholonomic::{Dynamics, Method};

/// Kepler's problem.
#[nonholonomic(
    base       { x, y }
    lagrangian { (der(x)^2 + der(y)^2) / 2 + 1 / sqrt(x^2 + y^2) }
    emit       { taylor, jacobian }
)]
#[derive(Clone, Copy, Debug)]
struct Kepler {}

/// The oscillator of Hénon and Heiles.
#[nonholonomic(
    base       { x, y }
    lagrangian { (der(x)^2 + der(y)^2) / 2 - (x^2 + y^2) / 2 - x^2*y + y^3 / 3 }
    emit       { taylor, jacobian }
)]
#[derive(Clone, Copy, Debug)]
struct HenonHeiles {}

/// A pendulum.
#[nonholonomic(
    base       { q }
    lagrangian { der(q)^2 / 2 + cos(q) }
    emit       { taylor, jacobian }
)]
#[derive(Clone, Copy, Debug)]
struct Pendulum {}

/// The contact oscillator: ż = y ẋ.
#[nonholonomic(
    base        { x, y, z }
    lagrangian  { (der(x)^2 + der(y)^2 + der(z)^2) / 2 - (x^2 + y^2) / 2 }
    constraints { der(z) = y * der(x); }
    emit        { taylor, jacobian }
)]
#[derive(Clone, Copy, Debug)]
struct Contact {}

/// log₂ N of the runs that are compared; fewer where the code is not optimised.
const RANGE: (u32, u32) = if cfg!(debug_assertions) { (7, 10) } else { (12, 18) };
/// The runs of each system.
const RUNS: u32 = if cfg!(debug_assertions) { 2 } else { 8 };

/// The energy errors at N = 2^k steps.
fn errors<S, M>(system: S, method: M, start: S::State, energy: impl Fn(&S::State) -> f64) -> Vec<f64>
where
    S: Dynamics<Input = ()>,
    S::State: State<Scalar = f64>,
    M: Method<S>,
{
    let before = energy(&start);
    let mut sim = Integrator::new(system, method, 0.0, start).max_steps(u64::MAX);
    let mut errors = Vec::new();
    let mut done = 0_u64;
    for k in RANGE.0..=RANGE.1 {
        while done < 1 << k {
            sim.step().unwrap();
            done += 1;
        }
        errors.push(energy(sim.state()) / before - 1.0);
    }
    errors
}

/// The slope of the logarithm of the mean error over that of N, and the last one.
fn growth(name: &str, runs: &[Vec<f64>]) -> (f64, f64) {
    let mean = |i: usize| (runs.iter().map(|run| run[i].powi(2)).sum::<f64>() / f64::from(RUNS)).sqrt();
    let points: Vec<_> = (RANGE.0..=RANGE.1).zip(0..).map(|(k, i)| (f64::from(k), mean(i).log2())).collect();
    let count = f64::from(RANGE.1 - RANGE.0 + 1);
    let (x, y) = points.iter().fold((0.0, 0.0), |(x, y), (px, py)| (x + px / count, y + py / count));
    let along = points.iter().map(|(px, py)| (px - x) * (py - y)).sum::<f64>();
    let slope = along / points.iter().map(|(px, _)| (px - x).powi(2)).sum::<f64>();
    let last = points.last().map_or(0.0, |(_, y)| y.exp2());
    println!("{name}: N^{slope:.2}, {last:.1e} after 2^{} steps", RANGE.1);
    (slope, last)
}

/// Four systems by a method.
macro_rules! growths {
    ($name:literal, $method:expr) => {{
        let starts: Vec<f64> = (0..RUNS).map(|i| 0.3 + 0.037 * f64::from(i)).collect();
        let kepler = starts.iter().map(|e| {
            let start =
                KeplerState { x: 1.0 + 0.3 * e, y_dot: (1.0 - 0.3 * e).sqrt(), ..KeplerState::default() };
            errors(Kepler {}, $method, start, |s| Kepler {}.energy(0.0, s))
        });
        let henon = starts.iter().map(|e| {
            let start = HenonHeilesState { x: 0.3 * e, y: 0.0, x_dot: 0.1 * e, y_dot: 0.3 };
            errors(HenonHeiles {}, $method, start, |s| HenonHeiles {}.energy(0.0, s))
        });
        let pendulum = starts.iter().map(|e| {
            let start = PendulumState { q: 1.0 + e, ..PendulumState::default() };
            errors(Pendulum {}, $method, start, |s| Pendulum {}.energy(0.0, s) + 2.0)
        });
        let contact = starts.iter().map(|e| {
            let start = ContactState { x: 1.0, y: *e, x_dot: 0.2, y_dot: 0.4, ..ContactState::default() };
            errors(Contact {}, $method, start, |s| Contact {}.energy(0.0, s))
        });
        [
            growth(concat!($name, ", Kepler"), &kepler.collect::<Vec<_>>()),
            growth(concat!($name, ", Hénon–Heiles"), &henon.collect::<Vec<_>>()),
            growth(concat!($name, ", pendulum"), &pendulum.collect::<Vec<_>>()),
            growth(concat!($name, ", contact oscillator"), &contact.collect::<Vec<_>>()),
        ]
    }};
}

#[test]
fn the_energy_walks_at_random_with_a_gauss_method() {
    for (exponent, last) in
        growths!("GaussLegendre6", GaussLegendre6::new(0.02).with_jacobian().compensated())
    {
        assert!(last < 5e-15, "{last:e}");
        assert!(cfg!(debug_assertions) || exponent < 0.65, "{exponent}");
    }
}

#[test]
fn the_energy_walks_at_random_with_a_taylor_series() {
    for (exponent, last) in growths!("Taylor", Taylor::new().rtol(1e-15).atol(1e-16)) {
        assert!(last < 1e-13, "{last:e}");
        assert!(cfg!(debug_assertions) || exponent < 0.65, "{exponent}");
    }
}

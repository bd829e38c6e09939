//! What a million steps leave of energies, momenta and constraints, by each method that promises to keep something of them:
//! `cargo test --release -p nonholonomic --test drift -- --nocapture` prints it.

use nonholonomic::prelude::*;
use nonholonomic::{Dynamics, Method};

/// A body that turns about its centre of mass: two quadratic invariants.
#[nonholonomic(
    basis      { w1, w2, w3 }
    brackets so(3) { w1, w2, w3 }
    lagrangian { (w1^2 + 2 * w2^2 + 3 * w3^2) / 2 }
    conserved  { total = (w1^2 + 2 * w2^2 + 3 * w3^2) / 2; square = w1^2 + 4 * w2^2 + 9 * w3^2; }
    emit       { discrete_gradient, invariants }
)]
#[derive(Clone, Copy, Debug)]
struct Body {}

/// The contact oscillator: ż = y ẋ.
#[nonholonomic(
    base        { x, y, z }
    lagrangian  { (der(x)^2 + der(y)^2 + der(z)^2) / 2 - (x^2 + y^2 + z^2) / 2 }
    constraints { der(z) = y * der(x); }
    conserved   { total = (der(x)^2 + der(y)^2 + der(z)^2) / 2 + (x^2 + y^2 + z^2) / 2; }
    emit        { discrete_gradient, invariants }
)]
#[derive(Clone, Copy, Debug)]
struct Contact {}

/// A mass on a rod in space.
#[nonholonomic(
    base       { x, y, z }
    holonomic  { rod: x^2 + y^2 + z^2 = 1; }
    lagrangian { (der(x)^2 + der(y)^2 + der(z)^2) / 2 - z }
    conserved  { total = (der(x)^2 + der(y)^2 + der(z)^2) / 2 + z; }
    emit       { discrete_gradient, symmetric_projection, invariants, rattle }
)]
#[derive(Clone, Copy, Debug)]
struct Rod {}

/// The steps of a run; fewer where the code is not optimised.
const STEPS: u64 = if cfg!(debug_assertions) { 5000 } else { 1_000_000 };

/// The largest errors within the last tenth of a run.
fn drift<S, M, const K: usize>(
    name: &str,
    (system, method, start): (S, M, S::State),
    errors: impl Fn(f64, &S::State) -> [f64; K],
    permitted: [f64; K],
) where
    S: Dynamics<Input = ()>,
    S::State: State<Scalar = f64>,
    M: Method<S>,
{
    let mut sim = Integrator::new(system, method, 0.0, start).max_steps(u64::MAX);
    let mut worst = [0.0_f64; K];
    for done in 1..=STEPS {
        sim.step().unwrap_or_else(|error| panic!("{name} after {done} steps: {error}"));
        if done * 10 > STEPS * 9 {
            let found = errors(sim.time(), sim.state());
            worst.iter_mut().zip(found).for_each(|(worst, found)| *worst = worst.max(found.abs()));
        }
    }
    println!("{name}: {} after {STEPS} steps", worst.map(|most| format!("{most:.0e}")).join(", "));
    assert!(worst.iter().zip(permitted).all(|(worst, most)| *worst <= most), "{name}: {worst:?}");
}

macro_rules! drifts {
    ($system:expr, $start:expr, $errors:expr, $($method:expr => $permitted:expr),* $(,)?) => {$(
        drift(stringify!($method), ($system, $method, $start), $errors, $permitted);
    )*};
}

#[test]
fn quadratic_invariants() {
    let start = BodyState { w1: 0.4, w2: 1.1, w3: -0.3 };
    let square = |s: &BodyState| s.w1 * s.w1 + 4.0 * s.w2 * s.w2 + 9.0 * s.w3 * s.w3;
    let before = (Body {}.energy(0.0, &start), square(&start));
    let errors =
        |_: f64, s: &BodyState| [Body {}.energy(0.0, s) / before.0 - 1.0, square(s) / before.1 - 1.0];
    drifts! { Body {}, start, errors,
        ImplicitMidpoint::new(0.1) => [5e-13; 2],
        ImplicitMidpoint::new(0.1).compensated() => [3e-14; 2],
        ImplicitMidpoint::new(0.2).fourth_order().compensated() => [3e-14; 2],
        GaussLegendre4::new(0.1).compensated() => [3e-14; 2],
        GaussLegendre6::new(0.1).compensated() => [3e-14; 2],
        DiscreteGradient::new(0.1) => [4e-15, 5e-12],
        DiscreteGradient::new(0.1).compensated() => [4e-15, 5e-13],
        Conserving::new(Rk4::new(0.1)) => [4e-15; 2],
    }
}

#[test]
fn the_energy_of_a_contact_oscillator() {
    let start = ContactState { x: 1.0, y: 0.3, z: 0.2, x_dot: 0.2, y_dot: 0.4 };
    let before = Contact {}.energy(0.0, &start);
    let errors = |_: f64, state: &ContactState| [Contact {}.energy(0.0, state) / before - 1.0];
    drifts! { Contact {}, start, errors,
        DiscreteGradient::new(0.05) => [4e-15],
        DiscreteGradient::new(0.1).fourth_order().compensated() => [4e-15],
        Conserving::new(Rk4::new(0.05)) => [4e-15],
    }
}

#[test]
fn constraints_and_energy_of_a_rod() {
    let mut start = RodState { x: 0.5, y: 0.0, z: -0.8, x_dot: 0.3, y_dot: 1.1, z_dot: 0.2 };
    Rod {}.project(0.0, &mut start).unwrap();
    let before = Rod {}.energy(0.0, &start);
    let errors = |t: f64, s: &RodState| {
        let left = Constrained::constraint_residual(&Rod {}, t, s);
        let most = left.iter().fold(0.0, |most: f64, left| most.max(left.abs()));
        [Rod {}.energy(0.0, s) / before - 1.0, most]
    };
    drifts! { Rod {}, start, errors,
        Rattle::new(0.05) => [5e-3, 4e-15],
        Rattle::new(0.1).fourth_order().compensated() => [1e-5, 4e-15],
        DiscreteGradient::new(0.05) => [2e-14, 4e-15],
        ImplicitMidpoint::new(0.05).symmetrically_projected() => [5e-3, 4e-15],
        Conserving::new(Rk4::new(0.05)) => [2e-14, 4e-15],
        Projected::new(Rk4::new(0.05), 1) => [0.1, 4e-15],
    }
}

//! The way back to the constraints: it gets there, is orthogonal in the kinetic metric, and does
//! nothing twice.

use nh_tests::comparison::{self, larger};
use nh_tests::random::Random;
use nh_tests::systems::snakeboard::{SnakeboardOnThePlane, SnakeboardOnThePlaneState};
use nonholonomic::prelude::*;
use nonholonomic::{Dim, ProjectionError, VecOf};

/// A system with its mass matrix at a state, in the projected formulation.
trait Metric: Constrained<State: State<Scalar = f64>> {
    /// W w.
    fn momentum(&self, state: &Self::State, velocity: &[f64]) -> Vec<f64>;
}

/// A point whose speed is kept by a constraint that is quadratic in the velocities.
#[nonholonomic(
    base { x, y, z }
    lagrangian { m / 2 * (der(x)^2 + 2 * der(y)^2 + der(z)^2 + cos(x) * der(y) * der(z)) - m * g * z }
    constraints { speed: der(x)^2 + der(y)^2 + der(z)^2 = c^2; }
)]
#[derive(Clone, Copy, Debug)]
struct Marble {
    m: f64,
    g: f64,
    c: f64,
}

impl Metric for Marble {
    fn momentum(&self, x: &MarbleState, v: &[f64]) -> Vec<f64> {
        let half = x.x.cos() / 2.0;
        [v[0], 2.0 * v[1] + half * v[2], v[2] + half * v[1]].map(|p| self.m * p).to_vec()
    }
}

/// A blade that is carried along with a velocity which depends on the time: an affine constraint.
#[nonholonomic(
    base { theta, x, y }
    formulation { projected }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) + J / 2 * der(theta)^2 }
    constraints { r#type: cos(theta) * der(y) - sin(theta) * der(x) = u * sin(t); }
)]
#[derive(Clone, Copy, Debug)]
#[allow(non_snake_case, reason = "as in mechanics")]
struct Ferry {
    m: f64,
    J: f64,
    u: f64,
}

impl Metric for Ferry {
    fn momentum(&self, _: &FerryState, v: &[f64]) -> Vec<f64> {
        vec![self.J * v[0], self.m * v[1], self.m * v[2]]
    }
}

/// At x = 0 the kinetic energy leaves a velocity out, and at x = -m it is not definite: the constraints determine the motion
/// there, and lead back.
#[nonholonomic(
    base { x, y, z, w }
    lagrangian { (der(x)^2 + (m + x) * der(y)^2 + x^2 * der(z)^2 + der(w)^2) / 2 }
    constraints {
        a * x * der(x) + (x^2 - 1) * der(y) + x * y * der(z) + (x - a) * der(w) = 0;
        (x - y) * der(x) + sin(x) * y * der(y) + (x - y) * der(z) + (x^2 + 1) * der(w) = 0;
        a * x * der(x) + y * der(y) + sqrt(1 + x^2) * der(z) + (x^2 - 1) * der(w) = 0;
    }
    assume { m > 0; }
)]
#[derive(Clone, Copy, Debug)]
struct Linkage {
    m: f64,
    a: f64,
}

/// The same with one constraint.
#[nonholonomic(
    base { x, y, z, w }
    lagrangian { (der(x)^2 + (m + x) * der(y)^2 + x^2 * der(z)^2 + der(w)^2) / 2 }
    constraints { y * der(x) + cos(x) * der(y) + (x - y) * der(z) + (x^2 - 1) * der(w) = 0; }
    assume { m > 0; }
)]
#[derive(Clone, Copy, Debug)]
struct Slider {
    m: f64,
}

impl Metric for SnakeboardOnThePlane {
    fn momentum(&self, _: &SnakeboardOnThePlaneState, v: &[f64]) -> Vec<f64> {
        let Self { m, l, J0, J1 } = *self;
        vec![m * v[0], m * v[1], m * l * l * v[2] + J0 * v[3], J0 * (v[3] + v[2]), 2.0 * J1 * v[4]]
    }
}

/// A blade over any scalar, with a sphere of directions that it need not turn with.
#[nonholonomic(
    base { theta, x, y, g[2] }
    on { g[0]^2 + g[1]^2 = 1; }
    basis { omega, u, v }
    anchor { der(theta) = omega; der(x) = u; der(y) = v; der(g[0]) = -g[1] * omega; der(g[1]) = g[0] * omega; }
    formulation { projected }
    lagrangian { m / 2 * (u^2 + v^2) + omega^2 / 2 }
    constraints { cos(theta) * v = sin(theta) * u; }
    emit { multipliers, reactions }
)]
#[derive(Clone, Copy, Debug)]
struct Blade<T> {
    m: T,
}

const MARBLE: Marble = Marble { m: 1.3, g: 9.8, c: 2.0 };
const FERRY: Ferry = Ferry { m: 2.0, J: 0.3, u: 0.7 };
const BOARD: SnakeboardOnThePlane = SnakeboardOnThePlane { m: 6.0, l: 0.3, J0: 0.16, J1: 0.04 };

fn packed<S: Constrained<State: State<Scalar = f64>>>(numbers: &[f64]) -> S::State {
    let mut array: VecOf<S> = <<S::State as State>::Dim as Dim>::vec(0.0);
    array.as_mut().copy_from_slice(numbers);
    S::State::from_array(array)
}

fn unpacked<X: State<Scalar = f64>>(state: &X) -> Vec<f64> {
    state.to_array().as_ref().to_vec()
}

fn residuals<S: Constrained<State: State<Scalar = f64>>>(system: &S, t: f64, x: &S::State) -> Vec<f64> {
    system.constraint_residual(t, x).as_ref().to_vec()
}

fn largest(x: &[f64]) -> f64 {
    comparison::largest(x.iter().copied())
}

/// ∂φ/∂y by central differences, a row for each constraint: exact whatever the step, for constraints
/// that are at most quadratic.
fn jacobian<S: Metric>(system: &S, t: f64, x: &S::State, first: usize) -> Vec<Vec<f64>> {
    let h = 1.0;
    let at = |j: usize, h: f64| {
        let mut moved = unpacked(x);
        moved[j] += h;
        residuals(system, t, &packed::<S>(&moved))
    };
    let columns: Vec<Vec<f64>> = (first..unpacked(x).len())
        .map(|j| at(j, h).iter().zip(at(j, -h)).map(|(up, down)| (up - down) / (2.0 * h)).collect())
        .collect();
    (0..columns[0].len()).map(|a| columns.iter().map(|column| column[a]).collect()).collect()
}

/// What is left of `x` when its part in the span of `rows` is taken away, relative to it.
fn outside_the_span(x: &[f64], rows: &[Vec<f64>]) -> f64 {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let minus = |x: &mut Vec<f64>, unit: &[f64]| {
        let along = dot(x, unit);
        x.iter_mut().zip(unit).for_each(|(x, u)| *x -= along * u);
    };
    let mut units: Vec<Vec<f64>> = Vec::new();
    for row in rows {
        let mut rest = row.clone();
        for unit in &units {
            minus(&mut rest, unit);
        }
        let norm = dot(&rest, &rest).sqrt();
        units.push(rest.iter().map(|r| r / norm).collect());
    }
    let mut rest = x.to_vec();
    for unit in &units {
        minus(&mut rest, unit);
    }
    largest(&rest) / largest(x)
}

/// Random states at a distance from the constraints: all the claims about the projection.
fn check<S: Metric>(system: &S, seed: u64, coordinates: usize, velocities: usize, distance: f64) {
    let mut random = Random::new(seed);
    let mut worst = [0.0_f64; 3];
    for _ in 0..200 {
        let t = random.between(-3.0, 3.0);
        // 1. a state on the constraints, away from where they are dependent
        let mut numbers = random.list(coordinates, -1.0, 1.0);
        let speeds = random.list(velocities, 0.5, 2.0);
        numbers.extend(speeds.iter().zip(random.list(velocities, -1.0, 1.0)).map(|(v, s)| v * s.signum()));
        let mut on = packed::<S>(&numbers);
        system.project(t, &mut on).unwrap();
        // 2. off them, and back
        let mut off = unpacked(&on);
        let scale = largest(&off[coordinates..]);
        off[coordinates..].iter_mut().for_each(|v| *v += scale * random.between(-distance, distance));
        let off = packed::<S>(&off);
        let mut back = off;
        system.project(t, &mut back).unwrap();
        let left = largest(&residuals(system, t, &back)) / (1.0 + scale * scale);
        worst[0] = larger(worst[0], left);
        // 3. coordinates stay; the correction is W⁻¹ Jᵀ μ with J where it ends
        let (from, to) = (unpacked(&off), unpacked(&back));
        assert_eq!(from[..coordinates], to[..coordinates]);
        let correction: Vec<f64> =
            from[coordinates..].iter().zip(&to[coordinates..]).map(|(a, b)| b - a).collect();
        let momentum = system.momentum(&back, &correction);
        // in units of the velocities: a correction is the difference of two, and has no more digits than they
        let outside = outside_the_span(&momentum, &jacobian(system, t, &back, coordinates));
        worst[1] = larger(worst[1], outside * largest(&correction) / scale);
        // 4. once more changes nothing
        let mut again = back;
        system.project(t, &mut again).unwrap();
        let moved: Vec<f64> = to.iter().zip(unpacked(&again)).map(|(a, b)| a - b).collect();
        worst[2] = larger(worst[2], largest(&moved) / scale);
    }
    println!("{}: {worst:?}", std::any::type_name::<S>());
    assert!(worst[0] < 1e-14, "left of the residual: {worst:?}");
    assert!(worst[1] < 1e-14, "not orthogonal: {worst:?}");
    assert!(worst[2] < 1e-14, "not idempotent: {worst:?}");
}

#[test]
fn random_states_return_orthogonally_and_once() {
    check(&BOARD, 1, 5, 5, 0.3);
    check(&FERRY, 2, 3, 3, 0.3);
    check(&MARBLE, 3, 3, 3, 0.2);
    check(&MARBLE, 4, 3, 3, 1e-6);
}

#[test]
fn residuals_have_the_names_of_the_constraints() {
    let state = FerryState { theta: 0.0, y_dot: 0.5, ..FerryState::default() };
    assert_eq!(FERRY.constraint_residual(0.0, &state), FerryResidual { r#type: 0.5 });
    let state = SnakeboardOnThePlaneState { y_dot: 1.0, theta_dot: 1.0, ..Default::default() };
    let residual = BOARD.constraint_residual(0.0, &state);
    assert!((residual.wheel_back - 0.7).abs() < 1e-15 && (residual.wheel_front - 1.3).abs() < 1e-15);
}

#[test]
fn states_return_where_only_the_constraints_make_the_equations_regular() {
    let linkage = Linkage { m: 2.0, a: 0.7 };
    for x in [0.0, -2.0] {
        let mut state =
            LinkageState { x, y: 0.7, x_dot: 0.4, y_dot: 0.3, z_dot: -0.2, w_dot: 0.1, ..Default::default() };
        let before = unpacked(&state);
        linkage.project(0.0, &mut state).unwrap();
        let left = largest(&residuals(&linkage, 0.0, &state));
        let moved =
            largest(&unpacked(&state)[4..].iter().zip(&before[4..]).map(|(a, b)| a - b).collect::<Vec<_>>());
        assert!(left < 1e-15 && moved < 1.0, "{x}: {left:e} {moved}");
        let rates = linkage.derivative(0.0, &state, &());
        assert!(unpacked(&rates).iter().all(|rate| rate.is_finite()), "{rates:?}");
    }
}

#[test]
fn motions_go_through_places_where_only_the_constraints_make_them_regular() {
    let slider = Slider { m: 2.0 };
    let at = |x: f64| {
        let mut state =
            SliderState { x, y: 0.7, x_dot: 0.4, y_dot: 0.3, z_dot: -0.2, w_dot: 0.1, ..Default::default() };
        slider.project(0.0, &mut state).unwrap();
        (unpacked(&state), unpacked(&slider.derivative(0.0, &state, &())))
    };
    let ((state, rates), (near, rates_near)) = (at(0.0), at(1e-7));
    for (value, near) in state.iter().chain(&rates).zip(near.iter().chain(&rates_near)) {
        assert!((value - near).abs() < 1e-5, "{state:?} {rates:?} {rates_near:?}");
    }
}

#[test]
fn any_scalar_is_projected() {
    let blade = Blade { m: 2.0_f32 };
    let mut state = BladeState { theta: 0.3, u: 1.0, v: 1.5, g: [0.3, 0.5], ..BladeState::default() };
    assert!((blade.constraint_residual(0.0, &state).constraint_1 - 1.137_484).abs() < 1e-6);
    blade.project(0.0, &mut state).unwrap();
    let left = Constrained::constraint_residual(&blade, 0.0, &state);
    assert!(left.iter().all(|r| r.abs() < 2e-7), "{left:?}");
    let error = Integrator::new(blade, Rk4::new(0.1), 0.0, BladeState { g: [0.9, 0.0], ..state }).step();
    assert!(matches!(error, Err(IntegrationError::InvalidState(_))));
    let mut sim = Integrator::new(blade, Projected::new(Rk4::new(0.01), 5), 0.0, state);
    sim.advance_to(10.0).unwrap();
    assert_eq!(sim.statistics().projections, 200);
}

#[test]
fn what_cannot_be_projected_stays_as_it_is() {
    // at rest the constraint on the speed has no direction
    let rest = MarbleState { x: 0.3, ..MarbleState::default() };
    let mut state = rest;
    let error = MARBLE.project(0.0, &mut state).unwrap_err();
    assert_eq!((state, error), (rest, ProjectionError { iterations: 1, residual: 4.0 }));
    let nan = MarbleState { x_dot: f64::NAN, ..rest };
    state = nan;
    let error = MARBLE.project(0.0, &mut state).unwrap_err();
    assert!(state.x_dot.is_nan() && error.residual.is_nan(), "{error:?}");
}

/// The largest residual of a run of 10⁵ steps, and what became of the energy.
fn long_run<M: nonholonomic::Method<SnakeboardOnThePlane>>(method: M) -> (f64, f64, Statistics) {
    let mut start = SnakeboardOnThePlaneState {
        phi: 0.4,
        x_dot: 1.0,
        y_dot: 0.2,
        psi_dot: 0.7,
        phi_dot: 0.0,
        ..SnakeboardOnThePlaneState::default()
    };
    BOARD.project(0.0, &mut start).unwrap();
    let energy = BOARD.energy(0.0, &start);
    let mut sim = Integrator::new(BOARD, method, 0.0, start);
    for _ in 0..100_000 {
        sim.step().unwrap();
    }
    let residual = largest(&residuals(&BOARD, sim.time(), sim.state()));
    (residual, BOARD.energy(sim.time(), sim.state()) / energy - 1.0, sim.statistics())
}

#[test]
fn a_long_run_stays_on_the_constraints_only_if_projected() {
    let step = 0.02;
    let (drift, energy, _) = long_run(Rk4::new(step));
    println!("without: residual {drift:e}, energy {energy:e}");
    for every in [1, 10, 1000] {
        let (residual, energy, statistics) = long_run(Projected::new(Rk4::new(step), every));
        println!("every {every}: residual {residual:e}, energy {energy:e}, {statistics:?}");
        assert!(residual < 1e-14 && residual < 1e-2 * drift, "{residual:e} against {drift:e}");
        assert_eq!(statistics.projections, 100_000 / u64::from(every));
        assert!(statistics.largest_correction < 1e-3);
    }
}

#[test]
fn a_nonlinear_constraint_is_kept_in_a_long_run() {
    let start = MarbleState { x_dot: 1.2, y_dot: 1.6, ..MarbleState::default() };
    let mut drifting = Integrator::new(MARBLE, Rk4::new(0.01), 0.0, start);
    let mut sim = Integrator::new(MARBLE, Projected::new(Rk4::new(0.01), 5), 0.0, start);
    for _ in 0..100_000 {
        drifting.step().unwrap();
        sim.step().unwrap();
    }
    let [drift, left] =
        [drifting.state(), sim.state()].map(|x| MARBLE.constraint_residual(0.0, x).speed.abs());
    println!("without {drift:e}, with {left:e}, {:?}", sim.statistics());
    assert!(left < 1e-14 && left < drift, "{left:e} {drift:e}");
}

//! A pendulum in x and y, beside the one in its angle.

use nonholonomic::prelude::*;
use nonholonomic::{D, IntegrationError, Method};

#[nonholonomic(
    base { x, y }
    holonomic { rope: x^2 + y^2 = l^2; }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - m * g * y }
    emit { multipliers, reactions }
)]
#[derive(Clone, Copy, Debug)]
struct InThePlane {
    m: f64,
    l: f64,
    g: f64,
}

#[nonholonomic(
    base { theta }
    lagrangian { m * l^2 / 2 * der(theta)^2 + m * g * l * cos(theta) }
)]
#[derive(Clone, Copy, Debug)]
struct ByItsAngle {
    m: f64,
    l: f64,
    g: f64,
}

const PLANE: InThePlane = InThePlane { m: 2.0, l: 1.5, g: 9.81 };
const ANGLE: ByItsAngle = ByItsAngle { m: 2.0, l: 1.5, g: 9.81 };

/// The place and velocity of an angle from the vertical.
fn at(ByItsAngleState { theta, theta_dot }: ByItsAngleState) -> InThePlaneState {
    let (sin, cos) = theta.sin_cos();
    let l = PLANE.l;
    InThePlaneState { x: l * sin, y: -l * cos, x_dot: l * cos * theta_dot, y_dot: l * sin * theta_dot }
}

const START: ByItsAngleState = ByItsAngleState { theta: 2.5, theta_dot: 0.7 };

#[test]
fn accelerations_and_the_force_of_the_rope() {
    let state = at(START);
    let (found, angle) = (PLANE.derivative(0.0, &state, &()), ANGLE.derivative(0.0, &START, &()));
    let (sin, cos) = START.theta.sin_cos();
    let (w, l) = (START.theta_dot, PLANE.l);
    let expected = [l * (cos * angle.theta_dot - sin * w * w), l * (sin * angle.theta_dot + cos * w * w)];
    assert!((found.x_dot - expected[0]).abs() < 1e-13 && (found.y_dot - expected[1]).abs() < 1e-13);
    // m (l θ'² + g cos θ) along the rope, towards the pivot; ∂f = 2 (x, y)
    let tension = PLANE.m * (l * w * w + PLANE.g * cos);
    let lambda = PLANE.multipliers(0.0, &state, &()).rope;
    assert!((lambda + tension / (2.0 * l)).abs() < 1e-13);
    let reactions = PLANE.reactions(0.0, &state, &());
    assert!((reactions.x_dot + tension * sin).abs() < 1e-13);
}

/// How far the rope is from its length, and the velocity from a tangent, in units of round-off.
fn is_on_the_circle(state: &InThePlaneState) {
    let left = PLANE.constraint_residual(0.0, state);
    assert!(left.rope.abs() < 2e-15 && left.rope_dot.abs() < 2e-14, "{left:?}");
}

/// A run with returns, at its end, within its last step and in its statistics.
fn stays_on_the_circle<M: Method<InThePlane> + Copy>(method: M, accuracy: f64) {
    let mut sim = Integrator::new(PLANE, method, 0.0, at(START));
    let mut exact = Integrator::new(ANGLE, Dop853::new().rtol(1e-13).atol(1e-13), 0.0, START);
    for time in [0.5, 1.0, 3.0] {
        sim.advance_to(time).unwrap();
        exact.advance_to(time).unwrap();
        is_on_the_circle(sim.state());
        let expected = at(*exact.state());
        let apart = (sim.state().x - expected.x).hypot(sim.state().y - expected.y);
        assert!(apart < accuracy, "{apart:e}");
    }
    sim.step().unwrap();
    let middle = sim.at(0.5 * (3.0 + sim.time())).unwrap();
    is_on_the_circle(&middle);
    let statistics = sim.statistics();
    assert_eq!(statistics.projections, statistics.steps);
    assert!(statistics.largest_correction > 0.0);
    // left alone, the same run leaves the circle
    let mut alone = Integrator::new(PLANE, method, 0.0, at(START)).without_return();
    alone.advance_to(3.0).unwrap();
    assert_eq!(alone.statistics().projections, 0);
    assert!(PLANE.constraint_residual(0.0, alone.state()).rope.abs() > 1e-14);
}

#[test]
fn runs_of_all_kinds_of_methods_stay_on_the_circle() {
    stays_on_the_circle(Dopri5::new().rtol(1e-8).atol(1e-8), 1e-6);
    stays_on_the_circle(Dop853::new().rtol(1e-8).atol(1e-8), 1e-6);
    stays_on_the_circle(Bs23::new().rtol(1e-6).atol(1e-6), 1e-3);
    stays_on_the_circle(Rk4::new(0.01), 1e-5);
    stays_on_the_circle(Radau5::new().rtol(1e-8).atol(1e-8), 1e-5);
    stays_on_the_circle(Rodas5P::new().rtol(1e-8).atol(1e-8), 1e-5);
    stays_on_the_circle(GaussLegendre4::new(0.01), 1e-5);
    stays_on_the_circle(ImplicitMidpoint::new(0.001), 1e-3);
}

#[test]
fn events_happen_on_the_circle() {
    let method = Dopri5::new().rtol(1e-6).atol(1e-6);
    let mut sim = Integrator::new(PLANE, method, 0.0, at(START));
    let events = Events::new(|_, state: &InThePlaneState, &()| [state.x]);
    let event = sim.advance_until(10.0, &events).unwrap().expect("it swings through the vertical");
    is_on_the_circle(&event.state);
    assert!(
        event.state.x.abs() < 1e-14 && (event.state.y.abs() - PLANE.l).abs() < 1e-14,
        "{:?}",
        event.state
    );
}

#[test]
fn a_start_off_the_circle_is_refused_and_projected() {
    let method = Dopri5::new().rtol(1e-6).atol(1e-6);
    let mut state = InThePlaneState { x: 0.9, y: -1.2, x_dot: 0.4, y_dot: 0.1 };
    state.y -= 0.01;
    let mut sim = Integrator::new(PLANE, method, 0.0, state);
    let error = sim.advance_to(1.0).unwrap_err();
    assert!(matches!(error, IntegrationError::OffConstraints { constraint: "rope_dot", .. }), "{error:?}");
    let text = error.to_string();
    assert!(text.contains("in `rope_dot`") && text.contains("`project` or `assemble` it first"), "{text}");
    PLANE.project(0.0, &mut state).unwrap();
    is_on_the_circle(&state);
    // the nearest point of the circle, as the mass is the same in both directions
    let radius = 0.9_f64.hypot(1.21);
    assert!((state.x - 0.9 * 1.5 / radius).abs() < 1e-15 && (state.y + 1.21 * 1.5 / radius).abs() < 1e-15);
    let mut sim = Integrator::new(PLANE, method, 0.0, state);
    sim.advance_to(1.0).unwrap();
    // there is no nearest point to the middle of the circle
    let mut middle = InThePlaneState::default();
    assert!(PLANE.project(0.0, &mut middle).is_err());
    assert_eq!(middle, InThePlaneState::default());
}

#[test]
fn a_pure_step_makes_one_correction() {
    let next = Rk4::step(&PLANE, 0.0, 0.05, &at(START), &());
    let left = PLANE.constraint_residual(0.0, &next);
    assert!(left.rope.abs() < 1e-10 && left.rope_dot.abs() < 1e-14, "{left:?}");
}

#[test]
fn residuals_are_those_of_the_trait() {
    fn count<S: Constrained<Constraints = D<2>>>(system: &S, state: &S::State) -> [f64; 2]
    where
        S::State: State<Scalar = f64>,
    {
        system.constraint_residual(0.0, state)
    }
    let [rope, rate] = count(&PLANE, &InThePlaneState { x: 2.0, y: 0.0, x_dot: 3.0, y_dot: 1.0 });
    assert!((rope - 1.75).abs() < 1e-15 && (rate - 12.0).abs() < 1e-14, "{rope} {rate}");
}

//! Where constraints become dependent at isolated configurations: integrators stop with an error
//! that says where, or get past, and no state is ever infinite or not a number.

use nh_tests::systems::snakeboard::{
    Snakeboard, SnakeboardOnThePlane, SnakeboardOnThePlaneState, SnakeboardState,
};
use nonholonomic::Method;
use nonholonomic::prelude::*;

/// A particle that moves on a ray through the origin, where its constraint has no direction, and is
/// pulled off the ray.
#[nonholonomic(
    base { x, y }
    formulation { projected }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 - y) }
    constraints { ray: x * der(y) = y * der(x); }
)]
#[derive(Clone, Copy, Debug)]
struct Ray {
    m: f64,
}

/// A mass on a linkage that locks: at x = 0 the kinetic energy on the constraint vanishes.
#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * x^2 * der(x)^2 + m / 2 * der(y)^2 - m * g * x }
    constraints { link: der(y) = x * der(x); }
)]
#[derive(Clone, Copy, Debug)]
struct Linkage {
    m: f64,
    g: f64,
}

/// Integrates, and checks that what is left is good whatever came of it.
fn driven<S, M>(
    system: S,
    method: M,
    start: S::State,
    end: f64,
) -> (Result<(), IntegrationError>, f64, S::State)
where
    S: Dynamics<State: State<Scalar = f64>>,
    M: Method<S>,
{
    let mut sim = Integrator::new(system, method, 0.0, start).max_steps(200_000);
    let result = sim.advance_to(end);
    assert!(sim.state().to_array().as_ref().iter().all(|x| x.is_finite()), "{result:?}");
    assert!(sim.time().is_finite() && sim.time() <= end);
    let here = sim.time();
    assert!(sim.at(here).is_ok());
    (result, sim.time(), *sim.state())
}

#[test]
fn a_step_onto_the_singular_point_is_an_error_with_its_place() {
    let start = RayState { x: -1.0, x_dot: 1.0, ..RayState::default() };
    // the grid of steps meets the origin
    let (result, time, state) = driven(Ray { m: 1.0 }, Rk4::new(0.25), start, 3.0);
    let error = result.unwrap_err();
    let IntegrationError::NonFiniteDerivative { component, time: at, value } = error else {
        panic!("{error:?}");
    };
    assert!(component.ends_with("_dot") && !value.is_finite() && (0.75..=1.0).contains(&at), "{error:?}");
    assert!(time < 1.0 && state.x < 0.0, "{time} {state:?}");
    assert!(
        error.to_string().contains("where the mass matrix or the constraints may be singular"),
        "{error}"
    );
    for projected in [1, 3] {
        let method = Projected::new(Rk4::new(0.25), projected);
        let error = driven(Ray { m: 1.0 }, method, start, 3.0).0.unwrap_err();
        assert!(matches!(error, IntegrationError::NonFiniteDerivative { .. }), "{error:?}");
    }
    // an adaptive method steps over it: the force of the constraint is constant
    let (result, _, state) = driven(Ray { m: 1.0 }, Dopri5::new().rtol(1e-9), start, 3.0);
    result.unwrap();
    assert!((state.x - 2.0).abs() < 1e-6 && state.y.abs() < 1e-6, "{state:?}");
}

#[test]
fn a_start_at_the_singular_point_is_an_error() {
    let start = RayState { x_dot: 1.0, ..RayState::default() };
    let ray = Ray { m: 1.0 };
    for result in [
        driven(ray, Rk4::new(0.1), start, 1.0).0,
        driven(ray, Dopri5::new(), start, 1.0).0,
        driven(ray, ImplicitMidpoint::new(0.1), RayState::default(), 1.0).0,
    ] {
        let error = result.unwrap_err();
        assert!(matches!(error, IntegrationError::NonFiniteDerivative { .. }), "{error:?}");
    }
}

#[test]
fn a_mass_matrix_that_vanishes_stops_adaptive_methods_there() {
    // from x = 1 downwards: the inertia 2 m x² goes to zero, the acceleration to infinity
    let start = LinkageState { x: 1.0, ..LinkageState::default() };
    let linkage = Linkage { m: 1.0, g: 1.0 };
    let (result, time, state) = driven(linkage, Dopri5::new().rtol(1e-8), start, 10.0);
    let error = result.unwrap_err();
    println!("{error}\n{time} {state:?}");
    assert!(
        matches!(
            error,
            IntegrationError::StepUnderflow { .. }
                | IntegrationError::NonFiniteDerivative { .. }
                | IntegrationError::NonFiniteStep { .. }
        ),
        "{error:?}"
    );
    assert!(state.x.abs() < 1e-2, "{state:?}");
    let _ = driven(linkage, Rk4::new(1e-3), start, 10.0);
    let _ = driven(linkage, ImplicitMidpoint::new(1e-3), start, 10.0);
}

#[test]
fn a_snakeboard_is_driven_through_a_quarter_turn() {
    use std::f64::consts::{FRAC_PI_2, PI};
    let board = SnakeboardOnThePlane { m: 6.0, l: 0.3, J0: 0.16, J1: 0.04 };
    let adapted = Snakeboard { m: 6.0, l: 0.3, J0: 0.16, J1: 0.04, Ar: 0.0, wr: 1.0, As: 0.0, ws: 1.0 };
    for (u1, phi_dot) in [(0.0, 1.0), (0.4, 1.0), (-0.3, 2.5), (1e-8, 0.3)] {
        // off the grid of steps, and exactly on it
        for phi in [FRAC_PI_2 - 0.77, FRAC_PI_2 - phi_dot] {
            let mut start = SnakeboardOnThePlaneState {
                phi,
                phi_dot,
                x_dot: u1,
                psi_dot: 0.8,
                ..SnakeboardOnThePlaneState::default()
            };
            board.project(0.0, &mut start).unwrap();
            let free = SnakeboardState { phi, u1, dphi: phi_dot, dpsi: 0.8, ..SnakeboardState::default() };
            let results = [
                driven(board, Rk4::new(1.0 / 64.0), start, 4.0).0,
                driven(board, Projected::new(Rk4::new(1.0 / 64.0), 1), start, 4.0).0,
                driven(board, Dopri5::new().rtol(1e-8), start, 4.0).0,
                driven(board, Projected::new(Dopri5::new().rtol(1e-8), 5), start, 4.0).0,
                driven(board, ImplicitMidpoint::new(1.0 / 64.0), start, 4.0).0,
                driven(adapted, Rk4::new(1.0 / 64.0), free, 4.0).0,
                driven(adapted, Dopri5::new().rtol(1e-8), free, 4.0).0,
            ];
            // phi moves at a constant rate, so that the times of the quarter turns are known
            let quarter = |t: f64| ((t - (FRAC_PI_2 - phi) / phi_dot) * phi_dot / PI).rem_euclid(1.0);
            for error in results.into_iter().filter_map(Result::err) {
                let (IntegrationError::NonFiniteDerivative { time, .. }
                | IntegrationError::StepUnderflow { time, .. }
                | IntegrationError::NoConvergence { time, .. }
                | IntegrationError::Projection { time, .. }) = error
                else {
                    panic!("{error:?}");
                };
                let turn = quarter(time);
                assert!(turn.min(1.0 - turn) < 0.02, "{turn} {error:?}");
            }
        }
    }
}

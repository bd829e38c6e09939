//! Every kind of error: when it comes, what it says, and that the integration can go on.

use nonholonomic::prelude::*;
use nonholonomic::{InputFault, Method, ParameterFault, StateFault};

use crate::systems::{Driven, Line, Pendulum, Plane, Scalar1, Stiff, Torque};

const START: Plane<f64> = Plane { q: 1.0, p: 0.0 };

fn pendulum<M: Method<Pendulum<f64>>>(g: f64, method: M) -> Integrator<Pendulum<f64>, M> {
    Integrator::new(Pendulum { g }, method, 0.0, START)
}

#[test]
fn parameters_are_validated_before_the_first_step() {
    let error = pendulum(f64::NAN, Rk4::new(0.1)).step().unwrap_err();
    assert_eq!(
        error.to_string(),
        "the parameter `g` is NaN, but parameters have to be finite: check how it is computed"
    );
    let mut sim = pendulum(-2.0, Dopri5::new());
    let error = sim.advance_to(1.0).unwrap_err();
    assert_eq!(
        error.to_string(),
        "the parameter `g` is -2.0, but the declaration assumes `g > 0`: give a value that satisfies it, \
         or change the assumption"
    );
    assert!(std::error::Error::source(&error).is_some());
    assert_eq!((*sim.state(), sim.time()), (START, 0.0));
    let pivot = ParameterError {
        parameter: "J",
        value: 0.0,
        fault: ParameterFault::ZeroPivot { expression: "J + m a^2" },
    };
    assert_eq!(
        pivot.to_string(),
        "the parameter `J` is 0.0, but the equations divide by `J + m a^2`, which it makes zero: give \
         another value, or choose other velocities with `independent { … }`"
    );
}

#[test]
fn settings_are_checked() {
    let text = |error: Result<(), IntegrationError>| error.unwrap_err().to_string();
    let step = "but has to be positive and finite; the target says whether time goes forwards or backwards";
    assert_eq!(
        text(pendulum(1.0, Rk4::new(-0.1)).step()),
        format!("the setting `step` of the method is -0.1, {step}")
    );
    assert_eq!(
        text(pendulum(1.0, Euler::new(0.0)).step()),
        format!("the setting `step` of the method is 0.0, {step}")
    );
    assert_eq!(
        text(pendulum(1.0, ImplicitMidpoint::new(f64::NAN)).advance_to(1.0)),
        format!("the setting `step` of the method is NaN, {step}")
    );
    assert_eq!(
        text(pendulum(1.0, Dopri5::new().atol(-1.0)).step()),
        "the setting `atol` of the method is -1.0, but has to be finite and not negative"
    );
    assert_eq!(
        text(pendulum(1.0, Dopri5::new().max_step(0.0)).step()),
        "the setting `max_step` of the method is 0.0, but has to be positive and finite"
    );
}

#[test]
fn what_is_given_has_to_be_finite() {
    let mut sim = pendulum(1.0, Dopri5::new());
    let error = sim.advance_to(f64::NAN).unwrap_err();
    assert_eq!(error.to_string(), "the time NaN cannot be reached: times have to be finite");

    sim.set_input(Torque { torque: f64::INFINITY });
    let error = sim.step().unwrap_err();
    assert_eq!(error, IntegrationError::Input(InputFault { input: "torque", value: f64::INFINITY }));
    assert_eq!(error.to_string(), "the input `torque` is inf: give finite numbers");
    assert_eq!(sim.step().unwrap_err(), error);
    sim.set_input(Torque { torque: 1.0 });
    sim.step().unwrap();

    sim.reset(0.0, Plane { q: 0.0, p: f64::NAN });
    let error = sim.step().unwrap_err();
    assert_eq!(error.to_string(), "the component `p` of the given state is NaN: give finite numbers");
    sim.reset(f64::INFINITY, START);
    assert!(matches!(sim.step(), Err(IntegrationError::NonFiniteTime { .. })));
    sim.reset(0.0, Plane { q: 1e3, p: 0.0 });
    let error = sim.step().unwrap_err();
    assert_eq!(error, IntegrationError::InvalidState(StateFault { identity: "q = 0", residual: 1e3 }));
    assert_eq!(error.to_string(), "the given state does not satisfy `q = 0`, by 1000.0: normalize it first");
    sim.reset(0.0, START);
    sim.advance_to(1.0).unwrap();
}

/// √(1 − t): not a number after t = 1.
fn root(t: f64, _x: f64, _u: f64) -> f64 {
    (1.0 - t).sqrt()
}

#[test]
fn a_derivative_that_is_not_finite_stops_every_method() {
    fn check<M: Method<Scalar1>>(method: M, tolerance: f64) -> IntegrationError {
        let mut sim = Integrator::new(Scalar1(root), method, 0.0, Line { x: 0.0 });
        let error = sim.advance_to(2.0).unwrap_err();
        assert!((sim.time() - 1.0).abs() < tolerance, "{:?}", sim.time());
        assert!((sim.state().x - 2.0 / 3.0).abs() < tolerance, "{:?}", sim.state());
        // and it goes on from there, backwards
        sim.advance_to(0.5).unwrap();
        error
    }
    let error = check(Dopri5::new(), 1e-5);
    assert!(
        matches!(
            error,
            IntegrationError::NonFiniteDerivative { component: "x", time, value } if time >= 1.0 && value.is_nan()
        ),
        "{error}"
    );
    check(Rk4::new(0.01), 0.02);
    check(ImplicitMidpoint::new(0.01), 0.02);

    let mut sim = Integrator::new(Scalar1(root), Rk4::new(0.5), 1.5, Line { x: 0.0 });
    assert_eq!(
        sim.step().unwrap_err().to_string(),
        "the derivative of `x` is NaN at t = 1.5, where the mass matrix or the constraints may be singular: \
         look at the last good state, and at inputs and parameters"
    );
}

/// However far the target is, a run that fails on its way costs no more than a few times the steps that it has taken, and
/// statistics count what was evaluated.
#[test]
fn a_run_that_fails_is_not_repeated_for_each_of_its_steps() {
    thread_local!(static CALLS: std::cell::Cell<u64> = const { std::cell::Cell::new(0) });
    for (failing, steps) in
        [(1.0, 2_u32), (37.0, 38), (499.5, 500), (996.5, 997), (997.0, 998), (998.5, 999), (1000.0, 1000)]
    {
        for target in [1000.0, -1000.0] {
            let system = Scalar1(|t, x, limit| {
                CALLS.set(CALLS.get() + 1);
                if t.abs() > limit { f64::NAN } else { x * 0.0 + 1.0 }
            });
            CALLS.set(0);
            let mut sim = Integrator::new(system, Euler::new(1.0), 0.0, Line { x: 0.0 });
            sim.set_input(Torque { torque: failing });
            assert_eq!(sim.advance_to(target).is_err(), steps < 1000, "{failing}");
            let reached = f64::from(steps).copysign(target);
            assert_eq!((sim.time(), sim.state().x), (reached, reached), "{failing} {target}");
            let (counted, calls) = (sim.statistics(), CALLS.get());
            let few = 4 * u64::from(steps) + 200;
            assert!(counted.steps == u64::from(steps) && calls <= few, "{failing}: {calls} {counted:?}");
            // one more to explain what has happened
            assert!(calls - counted.evaluations <= 2, "{failing}: {calls} {counted:?}");
            // and the last step is that of the length of one, however it was found
            let from = reached - 1.0_f64.copysign(target);
            assert_eq!(sim.at(from), Ok(Line { x: from }), "{failing}");
            assert!(sim.at(from - 0.25_f64.copysign(target)).is_err(), "{failing}");
        }
    }
}

#[test]
fn a_stage_cannot_hide_a_nan() {
    // not a number at the third stage of the first attempt, and blind to NaN in the state
    let system =
        Scalar1(|t, x, _| if (t - 0.3).abs() < 1e-12 { f64::NAN } else { f64::max(x, 0.0) * 0.0 + 1.0 });
    let mut sim = Integrator::new(system, Dopri5::new().first_step(1.0), 0.0, Line { x: 0.0 });
    sim.step().unwrap();
    assert!(sim.statistics().rejected >= 1);
    assert!((sim.state().x - sim.time()).abs() < 1e-14);
}

#[test]
fn blow_up_underflows_the_step() {
    let mut sim = Integrator::new(Scalar1(|_, x, _| x * x), Dopri5::new(), 0.0, Line { x: 1.0 });
    let error = sim.advance_to(2.0).unwrap_err();
    assert!(matches!(
        error,
        IntegrationError::StepUnderflow { .. }
            | IntegrationError::NonFiniteStep { .. }
            | IntegrationError::NonFiniteDerivative { .. }
    ));
    assert!((sim.time() - 1.0).abs() < 1e-4 && sim.state().x.is_finite());
    let error = IntegrationError::StepUnderflow { time: 1.0, step: 1e-16, error: 3.5 };
    assert_eq!(
        error.to_string(),
        "at t = 1.0 a step of length 1e-16 still has 3.5 times the permitted error, and the time \
         resolves no shorter one: the solution, the mass matrix or the constraints may be singular near \
         there, or the tolerance too small"
    );
    let error = IntegrationError::StepUnderflow { time: 1.0, step: 1e-16, error: f64::NAN };
    assert_eq!(
        error.to_string(),
        "at t = 1.0 a step of length 1e-16 still leads to numbers that are not finite, and the time resolves \
         no shorter one: the solution, the mass matrix or the constraints may be singular near there"
    );
    let error = IntegrationError::NoConvergence { time: 1.0, step: 0.1, iterations: 2, residual: f64::NAN };
    assert_eq!(
        error.to_string(),
        "the step of length 0.1 from t = 1.0 was not solved: its corrections were no longer finite after 2 \
         iterations: take a smaller step"
    );
}

#[test]
fn a_jump_underflows_the_step() {
    let system = Scalar1(|t, _, _| if t < 1.0 { 0.0 } else { 1e20 });
    let mut sim = Integrator::new(system, Dopri5::new().rtol(1e-12), 0.0, Line { x: 1.0 });
    let error = sim.advance_to(2.0).unwrap_err();
    assert!(
        matches!(error, IntegrationError::StepUnderflow { time, error, .. } if (time - 1.0).abs() < 1e-12 && error > 1.0),
        "{error}"
    );
    // with a new state beyond the jump it goes on
    sim.reset(1.0, Line { x: 0.0 });
    sim.advance_to(2.0).unwrap();
}

#[test]
fn a_step_to_infinity_is_named() {
    let mut sim = Integrator::new(Scalar1(|_, _, _| 1e308), Euler::new(10.0), 0.0, Line { x: 1e308 });
    assert_eq!(
        sim.step().unwrap_err().to_string(),
        "the step of length 10.0 from t = 0.0 makes `x` infinite: the solution grows too fast, take a \
         smaller step"
    );
    assert_eq!(sim.state().x, 1e308);
}

#[test]
fn an_equation_without_solution_does_not_converge() {
    // x₁ = 1 + h ((1 + x₁)/2)² has no real solution for h > 1/4 · 4/(1 + 1)
    let mut sim = Integrator::new(Scalar1(|_, x, _| x * x), ImplicitMidpoint::new(2.0), 0.0, Line { x: 1.0 });
    let error = sim.step().unwrap_err();
    assert!(
        matches!(error, IntegrationError::NoConvergence { time: 0.0, step: 2.0, iterations: 50, .. }),
        "{error}"
    );
    assert_eq!(sim.state().x, 1.0);
    let error = IntegrationError::NoConvergence { time: 0.0, step: 2.0, iterations: 50, residual: 7.0 };
    assert_eq!(
        error.to_string(),
        "the step of length 2.0 from t = 0.0 was not solved in 50 iterations, the last correction being \
         7.0 times the tolerance: take a smaller step"
    );
}

#[test]
fn the_number_of_steps_is_limited() {
    let mut sim = Integrator::new(Stiff { rate: 1e6 }, Dopri5::new(), 0.0, Line { x: 1.0 }).max_steps(100);
    let error = sim.advance_to(1e3).unwrap_err();
    let IntegrationError::TooManySteps { time, target: 1e3, limit: 100 } = error else {
        panic!("{error}");
    };
    assert_eq!(
        error.to_string(),
        format!(
            "100 steps have led to t = {time:?} and not to 1000.0: permit more with `max_steps`, take \
             longer steps, or an implicit method if the system is stiff"
        )
    );
    assert_eq!((sim.time(), sim.statistics().steps), (time, 100));
    sim.advance_to(time * 1.01).unwrap();
}

#[test]
fn the_outside_of_the_last_step_is_refused() {
    let mut sim = Integrator::new(Driven, Rk4::new(0.5), 0.0, START);
    sim.step().unwrap();
    assert_eq!(
        sim.at(0.75).unwrap_err().to_string(),
        "there is no state at t = 0.75, since the last step went from 0.0 to 0.5: ask within it"
    );
}

/// A system with position constraints, and with a side at the start and one afterwards.
struct Sided([f64; 2]);

impl Dynamics for Sided {
    type State = Plane<f64>;
    type Input = ();
    fn derivative(&self, _t: f64, _state: &Plane<f64>, (): &()) -> Plane<f64> {
        Plane { q: 1.0, p: 0.0 }
    }
    fn has_positions(&self) -> bool {
        true
    }
    fn side(&self, t: f64, _state: &Plane<f64>) -> f64 {
        let Self([before, after]) = *self;
        if t == 0.0 { before } else { after }
    }
}

/// Sides are compared by their signs, however small the numbers are, and what is not a number is on neither side.
#[test]
fn a_step_that_changes_sides_is_refused() {
    let stepped = |sides| {
        let mut sim = Integrator::new(Sided(sides), Rk4::new(0.1), 0.0, Plane { q: 0.0, p: 0.0 });
        sim.step()
    };
    for sides in [[1.0, -1.0], [1e-200, -1e-200], [-1e-200, 1e-200], [1.0, f64::NAN], [f64::NAN, 1.0]] {
        let refused = stepped(sides);
        assert!(matches!(refused, Err(IntegrationError::DeadCentre { .. })), "{sides:?}: {refused:?}");
    }
    for sides in [[1.0, 1.0], [1e-200, 2e-200], [-1e-300, -1e300], [1.0, 0.0], [0.0, -1.0]] {
        assert_eq!(stepped(sides), Ok(()), "{sides:?}");
    }
}

//! Every method of the runtime, with events, dense output and a new start, and every building block of a
//! controller leave the heap alone, from set-up to the last step.
#![allow(non_snake_case, reason = "parameters are written as in mechanics")]

use std::hint::black_box;
use std::ops::ControlFlow;

use nalgebra::{Matrix1, Matrix4, RowVector4, SVector, Vector1, Vector4, Vector5};
use nonholonomic::control::{
    Estimate, Ilqr, Quadratic, Regulator, Sampled, Unscented, held_noise, shooting_cost, shooting_gradient,
    zero_order_hold,
};
use nonholonomic::methods::Method;
use nonholonomic::prelude::*;
use nonholonomic::sensitivity::{
    Adjoint, By, Checkpoint, ColumnTolerance, Jumps, Objective, Slope, Variational, advance_across,
};

/// McLachlan and Perlmutter's contact oscillator, with all that a method may ask for in a basis of D.
#[nonholonomic(
    base { x, y, z }
    lagrangian { (der(x)^2 + der(y)^2 + der(z)^2) / 2 - (x^2 + y^2 + z^2) / 2 - epsilon / 2 * x^2 * z^2 }
    constraints { der(x) = -y * der(z); }
    emit { discrete_gradient, jacobian, taylor }
)]
#[derive(Clone, Copy, Debug)]
struct Contact<T> {
    epsilon: T,
}

/// The same on TQ.
#[nonholonomic(
    base { x, y, z }
    lagrangian { (der(x)^2 + der(y)^2 + der(z)^2) / 2 - (x^2 + y^2 + z^2) / 2 - epsilon / 2 * x^2 * z^2 }
    constraints { der(x) = -y * der(z); }
    formulation { projected }
    conserved { total = (der(x)^2 + der(y)^2 + der(z)^2) / 2 + (x^2 + y^2 + z^2) / 2 + epsilon / 2 * x^2 * z^2; }
    emit { leapfrog, invariants }
)]
#[derive(Clone, Copy, Debug)]
struct ContactOnTq {
    epsilon: f64,
}

/// Suslov's problem.
#[nonholonomic(
    basis { w[3] }
    brackets so(3) { w }
    lagrangian { sum(i in 0..3: I[i] * w[i]^2) / 2 }
    constraints { w[2] = k * w[0]; }
    emit { euler_poincare_suslov }
)]
#[derive(Clone, Copy, Debug)]
struct Suslov {
    I: [f64; 3],
    k: f64,
}

/// A sleigh that is driven.
#[nonholonomic(
    base   { theta, x, y }
    basis  { omega, v1, v2 }
    anchor {
        der(theta) = omega;
        der(x) = v1 * cos(theta) - v2 * sin(theta);
        der(y) = v1 * sin(theta) + v2 * cos(theta);
    }
    lagrangian  { (J + m * a^2) / 2 * omega^2 + m / 2 * (v1^2 + v2^2) + m * a * omega * v2 }
    constraints { v2 = 0; }
    forces      { omega: torque; }
    inputs      { torque }
    emit        { jacobian, parameter_jacobian }
)]
#[derive(Clone, Copy, Debug)]
struct Sleigh {
    m: f64,
    J: f64,
    a: f64,
}

const CONTACT: Contact<f64> = Contact { epsilon: 0.3 };
/// A mass on a rod.
#[nonholonomic(
    base { x, y }
    holonomic { rod: x^2 + y^2 = 1; }
    lagrangian { (der(x)^2 + der(y)^2) / 2 - g * y }
    emit { discrete_gradient, rattle, symmetric_projection }
)]
#[derive(Clone, Copy, Debug)]
struct Rod {
    g: f64,
}

const ON_TQ: ContactOnTq = ContactOnTq { epsilon: 0.3 };
const SUSLOV: Suslov = Suslov { I: [1.0, 2.0, 3.0], k: 0.7 };
const SLEIGH: Sleigh = Sleigh { m: 1.0, J: 0.5, a: 0.3 };

/// Asserts that a piece of work succeeds and allocates nothing.
fn assert_quiet<E: std::fmt::Debug>(what: &str, mut work: impl FnMut() -> Result<(), E>) {
    let mut outcome = Ok(());
    let allocations = allocation_counter::measure(|| outcome = work()).count_total;
    assert!(outcome.is_ok(), "{what}: {outcome:?}");
    assert_eq!(allocations, 0, "{what}");
}

/// All that an integrator can be asked for: steps, stops, states within steps, events, a new start, time
/// backwards, and a state that it refuses.
fn life<S, M>(system: S, start: S::State, method: M) -> Result<(), IntegrationError>
where
    S: Dynamics<Input = ()> + Clone,
    S::State: State<Scalar: Real>,
    M: Method<S> + Clone,
{
    let number = |x: f64| <S::State as State>::Scalar::from_f64(x);
    let first = |state: &S::State| state.to_array().as_ref().first().copied().unwrap_or(number(0.0));
    let mut sim = Integrator::new(system, method, number(0.0), start);
    sim.step()?;
    black_box(sim.at(sim.time() * number(0.5))?);
    sim.advance_to(number(1.0))?;
    sim.sample([number(1.1), number(1.2)], |_, state| _ = black_box(first(state)))?;
    sim.advance_through([number(1.3), number(1.4)], |sim| sim.set_input(()))?;
    let level = first(sim.state());
    sim.reset(number(0.0), start);
    let events = Events::new(|t, state: &S::State, (): &()| [first(state) - level, t - number(0.77)]);
    let event = sim.advance_until(number(2.0), &events)?;
    assert!(event.is_some(), "the time is an event");
    sim.advance_watching(number(2.0), &events, |event| {
        black_box(event);
        ControlFlow::Continue(())
    })?;
    sim.advance_to(number(-0.5))?;
    black_box((sim.statistics(), sim.clone().state()));
    let mut broken = start.to_array();
    broken.as_mut().fill(number(f64::NAN));
    sim.reset(number(0.0), S::State::from_array(broken));
    assert!(sim.step().is_err(), "a state that is no number");
    Ok(())
}

/// A life of each of these methods.
macro_rules! assert_quiet_lives {
    ($system:expr, $start:expr; $($method:expr),* $(,)?) => {
        $(assert_quiet(stringify!($method), || life($system, $start, $method));)*
    };
}

fn contact() -> ContactState<f64> {
    ContactState { x: 0.3, y: 0.5, z: 0.4, y_dot: 1.0, z_dot: 0.8 }
}

#[test]
fn explicit_methods() {
    assert_quiet_lives! { CONTACT, contact();
        Euler::new(0.02), Heun::new(0.02), Ralston::new(0.02), Rk4::new(0.02), Rk4::new(0.02).compensated(),
        Bs23::fixed(0.02), Dopri5::fixed(0.02), Tsit5::fixed(0.02), Dop853::fixed(0.02), Vern9::fixed(0.02),
        Bs23::new(), Dopri5::new(), Tsit5::new(), Dop853::new(), Vern9::new(), Taylor::<f64>::new(),
        Taylor::<f64>::new().rtol(1e-15), Dopri5::new().tolerances(contact(), contact()),
    }
}

#[test]
fn implicit_methods() {
    assert_quiet_lives! { CONTACT, contact();
        ImplicitMidpoint::new(0.02), ImplicitMidpoint::new(0.02).with_jacobian(),
        ImplicitMidpoint::new(0.02).fourth_order(), ImplicitMidpoint::new(0.02).sixth_order(),
        GaussLegendre4::new(0.02), GaussLegendre4::new(0.02).with_jacobian(),
        GaussLegendre6::new(0.02), GaussLegendre6::new(0.02).with_jacobian(),
        Radau5::new(), Radau5::new().with_jacobian(), Rodas5P::new(), Rodas5P::new().with_jacobian(), Auto::new(),
    }
}

#[test]
fn methods_that_keep_structure() {
    assert_quiet_lives! { CONTACT, contact();
        DiscreteGradient::new(0.05), DiscreteGradient::new(0.05).with_jacobian(),
        DiscreteGradient::new(0.05).compensated(), DiscreteGradient::new(0.05).fourth_order(),
        DiscreteGradient::new(0.05).sixth_order(), DiscreteGradient::new(0.05).sixth_order().compensated(),
    }
    let on_tq = ContactOnTqState { x: 0.3, y: 0.5, z: 0.4, x_dot: -0.4, y_dot: 1.0, z_dot: 0.8 };
    assert_quiet_lives! { ON_TQ, on_tq;
        ReflectedLeapfrog::new(0.05), ReflectedLeapfrog::new(0.05).compensated(),
        Projected::new(Rk4::new(0.02), 1), Projected::new(Dopri5::new(), 3),
        Conserving::new(Rk4::new(0.02)), Conserving::new(Vern9::new()),
    }
    assert_quiet_lives! { Rod { g: 1.0 }, RodState { x: 0.6, y: -0.8, x_dot: 0.4, y_dot: 0.3 };
        Rattle::new(0.05), Rattle::new(0.05).sixth_order(), DiscreteGradient::new(0.05),
        ImplicitMidpoint::new(0.05).symmetrically_projected().fourth_order(),
    }
    assert_quiet_lives! { SUSLOV, SuslovState { w_0: 0.6, w_1: 0.8 };
        DiscreteSuslov::new(0.05), DiscreteSuslov::new(0.05).compensated(),
    }
}

#[test]
fn single_precision_and_the_sine_of_the_runtime() {
    let start = ContactState::from(contact().to_array().map(<f32 as Scalar>::from_f64));
    assert_quiet_lives! { Contact { epsilon: 0.3_f32 }, start;
        Rk4::new(0.02), Dopri5::new(), Taylor::new(), Rodas5P::new(), DiscreteGradient::new(0.05),
    }
    let start = ContactState::from(contact().to_array().map(Fast));
    assert_quiet_lives! { Contact { epsilon: Fast(0.3) }, start;
        Rk4::new(Fast(0.02)), Dop853::new(), Radau5::new(),
    }
}

#[test]
fn building_blocks_of_controllers() {
    let a = Matrix4::identity() * 0.9 + Matrix4::repeat(0.02);
    let b = Vector4::new(0.1, 0.2, 0.3, 0.4);
    let (one, r) = (Matrix4::identity(), Matrix1::new(2.0));
    let row = RowVector4::new(1.0, 0.0, 0.5, 0.0);
    let belief = Estimate { mean: Vector4::new(0.1, 0.0, 0.2, 0.0), covariance: one };
    let seen = Vector1::new(0.3);
    assert_quiet("regulators", || {
        black_box((zero_order_hold(&a, &b, 0.1)?, held_noise(&a, &one, 0.1)?));
        let regulator = Regulator::stationary(&a, &b, &one, &r)?;
        black_box((regulator.input(&belief.mean), Regulator::stationary_with_cross(&a, &b, &one, &r, &b)?));
        Regulator::before(&one, &a, &b, &one, &r).map(|before| _ = black_box(before))
    });
    assert_quiet("filters", || {
        black_box((belief.predicted(a * belief.mean, &a, &one)?, belief.corrected(&seen, &row, &r)?));
        let filter = Unscented::default();
        black_box(filter.predicted(&belief, |x| a * x, &one)?);
        filter.corrected(&belief, &seen, |x| row * x, |a, b| a - b, &r).map(|seen| _ = black_box(seen))
    });
}

#[test]
fn optimal_control() {
    let model = Sampled { system: SLEIGH, start: 0.0, dt: 0.05 };
    let start = Vector5::new(-0.4, 0.0, 0.0, 0.15, -1.0);
    let cost = Quadratic {
        goal: Vector5::zeros(),
        state: Vector5::repeat(1.0),
        input: Vector1::new(0.3),
        end: Vector5::repeat(2.0),
    };
    let bound = Vector1::new(0.1);
    assert_quiet("plans", || {
        let mut plan = Ilqr::<f64, 5, 1, 20>::new(Vector1::zeros()).bounds(-bound, bound);
        plan.solve(&model, &cost, &start, 1e-9, 10)?;
        plan.shift();
        plan.improve(&model, &cost, &start)?;
        let mut states = [SVector::zeros(); 20];
        let mut gradient = [Vector1::zeros(); 20];
        black_box(shooting_cost(&model, &cost, &start, plan.inputs()));
        shooting_gradient(&model, &cost, &start, plan.inputs(), &mut states, &mut gradient).map(|_| ())
    });
    assert_quiet("steps with their derivatives", || {
        let (state, input) = (SleighState::from(<[f64; 5]>::from(start)), SleighInput { torque: 0.1 });
        black_box(Rk4::linearized_step(&SLEIGH, 0.0, 0.05, &state, &input));
        ImplicitMidpoint::linearized_step(&SLEIGH, 0.0, 0.05, &state, &input).map(|step| _ = black_box(step))
    });
}

/// The heading turns back at 0.3.
struct Turn;

impl Jumps<5, 2, 1> for Turn {
    fn events<A: Scalar>(&self, _t: A, state: &[A; 5], _by: &[A; 2]) -> [A; 1] {
        [A::from_f64(0.3) - state[0]]
    }
    fn reset<A: Scalar>(&self, _event: usize, _t: A, state: &[A; 5], by: &[A; 2]) -> [A; 5] {
        let mut after = *state;
        after[3] = -(A::ONE + by[1]) * after[3];
        after
    }
}

/// The place at the end, and the squares of the torques.
struct Far;

impl Objective<Sleigh, 5, 1> for Far {
    fn running(&self, _tick: usize, _t: f64, _x: &SleighState, u: &SleighInput) -> Slope<f64, 5, 1> {
        Slope { value: u.torque * u.torque, by_input: [2.0 * u.torque], ..Slope::zero() }
    }
    fn end(&self, _t: f64, state: &SleighState) -> Slope<f64, 5, 1> {
        Slope { value: state.x, by_state: [0.0, 1.0, 0.0, 0.0, 0.0], by_input: [0.0] }
    }
}

#[test]
fn derivatives_of_motions() {
    let start = SleighState { omega: 1.0, v1: 0.5, ..SleighState::default() };
    let motion = || {
        Variational::new(SLEIGH, [By::Start(3), By::Parameter(2)]).by_parameters(
            |sleigh: &Sleigh, t, x: &SleighState, u: &SleighInput| sleigh.parameter_jacobian(t, x, u),
        )
    };
    assert_quiet("columns", || {
        let with = motion().start(&start)?;
        let method = Dopri5::new().tolerance(ColumnTolerance::new(1e-6, 1e-6));
        let mut sim = Integrator::new(motion(), method, 0.0, with);
        let jump = advance_across(&mut sim, 1.0, &Turn, |_| ControlFlow::Continue(()))?;
        black_box((sim.state(), jump));
        let (mut plain, mut columns) = (Integrator::new(SLEIGH, Radau5::new(), 0.0, start), with.columns);
        motion().advance(&mut plain, 1.0, &mut columns).map(|()| _ = black_box(columns))
    });
    assert_quiet("adjoints", || {
        let (inputs, mut by_inputs) = ([SleighInput { torque: 0.1 }; 50], [[0.0]; 50]);
        let mut places = [Checkpoint::room(start); 5];
        let steps = Adjoint::new(&SLEIGH, Rk4::new(0.02));
        let gradient = steps.gradient(0.0, &start, &inputs, &Far, &mut places, &mut by_inputs);
        gradient.map(|gradient| _ = black_box(gradient))
    });
}

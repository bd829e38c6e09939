//! The laws of time, of limits and of what is refused, over methods that ask more of a system than the common one has:
//! position constraints with a Lagrangian, and Suslov's form on a group.

use nonholonomic::Method;
use nonholonomic::prelude::*;

/// A mass on a rod in the plane.
#[nonholonomic(
    base { x, y }
    holonomic { rod: x^2 + y^2 = l^2; }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - m * g * y }
    emit { rattle, discrete_gradient, symmetric_projection }
)]
#[derive(Clone, Copy, Debug)]
struct Rod<T> {
    m: T,
    g: T,
    l: T,
}

/// Suslov's problem.
#[nonholonomic(
    basis { w[3] }
    brackets so(3) { w }
    lagrangian { sum(i in 0..3: I[i] * w[i]^2) / 2 }
    constraints { w[2] = s * w[0]; }
    emit { euler_poincare_suslov }
)]
#[derive(Clone, Copy, Debug)]
struct Suslov<T> {
    I: [T; 3],
    s: T,
}

/// A system with a start, whose rates and positions are about one.
trait Case<T: Real>: Dynamics<Input = (), State: State<Scalar = T>> + Copy {
    fn start() -> (Self, Self::State);
}

impl<T: Real> Case<T> for Rod<T> {
    fn start() -> (Self, RodState<T>) {
        let [l, x, y, x_dot, y_dot] = [1.0, 0.6, -0.8, 0.8, 0.6].map(T::from_f64);
        let rod = Self { m: T::ONE, g: T::ONE, l };
        let mut start = RodState { x, y, x_dot, y_dot };
        rod.project(T::ZERO, &mut start).unwrap();
        (rod, start)
    }
}

impl<T: Real> Case<T> for Suslov<T> {
    fn start() -> (Self, SuslovState<T>) {
        let [two, three, s, w_0, w_1] = [2.0, 3.0, 0.7, 0.6, 0.8].map(T::from_f64);
        (Self { I: [T::ONE, two, three], s }, SuslovState { w_0, w_1 })
    }
}

fn at<T: Real, S: Case<T>, M: Method<S>>(method: M, t0: T) -> Integrator<S, M> {
    let (system, start) = S::start();
    Integrator::new(system, method, t0, start)
}

/// The largest difference of two states, of numbers that are about one.
fn apart<T: Real, X: State<Scalar = T>>(a: &X, b: &X) -> f64 {
    let (a, b) = (a.to_array(), b.to_array());
    let differences = a.as_ref().iter().zip(b.as_ref()).map(|(a, b)| (*a - *b).to_f64().abs());
    differences.fold(0.0, Scalar::max)
}

/// Calls `law::<system>(name, method)` with each of these methods.
macro_rules! each {
    ($law:ident, $real:ty) => {{
        let h: $real = 0.01;
        $law::<$real, Rod<$real>>("Rattle", Rattle::new(h));
        $law::<$real, Rod<$real>>("DiscreteGradient", DiscreteGradient::new(h));
        $law::<$real, Rod<$real>>(
            "ImplicitMidpoint, projected",
            ImplicitMidpoint::new(h).symmetrically_projected(),
        );
        $law::<$real, Suslov<$real>>("DiscreteSuslov", DiscreteSuslov::new(h));
    }};
}

/// The same from any clock, as far as that resolves the steps.
fn clocks<T: Real, S: Case<T>>(name: &str, method: impl Method<S> + Clone) {
    let mut reference = at::<T, S, _>(method.clone(), T::ZERO);
    reference.advance_to(T::from_f64(0.125)).unwrap();
    for exponent in [0, 4, 8, 12, 16, 20, 30, 40] {
        for t0 in [2.0_f64.powi(exponent), -2.0_f64.powi(exponent)].map(T::from_f64) {
            let end = t0 + T::from_f64(0.125);
            if end - t0 != T::from_f64(0.125) {
                continue;
            }
            let mut sim = at::<T, S, _>(method.clone(), t0);
            match sim.advance_to(end) {
                Ok(()) => {
                    let resolution = T::EPSILON.to_f64() * t0.abs().to_f64();
                    let off = apart(sim.state(), reference.state());
                    assert!(off < 20.0 * resolution + 1e3 * T::EPSILON.to_f64(), "{name} {t0:?}: {off:e}");
                }
                Err(IntegrationError::UnresolvedStep { step, resolution, .. }) => {
                    assert!(resolution > step, "{name} from {t0:?}");
                }
                Err(other) => panic!("{name} from {t0:?}: {other}"),
            }
        }
    }
}

/// Whole steps, and a shorter last one; the limit of steps holds, and those before it are kept.
fn counted<T: Real, S: Case<T>>(name: &str, method: impl Method<S> + Clone) {
    for (target, steps) in [(1.0, 100), (0.125, 13), (0.013, 2), (0.004, 1)] {
        for target in [target, -target].map(T::from_f64) {
            let mut sim = at::<T, S, _>(method.clone(), T::ZERO);
            sim.advance_to(target).unwrap();
            assert_eq!((sim.statistics().steps, sim.time()), (steps, target), "{name}");
        }
    }
    let mut sim = at::<T, S, _>(method, T::ZERO).max_steps(5);
    let refused = sim.advance_to(T::ONE);
    assert!(matches!(refused, Err(IntegrationError::TooManySteps { limit: 5, .. })), "{name}: {refused:?}");
    assert_eq!(sim.statistics().steps, 5, "{name}");
}

/// The smallest times that there are are reached, and what follows is as if they had not been asked for.
fn tiny<T: Real, S: Case<T>>(name: &str, method: impl Method<S> + Clone) {
    let mut whole = at::<T, S, _>(method.clone(), T::ZERO);
    whole.advance_to(T::from_f64(0.1)).unwrap();
    let mut target = T::MIN_POSITIVE * T::EPSILON;
    while target < T::from_f64(1e-3) {
        for target in [target, -target] {
            let mut sim = at::<T, S, _>(method.clone(), T::ZERO);
            assert_eq!(sim.advance_to(target), Ok(()), "{name} to {target:?}");
            assert_eq!(sim.time(), target);
            let moved = apart(sim.state(), &S::start().1);
            assert!(moved < 2.0 * target.abs().to_f64() + 1e-6, "{name} to {target:?}: {moved:e}");
            assert_eq!(sim.advance_to(T::from_f64(0.1)), Ok(()), "{name} by {target:?}");
            let off = apart(sim.state(), whole.state());
            assert!(off < 1e-5, "{name} by {target:?}: {off:e}");
        }
        target *= T::from_f64(1e3);
    }
}

/// Times that are none are refused, and so are steps that the clock has no room for, and states that are none; nothing has
/// happened then.
fn refused<T: Real, S: Case<T>>(name: &str, method: impl Method<S> + Clone) {
    let (system, start) = S::start();
    let mut sim = at::<T, S, _>(method.clone(), T::ZERO);
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY].map(T::from_f64) {
        let refused = [sim.advance_to(bad), sim.step_towards(bad), sim.sample([bad], |_, _| {})];
        let is_so = |refused: &Result<(), _>| matches!(refused, Err(IntegrationError::NonFiniteTime { .. }));
        assert!(refused.iter().all(is_so), "{name}: {refused:?}");
    }
    let late = T::from_f64(0.16) / T::EPSILON;
    let mut sim = at::<T, S, _>(method.clone(), late);
    let refused = [sim.step(), sim.advance_to(late + late), sim.step_towards(T::ZERO)];
    let is_so = |refused: &Result<(), _>| matches!(refused, Err(IntegrationError::UnresolvedStep { .. }));
    assert!(refused.iter().all(is_so), "{name}: {refused:?}");
    assert_eq!((sim.time(), sim.statistics().steps, apart(sim.state(), &start)), (late, 0, 0.0), "{name}");
    for place in 0..start.to_array().as_ref().len() {
        for bad in [f64::NAN, f64::INFINITY].map(T::from_f64) {
            let mut numbers = start.to_array();
            numbers.as_mut()[place] = bad;
            let mut sim = Integrator::new(system, method.clone(), T::ZERO, S::State::from_array(numbers));
            assert!(sim.step().is_err(), "{name}, {place}");
            assert_eq!((sim.time(), sim.statistics().steps), (T::ZERO, 0), "{name}");
        }
    }
}

#[test]
fn where_the_clock_stands_does_not_matter() {
    each!(clocks, f64);
    each!(clocks, f32);
}

#[test]
fn fixed_steps_are_whole_but_for_the_last_and_limited() {
    each!(counted, f64);
    each!(counted, f32);
}

#[test]
fn the_smallest_times_are_reached() {
    each!(tiny, f64);
    each!(tiny, f32);
}

#[test]
fn what_is_no_time_and_no_state_is_refused() {
    each!(refused, f64);
    each!(refused, f32);
}

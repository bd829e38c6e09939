//! Methods that are made of another one, and states that a return to position constraints moves a little: what has
//! been learnt on the way stays, and what belongs to another state goes.

use nonholonomic::methods::Interruptible;
use nonholonomic::prelude::*;
use nonholonomic::{D, Invariants, Method, ProjectionError, Statistics};

use crate::systems::{Plane, Spring};

/// A pendulum of length 1 in x and y, with g = 1: the velocities are accelerated along the circle, and drift off it.
#[derive(Clone, Copy)]
struct Bob;

/// Position and velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
struct BobState([f64; 4]);

impl State for BobState {
    type Scalar = f64;
    type Dim = D<4>;
    fn to_array(&self) -> [f64; 4] {
        self.0
    }
    fn from_array(x: [f64; 4]) -> Self {
        Self(x)
    }
    fn names() -> [&'static str; 4] {
        ["x", "y", "v_x", "v_y"]
    }
}

impl Dynamics for Bob {
    type State = BobState;
    type Input = ();
    fn derivative(&self, _t: f64, &BobState([x, y, u, v]): &BobState, (): &()) -> BobState {
        let pull = (y - u * u - v * v) / (x * x + y * y);
        BobState([u, v, pull * x, pull * y - 1.0])
    }
    fn has_positions(&self) -> bool {
        true
    }
    fn return_to_positions(&self, _t: f64, state: &mut BobState) -> Result<f64, ProjectionError> {
        let BobState([x, y, u, v]) = *state;
        let r = x.hypot(y);
        let (x, y) = (x / r, y / r);
        let along = x * u + y * v;
        *state = BobState([x, y, u - along * x, v - along * y]);
        Ok((r - 1.0).abs().max(along.abs()))
    }
}

impl Invariants for Bob {
    type Count = D<1>;
    fn invariants(&self, _t: f64, BobState([_, y, u, v]): &BobState) -> [f64; 1] {
        [0.5 * (u * u + v * v) + y]
    }
    fn invariant_gradients(&self, _t: f64, BobState([_, _, u, v]): &BobState) -> [[f64; 4]; 1] {
        [[0.0, 1.0, *u, *v]]
    }
}

const ASIDE: BobState = BobState([1.0, 0.0, 0.0, 0.0]);

fn swung<M: Method<Bob>>(method: M) -> (BobState, Statistics) {
    let mut sim = Integrator::new(Bob, method, 0.0, ASIDE).max_steps(1_000_000);
    sim.advance_to(100.0).unwrap();
    (*sim.state(), sim.statistics())
}

#[test]
fn a_method_that_may_be_interrupted_takes_the_same_steps() {
    fn check<M: Method<Bob> + Copy>(method: M) {
        assert_eq!(swung(Interruptible::new(method, |_: &Statistics| true)), swung(method));
    }
    check(Rk4::new(0.05));
    check(Rk4::new(0.05).compensated());
    check(Dopri5::new());
    check(Dop853::new().rtol(1e-9).atol(1e-9));
    check(Radau5::new());
    check(Rodas5P::new());
    check(Auto::new());
    check(ImplicitMidpoint::new(0.05));
    check(GaussLegendre6::new(0.1));
}

/// A return is smaller than the error of a step: it is no reason to form a Jacobian or to search for the length of steps
/// anew. The same run without returns tells what the steps themselves ask for.
#[test]
fn a_return_costs_no_jacobians_and_no_steps() {
    fn check<M: Method<Bob> + Copy>(method: M) {
        let mut free = Integrator::new(Bob, method, 0.0, ASIDE).max_steps(1_000_000).without_return();
        free.advance_to(100.0).unwrap();
        let ((_, with), without) = (swung(method), free.statistics());
        let no_more = |with: u64, without: u64| with <= without + without / 20 + 10;
        assert!(no_more(with.jacobians, without.jacobians), "{with:?} {without:?}");
        assert!(no_more(with.factorizations, without.factorizations), "{with:?} {without:?}");
        assert!(no_more(with.iterations, without.iterations), "{with:?} {without:?}");
        assert!(
            no_more(with.steps + with.rejected, without.steps + without.rejected),
            "{with:?} {without:?}"
        );
    }
    check(Dopri5::new());
    check(Radau5::new());
    check(Rodas5P::new());
    check(ImplicitMidpoint::new(0.02));
    check(GaussLegendre4::new(0.05));
    check(GaussLegendre6::new(0.1));
}

/// A level is kept from the first state on, although the state is moved after every step: it does not wander with it.
#[test]
fn a_level_is_kept_through_returns() {
    let mut sim = Integrator::new(Bob, Conserving::new(Rk4::new(0.1)), 0.0, ASIDE).max_steps(1_000_000);
    let mut largest: f64 = 0.0;
    for second in 1..=2000 {
        sim.advance_to(f64::from(second)).unwrap();
        largest = largest.max(Bob.invariants(0.0, sim.state())[0].abs());
    }
    // what the return after a step takes is of the step's order, and the next one gives it back
    assert!(largest < 1e-6, "{largest}");
}

/// What rounding has taken from a large state is nothing of a small one.
#[test]
fn another_state_starts_without_what_the_last_one_lost() {
    fn check<M: Method<Spring> + Copy>(method: M) {
        let small = Plane { q: 1e-10, p: 0.0 };
        let mut sim = Integrator::new(Spring, method, 0.0, Plane { q: 1e10, p: 0.3 });
        sim.advance_to(1.0).unwrap();
        sim.set_state(small);
        sim.advance_to(2.0).unwrap();
        let (q, p) = (1e-10 * 1_f64.cos(), -1e-10 * 1_f64.sin());
        let off = (sim.state().q - q).hypot(sim.state().p - p);
        assert!(off < 1e-14, "{:?}", sim.state());
    }
    check(Rk4::new(0.01).compensated());
    check(ImplicitMidpoint::new(0.001).fourth_order().compensated());
    check(GaussLegendre6::new(0.1).compensated());
    check(Interruptible::new(Rk4::new(0.01).compensated(), |_: &Statistics| true));
}

/// What is evaluated at the end of a step is evaluated once, where the return has led to.
#[test]
fn a_return_comes_before_the_evaluation_at_the_end() {
    fn check<M: Method<Bob> + Copy>(method: M, stages: u64) {
        let mut sim = Integrator::new(Bob, method, 0.0, ASIDE);
        for _ in 0..100 {
            sim.step().unwrap();
        }
        let Statistics { steps, rejected, evaluations, projections, largest_correction, .. } =
            sim.statistics();
        // the first length asks for one more
        assert_eq!(evaluations, 2 + stages * (steps + rejected));
        assert!(projections == steps && largest_correction > 0.0);
        // and the next step is that of a fresh run
        let before = *sim.state();
        let mut fresh = Integrator::new(Bob, method, sim.time(), before);
        let target = sim.time() + 1e-3;
        sim.step_towards(target).unwrap();
        fresh.step_towards(target).unwrap();
        assert_eq!(sim.state(), fresh.state());
    }
    check(Dopri5::new(), 6);
    check(Tsit5::new(), 6);
    check(Bs23::new(), 3);
    check(Interruptible::new(Dopri5::new(), |_: &Statistics| true), 6);
    check(Auto::new(), 6);
}

/// The same, which is not reached between the ends of steps after t = 1.
struct Blocked;

impl Dynamics for Blocked {
    type State = BobState;
    type Input = ();
    fn derivative(&self, t: f64, state: &BobState, (): &()) -> BobState {
        Bob.derivative(t, state, &())
    }
    fn has_positions(&self) -> bool {
        true
    }
    fn return_to_positions(&self, t: f64, state: &mut BobState) -> Result<f64, ProjectionError> {
        if t > 1.0 && (t * 4.0).fract() != 0.0 {
            return Err(ProjectionError { iterations: 7, residual: 0.5 });
        }
        Bob.return_to_positions(t, state)
    }
}

/// Where no end of a step finds back to the constraints, steps are shortened as fast as control permits.
fn stops_before_it(name: &str, method: impl Method<Blocked>) {
    let mut sim = Integrator::new(Blocked, method, 0.0, ASIDE);
    let ended = sim.advance_to(3.0);
    let error = ProjectionError { iterations: 7, residual: 0.5 };
    let is_told = matches!(ended, Err(IntegrationError::Projection { error: found, .. }) if found == error);
    let rejected = sim.statistics().rejected;
    assert!(is_told && (sim.time() - 1.0).abs() < 1e-12 && rejected < 100, "{name}: {ended:?}, {rejected}");
}

#[test]
fn steps_that_do_not_find_back_are_shortened_until_there_are_none() {
    stops_before_it("Dopri5", Dopri5::new());
    stops_before_it("Bs23", Bs23::new());
    stops_before_it("Dop853", Dop853::new());
    stops_before_it("Radau5", Radau5::new());
    stops_before_it("Rodas5P", Rodas5P::new());
    stops_before_it("Auto", Auto::new());
}

/// What is wrong at a time is said there, and no further step is taken.
#[test]
fn a_sample_that_is_not_reached_is_told_where_it_is() {
    let mut sim = Integrator::new(Blocked, Rk4::new(0.25), 0.0, ASIDE);
    let mut seen = 0;
    let ended = sim.sample([0.3, 0.9, 1.25, 1.3, 1.5, 3.0], |_, _| seen += 1);
    let error = ProjectionError { iterations: 7, residual: 0.5 };
    assert_eq!(ended, Err(IntegrationError::Projection { time: 1.3, error }));
    assert_eq!((seen, sim.time()), (3, 1.5));
}

//! A method that is explicit where it can be and implicit where it has to be.

use nonholonomic::prelude::*;
use nonholonomic::{D, Method};

#[derive(Clone, Copy, Debug, PartialEq)]
struct Pair(f64, f64);

impl State for Pair {
    type Scalar = f64;
    type Dim = D<2>;
    fn to_array(&self) -> [f64; 2] {
        [self.0, self.1]
    }
    fn from_array([x, y]: [f64; 2]) -> Self {
        Self(x, y)
    }
    fn names() -> [&'static str; 2] {
        ["x", "y"]
    }
}

#[derive(Clone, Copy)]
struct Given<F>(F);

impl<F: Fn(f64, Pair) -> Pair> Dynamics for Given<F> {
    type State = Pair;
    type Input = ();
    fn derivative(&self, t: f64, x: &Pair, (): &()) -> Pair {
        (self.0)(t, *x)
    }
}

/// The end of a run, and what it has cost.
fn end<F: Fn(f64, Pair) -> Pair, M: Method<Given<F>>>(
    f: F,
    method: M,
    start: Pair,
    target: f64,
) -> (Pair, Statistics) {
    let mut sim = Integrator::new(Given(f), method, 0.0, start);
    sim.advance_to(target).unwrap();
    (*sim.state(), sim.statistics())
}

/// Van der Pol's oscillator in its own time: fast and slow by turns.
fn oscillator(mu: f64) -> impl Fn(f64, Pair) -> Pair + Copy {
    move |_, Pair(x, y)| Pair(y, mu * (1.0 - x * x) * y - x)
}

/// A relaxation to cos t at a rate that depends on the time.
fn relaxing(rate: impl Fn(f64) -> f64 + Copy) -> impl Fn(f64, Pair) -> Pair + Copy {
    move |t, Pair(x, y)| Pair(-rate(t) * (x - t.cos()) - t.sin(), -y)
}

#[test]
fn what_is_not_stiff_is_explicit_bit_for_bit() {
    let swing = |t: f64, Pair(x, y): Pair| Pair(y, (0.3 * t).sin() - x);
    let (auto, cost) = end(swing, Auto::new().rtol(1e-8), Pair(1.0, 0.0), 50.0);
    let (explicit, cost_of_explicit) = end(swing, Tsit5::new().rtol(1e-8), Pair(1.0, 0.0), 50.0);
    assert_eq!((auto, cost), (explicit, cost_of_explicit));
    assert_eq!(cost.switches, 0);
}

#[test]
fn what_is_stiff_throughout_is_implicit_after_a_while() {
    for rate in [1e4, 1e8, 1e12] {
        let (Pair(x, y), cost) = end(relaxing(|_| rate), Auto::new().rtol(1e-6), Pair(1.0, 1.0), 20.0);
        assert!((x - 20.0_f64.cos()).abs() < 1e-4 && (y - (-20.0_f64).exp()).abs() < 1e-5, "{rate}: {x} {y}");
        assert_eq!(cost.switches, 1, "{rate}");
        assert!(cost.steps < 400, "{rate}: {cost:?}");
        assert!(cost.stiff_at.is_some_and(|at| at < 1.0), "{rate}: {cost:?}");
    }
}

#[test]
fn it_comes_back_where_stiffness_ends() {
    let rate = |t: f64| if t < 10.0 { 1e5 } else { 1.0 };
    let (Pair(x, _), cost) = end(relaxing(rate), Auto::new().rtol(1e-7), Pair(1.0, 1.0), 60.0);
    assert!((x - 60.0_f64.cos()).abs() < 1e-4, "{x}");
    assert_eq!(cost.switches, 2, "{cost:?}");
    // and goes again
    let rate = |t: f64| if (t / 20.0).fract() < 0.5 { 1e5 } else { 1.0 };
    let (_, cost) = end(relaxing(rate), Auto::new().rtol(1e-7), Pair(1.0, 1.0), 78.0);
    assert_eq!(cost.switches, 8, "{cost:?}");
}

/// A direction that turns is as long in one component as in the other in no units: an estimate by one step of it is the
/// larger or the smaller of two, by turns.
#[test]
fn it_comes_back_to_what_swings_in_any_units() {
    for frequency in [3.0, 30.0, 300.0] {
        for method in [Auto::new(), Auto::new().atol(0.0), Auto::new().atol(1e-12)] {
            let damping = |t: f64| if t < 1.0 { 1e3 * frequency } else { 0.0 };
            let swing = |t: f64, Pair(x, y): Pair| Pair(y, -damping(t) * y - frequency * frequency * x);
            let start = Pair(1.0 / frequency, 0.0);
            let (_, cost) = end(swing, method, start, 1.0 + 100.0 / frequency);
            assert_eq!(cost.switches, 2, "{frequency} {method:?}: {cost:?}");
        }
    }
}

#[test]
fn the_oscillator_is_right_and_cheaper_than_either_alone() {
    let mu = 200.0;
    let target = 3.0 * mu;
    let (expected, _) = end(oscillator(mu), Radau5::new().rtol(1e-12), Pair(2.0, 0.0), target);
    let (auto, cost) = end(oscillator(mu), Auto::new().rtol(1e-7), Pair(2.0, 0.0), target);
    assert!((auto.0 - expected.0).abs() < 1e-4, "{auto:?} {expected:?}");
    assert!(cost.switches >= 2, "{cost:?}");
    let (_, explicit) = end(oscillator(mu), Tsit5::new().rtol(1e-7), Pair(2.0, 0.0), target);
    assert!(cost.evaluations < explicit.evaluations / 4, "{cost:?} {explicit:?}");
}

#[test]
fn the_states_within_a_step_are_those_of_the_method_that_took_it() {
    let mut sim = Integrator::new(Given(relaxing(|_| 1e6)), Auto::new().rtol(1e-8), 0.0, Pair(1.0, 1.0));
    let mut worst = 0.0_f64;
    while sim.time() < 5.0 {
        let from = sim.time();
        sim.step_towards(5.0).unwrap();
        for part in 1..8 {
            let time = from + (sim.time() - from) * f64::from(part) / 8.0;
            let Pair(x, y) = sim.at(time).unwrap();
            worst = worst.max((x - time.cos()).abs()).max((y - (-time).exp()).abs());
        }
    }
    assert_eq!(sim.statistics().switches, 1);
    assert!(worst < 1e-6, "{worst}");
}

#[test]
fn inputs_and_jumps_are_taken_up() {
    let mut sim = Integrator::new(Given(relaxing(|_| 1e6)), Auto::new().rtol(1e-8), 0.0, Pair(1.0, 1.0));
    sim.advance_to(3.0).unwrap();
    assert_eq!(sim.statistics().switches, 1);
    sim.set_state(Pair(-1.0, 2.0));
    sim.advance_to(6.0).unwrap();
    let &Pair(x, y) = sim.state();
    assert!((x - 6.0_f64.cos()).abs() < 1e-6 && (y - 2.0 * (-3.0_f64).exp()).abs() < 1e-6, "{x} {y}");
    // the decay after the jump, in steps of a millionth, may be explicit; then it is implicit again
    assert!([1, 3].contains(&sim.statistics().switches), "{:?}", sim.statistics());
}

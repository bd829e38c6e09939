//! Methods that return to a manifold: when they do, what they report, and what they keep.

use nonholonomic::prelude::*;
use nonholonomic::{D, Method, ProjectionError};

use crate::systems::Plane;

/// q' = p, p' = −q on the circle q² + p² = 1.
#[derive(Clone, Copy)]
pub(crate) struct Circle {
    /// The radius below which projections fail.
    least: f64,
}

impl Dynamics for Circle {
    type State = Plane<f64>;
    type Input = ();
    fn derivative(&self, _t: f64, x: &Plane<f64>, (): &()) -> Plane<f64> {
        Plane { q: x.p, p: -x.q }
    }
}

impl Constrained for Circle {
    type Constraints = D<1>;
    fn constraint_residual(&self, _t: f64, x: &Plane<f64>) -> [f64; 1] {
        [x.q * x.q + x.p * x.p - 1.0]
    }
    fn project(&self, t: f64, x: &mut Plane<f64>) -> Result<(), ProjectionError> {
        let r = x.q.hypot(x.p);
        if r < self.least {
            return Err(ProjectionError { iterations: 1, residual: self.constraint_residual(t, x)[0].abs() });
        }
        *x = Plane { q: x.q / r, p: x.p / r };
        Ok(())
    }
}

const START: Plane<f64> = Plane { q: 1.0, p: 0.0 };

pub(crate) fn circling<M: Method<Circle>>(method: M) -> Integrator<Circle, M> {
    Integrator::new(Circle { least: 0.5 }, method, 0.0, START)
}

fn off_the_circle(x: &Plane<f64>) -> f64 {
    (x.q.hypot(x.p) - 1.0).abs()
}

#[test]
fn every_method_stays_on_the_manifold() {
    fn check<M: Method<Circle> + Copy>(method: M, least_drift: f64) {
        let mut drifting = circling(method);
        drifting.advance_to(50.0).unwrap();
        let mut sim = circling(Projected::new(method, 1));
        sim.advance_to(50.0).unwrap();
        let statistics = sim.statistics();
        assert_eq!(statistics.projections, statistics.steps);
        assert!(off_the_circle(sim.state()) < 2e-16, "{:?}", sim.state());
        assert!(statistics.largest_correction > 0.0);
        assert!(statistics.last_residual < 3.0 * statistics.largest_correction);
        assert!(off_the_circle(drifting.state()) >= least_drift);
    }
    check(Euler::new(0.01), 0.1);
    check(Rk4::new(0.1), 1e-6);
    check(Dopri5::new().rtol(1e-6), 1e-6);
    // keeps circles by itself, but for round-off
    check(ImplicitMidpoint::new(0.1), 0.0);
}

#[test]
fn the_cadence_is_kept_and_counts_steps() {
    let mut sim = circling(Projected::new(Rk4::new(0.1), 7));
    for step in 1..=70 {
        let before = sim.statistics();
        sim.step().unwrap();
        let projected = sim.statistics().projections > before.projections;
        assert_eq!(projected, step % 7 == 0, "{step}");
        assert_eq!(projected, off_the_circle(sim.state()) < 2e-16, "{step}");
    }
    assert_eq!(sim.statistics().projections, 10);
}

#[test]
fn a_correction_renews_the_stored_derivative() {
    // a step of Dormand and Prince's method takes six evaluations, the last of them where the correction has led to
    let cost = |every| {
        let method = Dopri5::new().rtol(1e-6).first_step(0.1).max_step(0.1);
        let mut sim = circling(Projected::new(method, every));
        for _ in 0..100 {
            sim.step().unwrap();
        }
        sim.statistics().evaluations
    };
    assert_eq!(cost(1000), 601);
    assert_eq!(cost(2), 601);
    // and the steps are those of a fresh integration from the corrected state
    let method = Dopri5::new().rtol(1e-3).first_step(0.1).max_step(0.1);
    let mut sim = circling(Projected::new(method, 1));
    sim.step().unwrap();
    let mut fresh = Integrator::new(Circle { least: 0.5 }, method, sim.time(), *sim.state());
    let mut raw = circling(method);
    raw.step().unwrap();
    assert_ne!(raw.state(), sim.state());
    let target = sim.time() + 0.1;
    sim.advance_to(target).unwrap();
    fresh.advance_to(target).unwrap();
    let r = fresh.state().q.hypot(fresh.state().p);
    assert_eq!(*sim.state(), Plane { q: fresh.state().q / r, p: fresh.state().p / r });
}

#[test]
fn dense_output_meets_the_corrected_states() {
    fn check<M: Method<Circle>>(method: M, tolerance: f64) {
        let mut sim = circling(Projected::new(method, 1));
        sim.advance_to(1.0).unwrap();
        let (time, state) = (sim.time(), *sim.state());
        sim.step().unwrap();
        assert_eq!(sim.at(time).unwrap(), state);
        assert_eq!(sim.at(sim.time()).unwrap(), *sim.state());
        for i in 1..100 {
            let at = sim.at(time + (sim.time() - time) * f64::from(i) / 100.0).unwrap();
            assert!(off_the_circle(&at) < tolerance, "{at:?}");
        }
        let near = sim.at(sim.time() - 1e-12).unwrap();
        assert!((near.q - sim.state().q).abs() < 1e-11, "{near:?}");
    }
    check(Dopri5::new().rtol(1e-8), 1e-6);
    check(Rk4::new(0.1), 1e-5);
}

#[test]
fn a_failed_projection_keeps_the_last_good_state() {
    let mut sim = Integrator::new(Circle { least: 2.0 }, Projected::new(Rk4::new(0.1), 3), 0.0, START);
    let error = sim.advance_to(1.0).unwrap_err();
    let IntegrationError::Projection { time, error: ProjectionError { iterations: 1, residual } } = error
    else {
        panic!("{error:?}");
    };
    assert!((time - 0.3).abs() < 1e-15 && residual < 1e-6);
    assert!((sim.time() - 0.2).abs() < 1e-15, "{:?}", sim.time());
    assert_eq!(sim.statistics().steps, 2);
    let before = *sim.state();
    assert_eq!(sim.step().unwrap_err(), error);
    assert_eq!(*sim.state(), before);
    assert!(std::error::Error::source(&error).is_some());
    assert_eq!(
        IntegrationError::Projection { time: 0.5, error: ProjectionError { iterations: 50, residual: 0.25 } }
            .to_string(),
        "at t = 0.5 the projection left a residual of 0.25 after 50 iterations: the state is too far from the \
         constraints, or from the level of the invariants, or these are dependent there; start nearer to them, \
         or take smaller steps; past a place where they are dependent, as where all links are in line, longer steps"
    );
}

/// However far away, and where the way back is hardly one or none: nothing is moved without a word.
#[test]
fn a_start_far_off_is_refused_where_it_is() {
    fn check<M: Method<Circle> + Copy>(method: M) {
        for decade in (-300..=150).filter(|decade| *decade != 0) {
            let distance = 10.0_f64.powi(decade);
            for start in [Plane { q: distance, p: 0.0 }, Plane { q: 0.6 * distance, p: -0.8 * distance }] {
                for least in [0.0, 0.5] {
                    let mut sim = Integrator::new(Circle { least }, Projected::new(method, 1), 0.0, start);
                    let refused = sim.step();
                    let is_told = matches!(
                        refused,
                        Err(IntegrationError::InconsistentStart { .. } | IntegrationError::Projection { .. })
                    );
                    assert!(is_told && *sim.state() == start, "1e{decade}: {refused:?}");
                }
            }
        }
    }
    check(Rk4::new(0.1));
    check(ImplicitMidpoint::new(0.1));
    check(Dopri5::new());
    check(Radau5::new());
}

#[test]
fn a_cadence_of_zero_is_refused() {
    let error = circling(Projected::new(Rk4::new(0.1), 0)).step().unwrap_err();
    assert_eq!(
        error.to_string(),
        "the setting `every` of the method is 0.0, but has to be at least 1, the number of steps from one \
         projection to the next"
    );
    let error = circling(Projected::new(Rk4::new(-0.1), 1)).step().unwrap_err();
    assert!(matches!(error, IntegrationError::Setting { setting: "step", .. }));
}

#[test]
fn many_steps_at_once_are_the_steps_one_by_one() {
    fn check<M: Method<Circle> + Copy>(method: M) {
        for every in [1, 2, 7, 40] {
            let mut whole = circling(Projected::new(method, every));
            whole.advance_to(30.0).unwrap();
            let mut single = circling(Projected::new(method, every));
            while single.time() < 30.0 {
                single.step_towards(30.0).unwrap();
            }
            assert_eq!((whole.state(), whole.statistics()), (single.state(), single.statistics()));
            let middle = f64::midpoint(whole.time(), 29.99);
            assert_eq!(whole.at(middle), single.at(middle));
        }
    }
    check(Rk4::new(0.1));
    check(Rk4::new(0.1).compensated());
    check(Dopri5::new());
    check(Dop853::new());
    check(Radau5::new());
}

/// A circle that has no way back to it in the middle of a step of a quarter turn.
#[derive(Clone, Copy)]
struct Torn;

impl Dynamics for Torn {
    type State = Plane<f64>;
    type Input = ();
    fn derivative(&self, _t: f64, x: &Plane<f64>, (): &()) -> Plane<f64> {
        Plane { q: x.p, p: -x.q }
    }
}

impl Constrained for Torn {
    type Constraints = D<1>;
    fn constraint_residual(&self, _t: f64, x: &Plane<f64>) -> [f64; 1] {
        [x.q * x.q + x.p * x.p - 1.0]
    }
    fn project(&self, t: f64, x: &mut Plane<f64>) -> Result<(), ProjectionError> {
        if (0.2..0.3).contains(&t) {
            return Err(ProjectionError { iterations: 1, residual: 1.0 });
        }
        let r = x.q.hypot(x.p);
        *x = Plane { q: x.q / r, p: x.p / r };
        Ok(())
    }
}

/// What a projection does not reach is handed out to nobody.
#[test]
fn states_that_are_not_projected_are_not_handed_out() {
    let mut sim = Integrator::new(Torn, Projected::new(Rk4::new(0.5), 1), 0.0, START);
    sim.step().unwrap();
    let dense = sim.dense();
    assert!(off_the_circle(&dense.at(0.1).unwrap()) < 2e-16);
    let within = dense.at(0.25).unwrap_err();
    assert!(
        matches!(within, IntegrationError::NonFiniteWithin { component: "q", time: 0.25, .. }),
        "{within:?}"
    );
    let text = within.to_string();
    assert!(text.starts_with("`q` is NaN within the step, at t = 0.25"), "{text}");
    assert!(off_the_circle(&dense.at(0.4).unwrap()) < 2e-16);
}

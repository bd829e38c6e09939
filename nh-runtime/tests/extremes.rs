//! Extremes: scales, stiffness, hostile numbers, and repetition, with stated bounds.

#![allow(clippy::float_cmp)] // exact repetition is meant

use nonholonomic::Method;
use nonholonomic::prelude::*;

/// A Chaplygin sleigh whose centre of mass lies on the line of the blade.
#[nonholonomic(
    base   { theta, x, y }
    basis  { omega, v1, v2 }
    anchor {
        der(theta) = omega;
        der(x) = v1 * cos(theta) - v2 * sin(theta);
        der(y) = v1 * sin(theta) + v2 * cos(theta);
    }
    lagrangian  { J / 2 * omega^2 + m / 2 * (v1^2 + (v2 + a * omega)^2) }
    constraints { v2 = 0; }
    forces      { omega: torque - c * omega; }
    inputs      { torque }
    assume      { m > 0; J > 0; }
    emit        { jacobian, taylor }
)]
#[derive(Clone, Copy, Debug)]
struct Sleigh<T> {
    m: T,
    J: T,
    a: T,
    c: T,
}

/// The free sleigh: v = V tanh kt, ω = Ω / cosh kt with V² m = Ω² I, k = m a V / I, I = J + m a².
struct Swing {
    sleigh: Sleigh<f64>,
    v: f64,
    omega: f64,
    rate: f64,
}

impl Swing {
    fn of(sleigh: Sleigh<f64>, v: f64) -> Self {
        let inertia = sleigh.J + sleigh.m * sleigh.a * sleigh.a;
        Self { sleigh, v, omega: v * (sleigh.m / inertia).sqrt(), rate: sleigh.m * sleigh.a * v / inertia }
    }

    /// State at τ = kt.
    fn state(&self, tau: f64) -> SleighState<f64> {
        SleighState { omega: self.omega / tau.cosh(), v1: self.v * tau.tanh(), ..SleighState::default() }
    }

    /// The largest relative error of the velocities after a swing from τ = −3 to 3.
    fn error<M: Method<Sleigh<f64>>>(&self, method: M) -> f64 {
        let ends = [-3.0, 3.0];
        let mut sim = Integrator::new(self.sleigh, method, ends[0] / self.rate, self.state(ends[0]));
        sim.advance_to(ends[1] / self.rate).unwrap();
        let (reached, exact) = (sim.state(), self.state(ends[1]));
        ((reached.v1 - exact.v1) / self.v).abs().max(((reached.omega - exact.omega) / self.omega).abs())
    }

    /// A tolerance in the units of the swing.
    fn tolerances(&self, relative: f64) -> (SleighState<f64>, SleighState<f64>) {
        let length = self.v / self.rate;
        let atol = SleighState {
            omega: relative * self.omega,
            v1: relative * self.v,
            theta: relative,
            x: relative * length,
            y: relative * length,
        };
        (SleighState { theta: 0.0, x: relative, y: relative, omega: relative, v1: relative }, atol)
    }
}

#[test]
fn masses_and_inertias_of_any_ratio() {
    // the tolerance per component makes the problem the same at every scale
    for m in [1e-9, 1e-3, 1.0, 1e9] {
        for inertia in [1e-9, 1.0, 1e9] {
            for a in [1e-6, 1e-2, 1.0] {
                let swing = Swing::of(Sleigh { m, J: inertia, a, c: 0.0 }, 1.0);
                // the sleigh turns Ω/k times 2π: only so far is the swing a matter of a few steps
                if swing.omega / swing.rate > 1e3 {
                    continue;
                }
                let (rtol, atol) = swing.tolerances(1e-10);
                let error = swing.error(Dop853::new().tolerances(rtol, atol));
                assert!(error < 1e-7, "m {m:e} J {inertia:e} a {a:e}: {error:e}");
                let error = swing.error(Radau5::new().tolerances(rtol, atol).with_jacobian());
                assert!(error < 1e-6, "m {m:e} J {inertia:e} a {a:e}: {error:e}");
                let error = swing.error(Rodas5P::new().tolerances(rtol, atol).with_jacobian());
                assert!(error < 1e-6, "m {m:e} J {inertia:e} a {a:e}: {error:e}");
                let error = swing.error(Taylor::new().tolerances(rtol, atol));
                assert!(error < 1e-7, "m {m:e} J {inertia:e} a {a:e}: {error:e}");
            }
        }
    }
}

#[test]
fn a_nearly_singular_mass_matrix() {
    // J + m a² = 2e-12: regular, but only just
    let swing = Swing::of(Sleigh { m: 1.0, J: 1e-12, a: 1e-6, c: 0.0 }, 1.0);
    for error in [
        swing.error(Dop853::new().rtol(1e-11)),
        swing.error(Taylor::new().rtol(1e-11)),
        swing.error(Rodas5P::new().rtol(1e-11).with_jacobian()),
    ] {
        assert!(error < 1e-7, "{error:e}");
    }
}

#[test]
fn fast_spin_and_time_scales() {
    // a million radians in a second, in a microsecond, in a year
    for omega in [1e6, 1e12, 1e-7] {
        let sleigh = Sleigh { m: 2.0, J: 0.5, a: 0.3, c: 0.0 };
        let swing = Swing::of(sleigh, omega * (0.68_f64 / 2.0).sqrt());
        assert!((swing.omega / omega - 1.0).abs() < 1e-14);
        let (rtol, atol) = swing.tolerances(1e-11);
        for error in [
            swing.error(Dop853::new().tolerances(rtol, atol)),
            swing.error(Vern9::new().tolerances(rtol, atol)),
            swing.error(Tsit5::new().tolerances(rtol, atol)),
            swing.error(Rodas5P::new().tolerances(rtol, atol).with_jacobian()),
            swing.error(Taylor::new().tolerances(rtol, atol)),
            swing.error(Rk4::new(1e-3 / swing.rate)),
            swing.error(ImplicitMidpoint::new(2e-3 / swing.rate).sixth_order()),
            swing.error(GaussLegendre6::new(0.05 / swing.rate).with_jacobian()),
        ] {
            assert!(error < 1e-8, "{omega:e}: {error:e}");
        }
    }
    // ten seconds of a blade that turns a million radians in each
    let sleigh = Sleigh { m: 1.0, J: 1.0, a: 0.0, c: 0.0 };
    let start = SleighState { omega: 1e6, v1: 1.0, ..SleighState::default() };
    let mut sim = Integrator::new(sleigh, Rk4::new(1e-7).compensated(), 0.0, start);
    let steps = 100_000_u32;
    for _ in 0..steps {
        sim.step().unwrap();
    }
    let t = sim.time();
    assert!((sim.state().theta - 1e6 * t).abs() < 4.0 * f64::EPSILON * 1e6 * t);
    // it goes round in circles of a micrometre
    assert!(sim.state().x.hypot(sim.state().y) < 2.1e-6);
}

/// Ten seconds, in few steps.
fn damped<M: Method<Sleigh<f64>>>(
    sleigh: Sleigh<f64>,
    start: SleighState<f64>,
    method: M,
) -> SleighState<f64> {
    let mut sim = Integrator::new(sleigh, method, 0.0, start);
    sim.advance_to(10.0).unwrap();
    assert!(sim.statistics().steps < 250, "{} {:?}", sleigh.c, sim.statistics());
    *sim.state()
}

#[test]
fn stiff_damping() {
    for c in [1e3, 1e6, 1e9, 1e12] {
        let sleigh = Sleigh { m: 1.0, J: 1.0, a: 0.5, c };
        let start = SleighState { omega: 1.0, v1: 0.5, ..SleighState::default() };
        // ω' = −(c + m a v) ω / I: it turns by I/(c + m a v), to first order in 1/c
        let turned = 1.25 / (c + 0.25);
        for end in [
            damped(sleigh, start, Radau5::new().rtol(1e-7).with_jacobian()),
            damped(sleigh, start, Radau5::new().rtol(1e-7)),
            damped(sleigh, start, Rodas5P::new().rtol(1e-7).with_jacobian()),
        ] {
            assert!(end.omega.abs() < 1e-9, "{c}: {end:?}");
            assert!((end.theta - turned).abs() < 1.0 / (c * c) + 1e-5, "{c}: {end:?} {turned}");
            assert!((end.v1 - 0.5).abs() < 1.0 / c && (end.x - 5.0).abs() < 20.0 / c + 1e-5, "{c}: {end:?}");
        }
    }
}

#[test]
fn hostile_numbers_are_refused_at_once() {
    fn check<M: Method<Sleigh<f64>> + Clone>(method: M) {
        let good = Sleigh { m: 1.0, J: 1.0, a: 0.5, c: 0.1 };
        let start = SleighState { omega: 1.0, v1: 0.5, ..SleighState::default() };
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut sim = Integrator::new(Sleigh { m: bad, ..good }, method.clone(), 0.0, start);
            assert!(matches!(sim.step(), Err(IntegrationError::Parameter(error)) if error.parameter == "m"));
            assert_eq!((*sim.state(), sim.statistics()), (start, Statistics::default()));

            let hurt = SleighState { v1: bad, ..start };
            let mut sim = Integrator::new(good, method.clone(), 0.0, hurt);
            let error = sim.advance_to(1.0).unwrap_err();
            assert!(matches!(error, IntegrationError::NonFiniteState { component: "v1", .. }));

            let mut sim = Integrator::new(good, method.clone(), 0.0, start);
            sim.set_input(SleighInput { torque: bad });
            assert!(matches!(sim.step(), Err(IntegrationError::Input(fault)) if fault.input == "torque"));
            sim.set_input(SleighInput { torque: 0.0 });
            assert!(matches!(sim.advance_to(bad), Err(IntegrationError::NonFiniteTime { .. })));
            assert_eq!((*sim.state(), sim.time()), (start, 0.0));
            sim.advance_to(0.1).unwrap();
        }
        // denormals are numbers
        let tiny = SleighState { theta: 5e-324, x: -1e-310, y: 0.0, omega: 3e-320, v1: 5e-324 };
        let mut sim = Integrator::new(good, method.clone(), 0.0, tiny);
        sim.advance_to(1.0).unwrap();
        assert!(sim.state().omega.abs() < 1e-300 && sim.state().v1 >= 0.0);
        // nothing to do, and back
        let mut sim = Integrator::new(good, method, 0.0, start);
        sim.advance_to(0.0).unwrap();
        assert_eq!(sim.statistics().steps, 0);
        sim.advance_to(0.5).unwrap();
        sim.advance_to(0.0).unwrap();
        assert!((sim.state().omega - 1.0).abs() < 1e-4 && sim.time() == 0.0);
    }
    check(Euler::new(1e-5));
    check(Heun::new(0.001));
    check(Ralston::new(0.01));
    check(Rk4::new(0.01));
    check(Rk4::new(0.01).compensated());
    check(ImplicitMidpoint::new(0.01));
    check(GaussLegendre4::new(0.05));
    check(GaussLegendre6::new(0.05).with_jacobian());
    check(Bs23::new());
    check(Dopri5::new());
    check(Tsit5::new());
    check(Dop853::new());
    check(Vern9::new());
    check(Taylor::new());
    check(Radau5::new());
    check(Rodas5P::new());
    check(Auto::new());
    check(ImplicitMidpoint::new(0.01).fourth_order());
}

#[test]
fn tolerances_out_of_range() {
    macro_rules! each {
        ($($method:ident)*) => {$(
            let sleigh = Sleigh { m: 1.0, J: 1.0, a: 0.5, c: 0.0 };
            let start = SleighState { omega: 1.0, v1: 0.5, ..SleighState::default() };
            for (rtol, atol) in [
                (0.0, 0.0), (-1e-6, 1e-6), (f64::NAN, 1e-6), (1e-6, f64::NAN), (1e-6, -1e-9), (1e-17, 1e-6),
                (f64::INFINITY, 1e-6), (1e-6, f64::INFINITY),
            ] {
                let mut sim = Integrator::new(sleigh, $method::new().rtol(rtol).atol(atol), 0.0, start);
                let error = sim.advance_to(1.0).unwrap_err();
                assert!(matches!(error, IntegrationError::Setting { .. }), "{rtol} {atol}: {error}");
                assert_eq!(*sim.state(), start);
            }
            // purely relative, purely absolute
            for (rtol, atol) in [(1e-6, 0.0), (0.0, 1e-6)] {
                let mut sim = Integrator::new(sleigh, $method::new().rtol(rtol).atol(atol), 0.0, start);
                sim.advance_to(1.0).unwrap();
                assert!(sim.statistics().steps < 500);
            }
            // at the limit of what is accepted: it ends, in one way or the other
            let limit = 4.0 * f64::EPSILON;
            let mut sim = Integrator::new(sleigh, $method::new().rtol(limit), 0.0, start).max_steps(5000);
            if let Err(error) = sim.advance_to(0.1) {
                assert!(matches!(
                    error,
                    IntegrationError::StepUnderflow { .. } | IntegrationError::TooManySteps { .. }
                ), "{error}");
            }
            assert!(sim.state().v1.is_finite());
        )*};
    }
    each! { Bs23 Dopri5 Tsit5 Dop853 Vern9 Taylor Radau5 Rodas5P Auto }
}

/// The same numbers from a run as a whole, step by step, after a reset, and from a clone.
fn repeats<M: Method<Sleigh<f64>> + Clone>(method: M) {
    let sleigh = Sleigh { m: 1.0, J: 1.0, a: 0.5, c: 0.1 };
    let start = SleighState { omega: 1.0, v1: 0.5, ..SleighState::default() };
    let mut whole = Integrator::new(sleigh, method.clone(), 0.0, start);
    whole.advance_to(7.3).unwrap();
    let mut single = Integrator::new(sleigh, method, 0.0, start);
    while single.time() != 7.3 {
        single.step_towards(7.3).unwrap();
        // looking at a step changes nothing
        let from = single.time();
        assert!(single.at(from).is_ok());
    }
    assert_eq!((whole.state(), whole.statistics()), (single.state(), single.statistics()));
    single.reset(0.0, start);
    let mut copy = single.clone();
    single.advance_to(7.3).unwrap();
    copy.advance_to(7.3).unwrap();
    assert_eq!((whole.state(), whole.statistics()), (single.state(), single.statistics()));
    assert_eq!(whole.state(), copy.state());
    let middle = f64::midpoint(7.2999, 7.3);
    assert_eq!(whole.at(middle), copy.at(middle));
}

#[test]
fn runs_repeat_to_the_last_bit() {
    repeats(Euler::new(0.01));
    repeats(Rk4::new(0.01));
    repeats(Rk4::new(0.01).compensated());
    repeats(Dop853::fixed(0.1));
    repeats(ImplicitMidpoint::new(0.01));
    repeats(GaussLegendre4::new(0.01).with_jacobian());
    repeats(Bs23::new());
    repeats(Dopri5::new());
    repeats(Tsit5::new());
    repeats(Dop853::new());
    repeats(Vern9::new());
    repeats(Taylor::new());
    repeats(ImplicitMidpoint::new(0.01).sixth_order().compensated());
    repeats(Radau5::new());
    repeats(Rodas5P::new().with_jacobian());
}

#[test]
fn single_precision_over_a_long_time() {
    let sleigh = Sleigh { m: 1.0_f32, J: 1.0, a: 0.5, c: 0.0 };
    let start = SleighState { omega: 1e-3, v1: -0.5, ..SleighState::default() };
    let run = |error: f32| f64::from(error);
    let before = sleigh.energy(0.0, &start);
    let mut plain = Integrator::new(sleigh, Rk4::new(0.01_f32), 0.0, start);
    let mut compensated = Integrator::new(sleigh, Rk4::new(0.01_f32).compensated(), 0.0, start);
    plain.advance_to(1000.0).unwrap();
    compensated.advance_to(1000.0).unwrap();
    let error = |sim: &SleighState<f32>| run((sleigh.energy(0.0, sim) / before - 1.0).abs());
    // the round-off of 10⁵ steps, and that of a few
    assert!(error(plain.state()) < 1e-3, "{:e}", error(plain.state()));
    assert!(error(compensated.state()) < 1e-6, "{:e}", error(compensated.state()));
}

#[test]
fn every_method_in_single_precision() {
    fn check<M: Method<Sleigh<f32>>>(method: M, bound: f32) {
        let sleigh = Sleigh { m: 1.0_f32, J: 1.0, a: 0.5, c: 0.0 };
        let start = SleighState { omega: 0.3, v1: -0.5, ..SleighState::default() };
        let before = sleigh.energy(0.0, &start);
        let mut sim = Integrator::new(sleigh, method, 0.0, start);
        // it turns round once
        let turns = Events::new(|_, x: &SleighState<f32>, _: &SleighInput<f32>| [x.v1]);
        let turn = sim.advance_until(20.0, &turns).unwrap().expect("a turn");
        assert!(turn.state.v1.abs() < 1e-5 && turn.direction == Direction::Rising);
        assert_eq!(sim.advance_until(20.0, &turns), Ok(None));
        let energy = sleigh.energy(0.0, sim.state());
        assert!((energy / before - 1.0).abs() < bound, "{}", energy / before - 1.0);
        sim.advance_to(0.0).unwrap();
        assert!((sim.state().omega - 0.3).abs() < 2.0 * bound, "{:?}", sim.state());
    }
    check(Euler::new(0.001), 1e-3);
    check(Rk4::new(0.01), 1e-5);
    check(ImplicitMidpoint::new(0.01), 1e-5);
    check(GaussLegendre4::new(0.05), 1e-5);
    check(GaussLegendre6::new(0.05).with_jacobian(), 1e-5);
    check(Bs23::new(), 1e-3);
    check(Dopri5::new(), 1e-3);
    check(Tsit5::new().rtol(1e-6), 1e-5);
    check(Dop853::new().rtol(1e-6), 1e-5);
    check(Vern9::new().rtol(1e-6), 1e-5);
    check(Taylor::new().rtol(1e-6), 1e-5);
    check(ImplicitMidpoint::new(0.05).fourth_order(), 1e-5);
    check(Radau5::new().rtol(1e-6).with_jacobian(), 1e-5);
    check(Rodas5P::new().rtol(1e-6).with_jacobian(), 1e-5);
}

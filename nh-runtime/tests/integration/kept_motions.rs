//! Motions that are kept: what they give is what the dense output gave, in whatever buffer, and what does not fit
//! together is refused.

use std::ops::ControlFlow;

use nonholonomic::prelude::*;
use nonholonomic::{Method, RecordingError, Segment, Trajectory};

use crate::projected::circling;
use crate::systems::{Driven, Pendulum, Plane, Spring, Torque};

const START: Plane<f64> = Plane { q: 1.0, p: 0.0 };

/// Whether what `P` states of each step give is what the integrator gives within it, to the tolerance.
fn keeps<M: Method<Driven> + Copy, const P: usize>(method: M, target: f64) {
    let mut sim = Integrator::new(Driven, method, 0.3, START);
    let mut motion: Trajectory<Plane<f64>, _, P> = Trajectory::new(Vec::new());
    sim.record(target, &mut motion).unwrap();
    assert_eq!((motion.start(), motion.end()), (Some(0.3), Some(target)));
    assert_eq!((motion.at(0.3), motion.at(target)), (Some(START), Some(*sim.state())));
    assert_eq!(motion.len() as u64, sim.statistics().steps);

    let mut again = Integrator::new(Driven, method, 0.3, START);
    while again.time() != target {
        again.step_towards(target).unwrap();
        let (from, to) = {
            let segment = motion.segments().iter().find(|segment| segment.to() == again.time()).unwrap();
            (segment.from(), segment.to())
        };
        for part in 1..20 {
            let time = from + (to - from) * f64::from(part) / 20.0;
            let (kept, given) = (motion.at(time).unwrap(), again.at(time).unwrap());
            let permitted = method.permitted(&given);
            for ((kept, given), permitted) in kept.to_array().iter().zip(given.to_array()).zip(permitted) {
                assert!((kept - given).abs() <= permitted + 8e-15, "{kept} for {given} at {time}");
            }
        }
        assert_eq!(motion.at(to), Some(*again.state()));
    }
}

#[test]
fn every_method_is_kept_to_its_tolerance() {
    keeps::<_, 8>(Rk4::new(0.05), 4.0);
    keeps::<_, 4>(Rk4::new(0.05), 4.0);
    keeps::<_, 8>(Rk4::new(0.05).compensated(), 4.0);
    keeps::<_, 8>(Bs23::new(), 4.0);
    keeps::<_, 5>(Dopri5::new().rtol(1e-12), 4.0);
    keeps::<_, 8>(Dopri5::new().rtol(1e-6), -4.0);
    keeps::<_, 8>(Tsit5::new().rtol(1e-10), 4.0);
    keeps::<_, 8>(Dop853::new().rtol(1e-13), 4.0);
    keeps::<_, 12>(Vern9::new().rtol(1e-14), 4.0);
    keeps::<_, 8>(Radau5::new().rtol(1e-8), 4.0);
    keeps::<_, 8>(Rodas5P::new().rtol(1e-8), 4.0);
    keeps::<_, 8>(Auto::new().rtol(1e-8), 4.0);
    keeps::<_, 8>(ImplicitMidpoint::new(0.05), 4.0);
    keeps::<_, 8>(GaussLegendre6::new(0.05), -4.0);
}

/// Where times are rounded to a share of the step, as seconds since 1970 are: nothing in this motion depends on the time.
#[test]
fn motions_are_kept_at_any_time() {
    let pendulum = Pendulum { g: 9.81 };
    let start = START;
    for origin in [0.0, 1e6, -1e9, 1.7e9] {
        let mut sim = Integrator::new(pendulum, Rk4::new(1.0 / 1024.0), origin, start);
        let mut motion: Trajectory<_, _> = Trajectory::new(Vec::new());
        sim.record(origin + 1.0, &mut motion).unwrap_or_else(|error| panic!("{origin}: {error}"));
        let mut plain = Integrator::new(pendulum, Rk4::new(1.0 / 1024.0), 0.0, start);
        plain.advance_to(0.5).unwrap();
        let kept = motion.at(origin + 0.5).unwrap();
        let pairs = kept.to_array().into_iter().zip(plain.state().to_array());
        assert!(pairs.into_iter().all(|(kept, plain)| (kept - plain).abs() < 1e-12), "{origin}");
    }
}

/// Beside an end of a step, or another place where a state is kept, by the least that times can differ there.
#[test]
fn motions_are_kept_as_near_to_the_ends_as_times_are() {
    let start = Plane { q: 3.0, p: -1e9 };
    for (from, to) in [(0.0, 1.0), (0.0, -1e-3), (1.0, 0.0), (-0.5, 0.5), (0.0, 1e-300)] {
        let mut sim = Integrator::new(Driven, Rk4::new(1.0), from, start);
        let mut motion: Trajectory<_, _> = Trajectory::new(Vec::new());
        sim.record(to, &mut motion).unwrap();
        let end = *sim.state();
        for least in [5e-324, 1e-310, f64::MIN_POSITIVE, 1e-303] {
            for (place, state) in [(from, start), (to, end)] {
                let inwards = if (from < to) == (place == from) { least } else { -least };
                let kept = motion.at(place + inwards).expect("it is within");
                for (kept, there) in kept.to_array().into_iter().zip(state.to_array()) {
                    assert!(
                        (kept - there).abs() < 1e-14 * there.abs(),
                        "{place} {inwards:e}: {kept:e} {there:e}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_full_buffer_is_said_and_the_run_goes_on_in_another() {
    let mut sim = Integrator::new(Driven, Rk4::new(0.1), 0.0, START);
    let mut first: Trajectory<Plane<f64>, _> = Trajectory::new([Segment::default(); 4]);
    let error = sim.record(1.0, &mut first).unwrap_err();
    assert_eq!(
        error.to_string(),
        "the buffer of 4 steps is full at t = 0.4: give a longer one, a `Vec`, or go on into another",
    );
    assert_eq!(sim.time(), 0.4);
    let mut room = [Segment::default(); 8];
    let mut second: Trajectory<Plane<f64>, _> = Trajectory::new(room.as_mut_slice());
    sim.record(1.0, &mut second).unwrap();
    assert_eq!((first.len(), second.len()), (4, 6));
    assert_eq!(first.at(0.4), second.at(0.4));
    let middle = second.at(0.77).unwrap();
    assert!((middle.q - Driven::solution(0.77).q).abs() < 1e-5);
}

#[test]
fn too_few_states_are_refused_and_the_step_is_taken_back() {
    let mut sim = Integrator::new(Driven, Dop853::new().rtol(1e-12), 0.0, START);
    let mut motion: Trajectory<Plane<f64>, _, 3> = Trajectory::new(Vec::new());
    let error = sim.record(5.0, &mut motion).unwrap_err();
    let RecordingError::TooFewNodes { difference, permitted, nodes: 3, .. } = error else {
        panic!("{error}")
    };
    assert!(difference > permitted);
    assert!(
        error.to_string().contains("keep more states of each step, as in `Trajectory<_, _, 6>`"),
        "{error}"
    );
    let stands = motion.end().unwrap_or(0.0);
    assert_eq!(sim.time(), stands);
    // and goes on from there
    let mut motion: Trajectory<Plane<f64>, _> = Trajectory::new(Vec::new());
    sim.record(5.0, &mut motion).unwrap();
    assert!((motion.at(4.5).unwrap().q - Driven::solution(4.5).q).abs() < 1e-9);
}

#[test]
fn parts_have_to_follow_one_another_in_one_direction() {
    let mut sim = Integrator::new(Driven, Rk4::new(0.1), 0.0, START);
    let mut motion: Trajectory<Plane<f64>, _> = Trajectory::new(Vec::new());
    sim.record(1.0, &mut motion).unwrap();
    let error = sim.record(0.5, &mut motion).unwrap_err();
    assert_eq!(
        error.to_string(),
        "the run turns back at t = 1.0, where a kept motion goes in one direction: keep the way back in a \
         trajectory of its own",
    );
    assert_eq!((sim.time(), motion.len()), (1.0, 10));
    sim.advance_to(2.0).unwrap();
    let error = sim.record(3.0, &mut motion).unwrap_err();
    assert_eq!(
        error.to_string(),
        "the kept motion ends at t = 1.0, and the run begins at 2.0: record all parts of a run, or keep each in a \
         trajectory of its own",
    );
    motion.clear();
    assert!(motion.is_empty());
    sim.record(3.0, &mut motion).unwrap();
    assert_eq!(motion.start(), Some(2.0));
    assert_eq!((motion.at(1.9), motion.at(3.1), motion.at(f64::NAN)), (None, None, None));
}

#[test]
fn jumps_and_other_inputs_between_parts_are_kept() {
    let mut sim = Integrator::new(Pendulum { g: 9.81 }, Dopri5::new().rtol(1e-9), 0.0, START);
    let mut motion: Trajectory<Plane<f64>, _> = Trajectory::new(Vec::new());
    sim.record(1.0, &mut motion).unwrap();
    let before = *sim.state();
    let after = Plane { q: before.q, p: -0.5 * before.p };
    sim.set_state(after);
    sim.set_input(Torque { torque: 2.0 });
    sim.record(2.0, &mut motion).unwrap();
    assert_eq!(motion.at(1.0), Some(after));
    let at_one: Vec<_> = motion.knots().filter(|(time, _)| *time == 1.0).map(|(_, state)| state).collect();
    assert_eq!(at_one, [before, after]);
    assert_eq!(motion.knots().count(), motion.len() + 2);
    assert!((motion.at(1.0 - 1e-9).unwrap().p - before.p).abs() < 1e-6);
}

#[test]
fn runs_with_events_are_kept_from_jump_to_jump() {
    let mut sim = Integrator::new(Pendulum { g: 9.81 }, Dopri5::new().rtol(1e-9), 0.0, START);
    let mut motion: Trajectory<Plane<f64>, _> = Trajectory::new(Vec::new());
    let lowest = Events::new(|_, x: &Plane<f64>, _: &Torque<f64>| [x.q]);
    let mut passages = Vec::new();
    let ended = sim.record_acting(5.0, &lowest, &mut motion, |sim, passage| {
        let slower = Plane { q: passage.state.q, p: 0.5 * passage.state.p };
        passages.push((passage.time, passage.state, slower));
        sim.set_state(slower);
        ControlFlow::Continue(())
    });
    assert_eq!(ended.unwrap(), None);
    assert_eq!((motion.end(), sim.time()), (Some(5.0), 5.0));
    assert!(passages.len() >= 4, "{}", passages.len());
    assert_eq!(motion.knots().count(), motion.len() + 1 + passages.len());
    for (time, before, after) in passages {
        assert_eq!(motion.at(time), Some(after));
        assert!((motion.at(time - 1e-10).unwrap().p - before.p).abs() < 1e-8);
    }
}

#[test]
fn other_units_give_the_same_bits() {
    fn middle<T: Real>(unit: T) -> Vec<f64> {
        #[derive(Clone, Copy)]
        struct Decay<T>(T);
        impl<T: Real> Dynamics for Decay<T> {
            type State = Plane<T>;
            type Input = ();
            fn derivative(&self, _t: T, x: &Plane<T>, (): &()) -> Plane<T> {
                Plane { q: -x.q / self.0, p: (x.q - x.p) / self.0 }
            }
        }
        let method = Dopri5::new().rtol(T::from_f64(1e-6)).atol(T::from_f64(1e-9) * unit);
        let start = Plane { q: unit, p: T::ZERO };
        let mut sim =
            Integrator::new(Decay(unit), method.first_step(T::from_f64(0.125) * unit), T::ZERO, start);
        let mut motion: Trajectory<Plane<T>, _> = Trajectory::new([Segment::default(); 64]);
        sim.record(unit * T::from_f64(3.0), &mut motion).unwrap();
        let at = |t: f64| motion.at(T::from_f64(t) * unit).unwrap();
        [0.3, 1.7, 2.9].iter().flat_map(|&t| at(t).to_array().map(|x| (x / unit).to_f64())).collect()
    }
    assert_eq!(middle(1.0_f64), middle(2.0_f64.powi(200)));
    assert_eq!(middle(1.0_f64), middle(2.0_f64.powi(-300)));
    assert_eq!(middle(1.0_f32), middle(2.0_f32.powi(30)));
}

/// An oscillator with a relative tolerance alone: where it passes zero, a step may err by as much as before and after.
#[test]
fn what_passes_zero_is_kept() {
    for phase in 0..200 {
        let (p, q) = (f64::from(phase) * 0.0314).sin_cos();
        let mut sim = Integrator::new(Spring, Vern9::new().rtol(1e-6).atol(0.0), 0.0, Plane { q, p });
        let mut motion: Trajectory<Plane<f64>, _> = Trajectory::new(Vec::new());
        sim.record(20.0, &mut motion).unwrap_or_else(|error| panic!("{phase}: {error}"));
    }
}

/// Where the end of a step is not projected, and what lies within is, more states of each step are no way out.
#[test]
fn of_seldom_projections_it_is_told_what_to_do() {
    for every in [2, 3, 7] {
        let mut sim = circling(Projected::new(Rk4::new(0.2), every));
        let mut motion: Trajectory<Plane<f64>, _, 24> = Trajectory::new(Vec::new());
        let error = sim.record(5.0, &mut motion).unwrap_err();
        assert!(matches!(error, RecordingError::TooFewNodes { .. }), "{error:?}");
        let told = error.to_string();
        assert!(
            told.ends_with("or, of a `Projected` method that does not, project after each step"),
            "{told}"
        );
    }
    let mut motion: Trajectory<Plane<f64>, _, 24> = Trajectory::new(Vec::new());
    circling(Projected::new(Rk4::new(0.2), 1)).record(5.0, &mut motion).unwrap();
}

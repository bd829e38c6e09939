//! Columns across events, mathematics (53).

use core::ops::ControlFlow;

use nonholonomic::nalgebra::SMatrix;
use nonholonomic::prelude::*;
use nonholonomic::sensitivity::{
    By, ColumnTolerance, Crossing, Jumps, SensitivityError, Variational, advance_across,
};
use nonholonomic::{D, Jacobian};

use crate::models::Numbers;

/// A ball that falls freely, and a coordinate along the ground: x, height, and their rates.
#[derive(Clone, Copy, Debug)]
struct Ball {
    gravity: f64,
}

impl Dynamics for Ball {
    type State = Numbers<f64, 4>;
    type Input = ();
    fn derivative(&self, _t: f64, Numbers([_, _, vx, vy]): &Numbers<f64, 4>, (): &()) -> Numbers<f64, 4> {
        Numbers([*vx, *vy, 0.0, -self.gravity])
    }
}

impl Jacobian for Ball {
    type InputDim = D<0>;
    fn state_jacobian(&self, _t: f64, _x: &Numbers<f64, 4>, (): &()) -> [[f64; 4]; 4] {
        [[0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0], [0.0; 4], [0.0; 4]]
    }
    fn input_jacobian(&self, _t: f64, _x: &Numbers<f64, 4>, (): &()) -> [[f64; 0]; 4] {
        [[]; 4]
    }
}

/// Ground that rises with `lift` per time, and a wall at x = 3 if it is there.
struct Ground {
    restitution: f64,
    lift: f64,
    wall: f64,
}

/// Columns: by height, by speed along, by gravity, by the restitution, by the lift.
const BY: [By; 5] = [By::Start(1), By::Start(2), By::Parameter(0), By::Parameter(1), By::Parameter(2)];

impl Jumps<4, 5, 2> for Ground {
    fn events<A: Scalar>(&self, t: A, [x, y, _, _]: &[A; 4], by: &[A; 5]) -> [A; 2] {
        [*y - (A::from_f64(self.lift) + by[4]) * t, A::from_f64(self.wall) - *x]
    }
    fn reset<A: Scalar>(&self, event: usize, _t: A, [x, y, vx, vy]: &[A; 4], by: &[A; 5]) -> [A; 4] {
        let e = A::from_f64(self.restitution) + by[3];
        let lift = A::from_f64(self.lift) + by[4];
        if event == 0 { [*x, *y, *vx, lift - e * (*vy - lift)] } else { [*x, *y, -*vx, *vy] }
    }
    fn directions(&self) -> [Direction; 2] {
        [Direction::Closing; 2]
    }
}

fn motion(
    gravity: f64,
) -> Variational<Ball, impl Fn(&Ball, f64, &Numbers<f64, 4>, &()) -> SMatrix<f64, 4, 3> + Copy, 5> {
    Variational::new(Ball { gravity }, BY).by_parameters(|_: &Ball, _, _: &Numbers<f64, 4>, (): &()| {
        let mut columns = SMatrix::<f64, 4, 3>::zeros();
        columns[(3, 0)] = -1.0;
        columns
    })
}

/// Where the ball is at a time after its second bounce, from its data; and the times of both bounces.
fn closed_form([height, along, gravity, e, lift]: [f64; 5], t: f64) -> ([f64; 4], [f64; 2]) {
    // seen from the ground that rises: it starts at height with speed −lift
    let first = (-lift + (lift * lift + 2.0 * gravity * height).sqrt()) / gravity;
    let second = first + 2.0 * e * (lift + gravity * first) / gravity;
    let up = e * e * (lift + gravity * first);
    let since = t - second;
    let y = lift * t + up * since - gravity / 2.0 * since * since;
    ([along * t, y, along, lift + up - gravity * since], [first, second])
}

const DATA: [f64; 5] = [1.0, 0.7, 9.81, 0.8, 0.3];

/// The derivatives of the closed form by complex step would need complex numbers: central differences of it are exact
/// to ten digits, since no integration is in them.
fn slopes(k: usize, t: f64) -> ([f64; 4], [f64; 2]) {
    let at = |by: f64| {
        let mut data = DATA;
        data[k] += by;
        closed_form(data, t)
    };
    let d = 1e-3;
    let (a, b, c, e) = (at(d), at(-d), at(2.0 * d), at(-2.0 * d));
    let slope = |a: f64, b: f64, c: f64, e: f64| (8.0 * (a - b) - (c - e)) / (12.0 * d);
    (
        core::array::from_fn(|i| slope(a.0[i], b.0[i], c.0[i], e.0[i])),
        core::array::from_fn(|i| slope(a.1[i], b.1[i], c.1[i], e.1[i])),
    )
}

#[test]
fn two_bounces_on_ground_that_moves() {
    let motion = motion(DATA[2]);
    let start = motion.start(&Numbers([0.0, DATA[0], DATA[1], 0.0])).unwrap();
    let method = Dop853::new().tolerance(ColumnTolerance::new(1e-12, 1e-12));
    let mut sim = Integrator::new(motion, method, 0.0, start);
    let ground = Ground { restitution: DATA[3], lift: DATA[4], wall: 100.0 };
    let mut times = Vec::new();
    let end = advance_across(&mut sim, 1.4, &ground, |jump| {
        times.push((jump.time, jump.time_by));
        ControlFlow::Continue(())
    });
    assert_eq!(end, Ok(None));
    let (expected, bounces) = closed_form(DATA, 1.4);
    assert_eq!(times.len(), 2);
    for (found, expected) in sim.state().state.0.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-9, "{found} {expected}");
    }
    for k in 0..5 {
        let (slope, delays) = slopes(k, 1.4);
        for (found, expected) in sim.state().columns[k].0.iter().zip(slope) {
            assert!((found - expected).abs() < 1e-8, "column {k}: {found} {expected}");
        }
        for ((found, bounce), expected) in times.iter().zip(bounces).zip(delays) {
            assert!((found.0 - bounce).abs() < 1e-10 && (found.1[k] - expected).abs() < 1e-8);
        }
    }
}

/// A visit ends the run at its jump, and numbers give the same as jets.
#[test]
fn numbers_give_what_jets_give() {
    let motion = motion(DATA[2]);
    let start = motion.start(&Numbers([0.0, DATA[0], DATA[1], 0.0])).unwrap();
    let mut sim = Integrator::new(motion, Dop853::new().rtol(1e-12), 0.0, start);
    let ground = Ground { restitution: DATA[3], lift: DATA[4], wall: 100.0 };
    let jump = advance_across(&mut sim, 9.0, &ground, |_| ControlFlow::Break(())).unwrap().unwrap();
    assert_eq!((sim.time(), *sim.state()), (jump.time, jump.after));
    let ball = Ball { gravity: DATA[2] };
    let (e, speed) = (DATA[3], jump.before.state.0[3]);
    let crossing = Crossing {
        rate_before: ball.derivative(jump.time, &jump.before.state, &()).0,
        rate_after: ball.derivative(jump.time, &jump.after.state, &()).0,
        event_by_time: -DATA[4],
        event_by_state: [0.0, 1.0, 0.0, 0.0],
        event_by_columns: [0.0, 0.0, 0.0, 0.0, -jump.time],
        reset_by_time: [0.0; 4],
        reset_by_state: [
            [1.0, 0.0, 0.0, 0.0],
            [0.0, 1.0, 0.0, 0.0],
            [0.0, 0.0, 1.0, 0.0],
            [0.0, 0.0, 0.0, -e],
        ],
        reset_by_columns: [
            [0.0; 4],
            [0.0; 4],
            [0.0; 4],
            [0.0, 0.0, 0.0, DATA[4] - speed],
            [0.0, 0.0, 0.0, 1.0 + e],
        ],
    };
    let after = crossing.columns(jump.time, &jump.before.columns.map(|column| column.0)).unwrap();
    for (found, expected) in after.columns.iter().flatten().zip(jump.after.columns.iter().flat_map(|c| c.0)) {
        assert!((found - expected).abs() < 1e-14 * expected.abs().max(1.0), "{found} {expected}");
    }
    for (found, expected) in after.times.iter().zip(jump.time_by) {
        assert!((found - expected).abs() < 1e-15);
    }
}

/// The sign changes at t = 1 with all derivatives zero.
struct Flat;

impl Jumps<4, 5, 1> for Flat {
    fn events<A: Scalar>(&self, t: A, _x: &[A; 4], _by: &[A; 5]) -> [A; 1] {
        [(A::ONE - t).powi(3)]
    }
    fn reset<A: Scalar>(&self, _event: usize, _t: A, x: &[A; 4], _by: &[A; 5]) -> [A; 4] {
        *x
    }
}

/// It touches the ceiling's height at the top of its flight; and floor and wall are reached in one instant.
#[test]
fn what_has_no_derivative_is_refused() {
    let flat = Crossing {
        rate_before: [1.0, -1.0],
        rate_after: [0.0, 0.0],
        event_by_time: 0.0,
        event_by_state: [1.0, 1.0],
        event_by_columns: [],
        reset_by_time: [0.0, 0.0],
        reset_by_state: [[1.0, 0.0], [0.0, 1.0]],
        reset_by_columns: [],
    };
    let found = flat.columns(2.0, &[]);
    assert_eq!(found, Err(SensitivityError::Grazing { event: 0, time: 2.0, rate: 0.0 }));
    assert!(found.unwrap_err().to_string().contains("touches"));

    let motion = motion(9.81);
    let start = motion.start(&Numbers([0.0, 9.0, 1.0, 0.0])).unwrap();
    let mut sim = Integrator::new(motion, Dop853::new(), 0.0, start);
    let found = advance_across(&mut sim, 2.0, &Flat, |_| ControlFlow::Continue(()));
    assert!(matches!(found, Err(SensitivityError::Grazing { event: 0, .. })), "{found:?}");

    // it falls for one second, and moves along for as long
    let motion = self::motion(2.0);
    let start = motion.start(&Numbers([0.0, 1.0, 1.0, 0.0])).unwrap();
    let mut sim = Integrator::new(motion, Dop853::new(), 0.0, start);
    let corner = Ground { restitution: 0.5, lift: 0.0, wall: 1.0 };
    let found = advance_across(&mut sim, 2.0, &corner, |_| ControlFlow::Continue(()));
    assert!(matches!(found, Err(SensitivityError::Simultaneous { .. })), "{found:?}");
    assert!((sim.time() - 1.0).abs() < 1e-9);
}

/// Floor and wall that are reached within rounding of one another have no order, in either direction of time; and what
/// leaves the floor while the wall is met is no event.
#[test]
fn events_within_rounding_are_at_one_time_forwards_and_backwards() {
    let ended = |ahead: f64, place: f64, [along, up]: [f64; 2], height: f64| {
        let motion = motion(2.0);
        let start = motion.start(&Numbers([place, height, ahead * along, ahead * up])).unwrap();
        let mut sim = Integrator::new(motion, Dop853::new().rtol(1e-12), 0.0, start);
        let corner = Ground { restitution: 0.5, lift: 0.0, wall: 1.0 };
        advance_across(&mut sim, ahead * 1.5, &corner, |_| ControlFlow::Continue(()))
    };
    for ahead in [1.0, -1.0] {
        for off in -90..90 {
            let place = 0.3 + f64::from(off) * 1.1e-16;
            let found = ended(ahead, place, [0.7, 0.0], 1.0);
            assert!(matches!(found, Err(SensitivityError::Simultaneous { .. })), "{ahead} {off}: {found:?}");
        }
        // thrown from the floor at the wall
        let found = ended(ahead, 1.0 - 1e-17, [1.0, 2.0], 0.0);
        assert_eq!(found, Ok(None), "{ahead}");
    }
}

/// A ceiling at this height.
struct Ceiling(f64);

impl Jumps<4, 5, 1> for Ceiling {
    fn events<A: Scalar>(&self, _t: A, [_, y, _, _]: &[A; 4], _by: &[A; 5]) -> [A; 1] {
        [A::from_f64(self.0) - *y]
    }
    fn reset<A: Scalar>(&self, _event: usize, _t: A, [x, y, vx, vy]: &[A; 4], _by: &[A; 5]) -> [A; 4] {
        [*x, *y, *vx, -*vy]
    }
}

/// Thrown to the height of a ceiling and no farther, the ball crosses it by rounding, at some rate; thrown a little farther
/// it knocks against it.
#[test]
fn what_turns_within_rounding_grazes() {
    for (unit, clock) in [(1.0, 0.0), (1e-9, 0.0), (1e9, 0.0), (1.0, 100.0)] {
        let ended = |ceiling: f64| {
            let motion = motion(2.0 * unit);
            let start = motion.start(&Numbers([0.0, 0.5 * unit, 0.0, 2.0 * unit])).unwrap();
            let mut sim = Integrator::new(motion, Dopri5::new(), clock, start);
            advance_across(&mut sim, clock + 1.3, &Ceiling(ceiling * unit), |_| ControlFlow::Break(()))
        };
        let found = ended(1.5);
        assert!(
            matches!(found, Ok(None) | Err(SensitivityError::Grazing { event: 0, .. })),
            "{unit:e}, {clock}: {found:?}"
        );
        // the speed there is 2 √1e-8, and the time changes by what the height changes over that
        let knock = ended(1.5 - 1e-8).unwrap().unwrap();
        let [by_height, ..] = knock.time_by;
        assert!((by_height * unit * 2e-4 + 1.0).abs() < 1e-3, "{unit:e}, {clock}: {by_height}");
    }
}

/// A bouncing ball that comes to rest ends in an error, as there is no motion beyond.
#[test]
fn bounces_without_end_are_told() {
    let motion = motion(9.81);
    let start = motion.start(&Numbers([0.0, 1.0, 0.0, 0.0])).unwrap();
    for restitution in [0.5, 0.0] {
        let mut sim = Integrator::new(motion, Dopri5::new(), 0.0, start);
        let ground = Ground { restitution, lift: 0.0, wall: 1.0 };
        let found = advance_across(&mut sim, 5.0, &ground, |_| ControlFlow::Continue(()));
        assert!(
            matches!(found, Err(SensitivityError::Integration(IntegrationError::EventsAccumulate { .. }))),
            "{restitution}: {found:?}"
        );
    }
}

//! Batches of rollouts equal single rollouts, bit for bit, whatever the lanes and the cores.

use nh_lanes::{Random, Sleigh, SleighInput, SleighState, starts};
use nonholonomic::batch::{self, gather, pack, scatter, unpack};
use nonholonomic::prelude::*;
use nonholonomic::wide::f64x4;

const STEPS: usize = 60;

/// One rollout.
#[derive(Clone, Debug, PartialEq)]
struct Trial {
    mass: f64,
    inertia: f64,
    torques: [f64; STEPS],
    state: SleighState<f64>,
    cost: f64,
}

fn trials(count: usize) -> Vec<Trial> {
    let mut random = Random(5);
    let mut trial = |state| Trial {
        mass: 2.0 + random.number(),
        inertia: 1.5 + random.number(),
        torques: std::array::from_fn(|_| random.number()),
        state,
        cost: 0.0,
    };
    starts(count).into_iter().map(&mut trial).collect()
}

fn system<L: Lanes<Lane = f64>>(mass: L, inertia: L) -> Sleigh<L> {
    let number = L::from_f64;
    Sleigh { m: mass, J: inertia, a: number(0.2), b: number(0.1), c: number(0.05) }
}

/// The rollouts of one group.
fn roll_out<L: Lanes<Lane = f64>>(group: &mut [Trial]) {
    let sleigh = system::<L>(gather(group, |trial| trial.mass), gather(group, |trial| trial.inertia));
    let mut state: SleighState<L> = pack(group, |trial| trial.state);
    let mut cost = L::ZERO;
    for step in 0..STEPS {
        let input = SleighInput { torque: gather(group, |trial| trial.torques[step]) };
        state = Rk4::step(&sleigh, L::ZERO, L::from_f64(0.02), &state, &input);
        cost += state.theta * state.theta;
    }
    unpack(&state, group, |trial, state| trial.state = state);
    scatter(cost, group, |trial, cost| trial.cost = cost);
}

/// The same without any helper.
fn alone(trial: &Trial) -> Trial {
    let sleigh = system(Fast(trial.mass), Fast(trial.inertia));
    let mut state = SleighState::from(trial.state.to_array().map(Fast));
    let mut cost = Fast(0.0);
    for torque in trial.torques {
        state = Rk4::step(&sleigh, Fast(0.0), Fast(0.02), &state, &SleighInput { torque: Fast(torque) });
        cost += state.theta * state.theta;
    }
    Trial { state: SleighState::from(state.to_array().map(|x| x.0)), cost: cost.0, ..trial.clone() }
}

#[test]
fn batches_equal_single_rollouts() {
    // full groups and every remainder
    for count in [0, 1, 4, 5, 11, 18] {
        let expected: Vec<_> = trials(count).iter().map(alone).collect();
        let [mut one_by_one, mut in_lanes, mut on_all_cores] = [(); 3].map(|()| trials(count));
        batch::for_each::<Fast<f64>, _>(&mut one_by_one, roll_out::<Fast<f64>>);
        batch::for_each::<f64x4, _>(&mut in_lanes, roll_out::<f64x4>);
        batch::par_for_each::<f64x4, _>(&mut on_all_cores, roll_out::<f64x4>);
        assert_eq!(one_by_one, expected);
        assert_eq!(in_lanes, expected);
        assert_eq!(on_all_cores, expected);
    }
}

#[test]
fn a_member_that_fails_does_not_harm_the_others() {
    let mut members = trials(6);
    members[1].torques[10] = f64::NAN;
    batch::for_each::<f64x4, _>(&mut members, roll_out::<f64x4>);
    let expected: Vec<_> = trials(6).iter().map(alone).collect();
    for (i, (member, expected)) in members.iter().zip(&expected).enumerate() {
        assert_eq!(member == expected, i != 1);
    }
}

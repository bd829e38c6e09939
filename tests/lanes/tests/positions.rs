//! Position constraints in lanes: steps with their one correction equal those of single numbers, bit for bit, and
//! `project` goes on until the last lane is where it belongs.

use nonholonomic::prelude::*;
use nonholonomic::wide::f64x4;
use nonholonomic::{Fast, Lanes};

#[nonholonomic(
    base { crank, coupler, rocker }
    let along(angle) = [cos(angle), sin(angle)];
    holonomic { closure: a * along(crank) + b * along(coupler) = c * along(rocker) + [d, 0]; }
    lagrangian { J / 2 * (der(crank)^2 + der(coupler)^2 + der(rocker)^2) }
)]
#[derive(Clone, Copy, Debug)]
struct Linkage<T> {
    a: T,
    b: T,
    c: T,
    d: T,
    J: T,
}

fn linkage<T: Scalar>() -> Linkage<T> {
    let [a, b, c, d, inertia] = [1.0, 3.0, 2.5, 3.0, 0.1].map(T::from_f64);
    Linkage { a, b, c, d, J: inertia }
}

/// Cranks at four angles, on their constraints.
fn starts() -> [LinkageState<Fast<f64>>; 4] {
    [0.2, 0.9, 2.0, 4.0].map(|crank| {
        let [crank, coupler, rocker, rate] = [crank, 0.8, 1.8, 20.0].map(Fast::from_f64);
        let rough = LinkageState { crank, coupler, rocker, crank_dot: rate, ..LinkageState::default() };
        linkage().assemble_holding(Fast(0.0), &rough, &[LinkageCoordinate::crank]).unwrap()
    })
}

fn packed(states: &[LinkageState<Fast<f64>>; 4]) -> LinkageState<f64x4> {
    let of = |component: usize| f64x4::from_lanes(|lane| states[lane].to_array()[component].0);
    LinkageState::from_array(std::array::from_fn(of))
}

fn open(state: &LinkageState<f64x4>) -> f64 {
    let left: [f64x4; 4] = linkage().constraint_residual(f64x4::from(0.0), state).into();
    let lanes = left.iter().flat_map(|left| (0..4).map(|lane| left.lane(lane).abs()));
    lanes.fold(0.0, f64::max)
}

#[test]
fn steps_in_lanes_are_those_of_numbers() {
    let mut numbers = starts();
    let mut lanes = packed(&numbers);
    let system = linkage::<f64x4>();
    let mut worst = 0.0_f64;
    for _ in 0..1000 {
        lanes = Rk4::step(&system, f64x4::from(0.0), f64x4::from(0.001), &lanes, &());
        numbers = numbers.map(|state| Rk4::step(&linkage(), Fast(0.0), Fast(0.001), &state, &()));
        worst = worst.max(open(&lanes));
    }
    assert_eq!(lanes.to_array(), packed(&numbers).to_array());
    // one correction a step leaves the square of what the step was off
    assert!(worst < 1e-12, "{worst:e}");
}

#[test]
fn lanes_are_projected_together() {
    let mut lanes = packed(&starts());
    // three lanes hold, one is far off
    lanes.rocker += f64x4::from([0.0, 0.0, 0.0, 1e-2]);
    assert!(open(&lanes) > 1e-3);
    linkage::<f64x4>().project(f64x4::from(0.0), &mut lanes).unwrap();
    assert!(open(&lanes) < 1e-14, "{:e}", open(&lanes));
}

/// The lanes that were there already stay to rounding, and one that does not arrive leaves all as they were.
#[test]
fn lanes_that_wait_for_others_equal_numbers_to_rounding() {
    let mut numbers = starts();
    for (state, off) in numbers.iter_mut().zip([1e-2, 1e-9, 0.0, 1e-4]) {
        state.rocker += Fast(off);
    }
    let mut lanes = packed(&numbers);
    linkage::<f64x4>().project(f64x4::from(0.0), &mut lanes).unwrap();
    let alone = numbers.map(|mut state| {
        linkage().project(Fast(0.0), &mut state).unwrap();
        state
    });
    for (ours, theirs) in lanes.to_array().iter().zip(packed(&alone).to_array()) {
        for lane in 0..4 {
            let off = (ours.lane(lane) - theirs.lane(lane)).abs();
            assert!(off <= 1e-13 * theirs.lane(lane).abs().max(1.0), "{ours:?} {theirs:?}");
        }
    }
    numbers[2].coupler = Fast(f64::NAN);
    let mut broken = packed(&numbers);
    assert!(linkage::<f64x4>().project(f64x4::from(0.0), &mut broken).is_err());
    let bits = |state: &LinkageState<f64x4>| state.to_array().map(|x| x.to_array().map(f64::to_bits));
    assert_eq!(bits(&broken), bits(&packed(&numbers)));
}

//! Columns along the steps of implicit methods.

use nonholonomic::methods::{Auto, Method, Uniform};
use nonholonomic::prelude::*;
use nonholonomic::sensitivity::{By, ColumnTolerance, LinearizedStep, Variational};
use nonholonomic::{D, Jacobian};

use crate::models::{Free, Numbers, Pendulum, Push, close};

const PENDULUM: Pendulum<f64> = Pendulum { k: 1.3, c: 0.2 };
const START: [f64; 3] = [0.7, -0.4, 0.1];
const SOME: [By; 4] = [By::Start(0), By::Input(0), By::Parameter(0), By::Parameter(1)];

macro_rules! motion {
    () => {
        Variational::new(PENDULUM, SOME).by_parameters(
            |system: &Pendulum<f64>, t, x: &Numbers<f64, 3>, u: &Push<f64>| system.by_parameters(t, x, u),
        )
    };
}

/// Columns of the exact motion, to many digits.
fn exact() -> [Numbers<f64, 3>; 4] {
    let motion = motion!();
    let start = motion.start(&Numbers(START)).unwrap();
    let mut sim =
        Integrator::new(motion, Dop853::new().tolerance(ColumnTolerance::new(1e-13, 1e-13)), 0.0, start);
    sim.set_input(Push([0.3]));
    sim.advance_to(2.0).unwrap();
    sim.state().columns
}

fn error<A: Method<Pendulum<f64>> + LinearizedStep<f64>>(method: A) -> f64 {
    let motion = motion!();
    let mut columns = motion.start(&Numbers(START)).unwrap().columns;
    let mut sim = Integrator::new(PENDULUM, method, 0.0, Numbers(START));
    sim.set_input(Push([0.3]));
    motion.advance(&mut sim, 2.0, &mut columns).unwrap();
    let pairs = columns.iter().zip(exact());
    pairs.flat_map(|(a, b)| core::array::from_fn::<_, 3, _>(|i| (a.0[i] - b.0[i]).abs())).fold(0.0, f64::max)
}

/// The derivative of the steps is of the order of the method.
#[test]
fn the_derivatives_of_the_steps_converge() {
    let ratios = [
        (error(ImplicitMidpoint::new(0.1)) / error(ImplicitMidpoint::new(0.05)), 4.0),
        (error(GaussLegendre4::new(0.2)) / error(GaussLegendre4::new(0.1)), 16.0),
        (error(GaussLegendre6::new(0.4).with_jacobian()) / error(GaussLegendre6::new(0.2)), 64.0),
        (error(Rk4::new(0.1)) / error(Rk4::new(0.05)), 16.0),
    ];
    for (ratio, expected) in ratios {
        assert!(ratio > 0.7 * expected && ratio < 1.5 * expected, "{ratio} for {expected}");
    }
    assert!(error(Radau5::new().rtol(1e-9)) < 1e-6);
    assert!(error(Radau5::new().rtol(1e-11).with_jacobian()) < 1e-8);
    assert!(error(Dopri5::new().rtol(1e-10)) < 1e-8);
}

/// Explicit steps have the same columns both ways.
#[test]
fn both_ways_agree_for_explicit_methods() {
    let motion = motion!();
    let start = motion.start(&Numbers(START)).unwrap();
    let mut columns = start.columns;
    let mut alone = Integrator::new(PENDULUM, Dop853::fixed(0.1), 0.0, start.state);
    let mut sim = Integrator::new(motion, Dop853::fixed(0.1), 0.0, start);
    alone.set_input(Push([0.3]));
    sim.set_input(Push([0.3]));
    sim.advance_to(5.0).unwrap();
    motion.advance(&mut alone, 5.0, &mut columns).unwrap();
    assert_eq!(*alone.state(), sim.state().state);
    for (found, expected) in columns.iter().zip(&sim.state().columns) {
        found.0.iter().zip(expected.0).for_each(|(found, expected)| close(*found, expected, 1024.0));
    }
}

/// Methods that keep dq ∧ dp have columns that keep it, to round-off; an explicit one of order 4 does not.
#[test]
fn symplectic_steps_keep_the_area() {
    fn area<A: Method<Free> + LinearizedStep<f64>>(method: A) -> f64 {
        let motion = Variational::new(Free, [By::Start(0), By::Start(1)]);
        let mut columns = motion.start(&Numbers([1.9, 0.3])).unwrap().columns;
        let mut sim = Integrator::new(Free, method, 0.0, Numbers([1.9, 0.3]));
        motion.advance(&mut sim, 40.0, &mut columns).unwrap();
        let [Numbers(a), Numbers(b)] = columns;
        (a[0] * b[1] - a[1] * b[0] - 1.0).abs()
    }
    assert!(area(ImplicitMidpoint::new(0.2)) < 1e-11);
    assert!(area(GaussLegendre4::new(0.25)) < 1e-11);
    assert!(area(GaussLegendre6::new(0.5)) < 1e-11);
    assert!(area(Rk4::new(0.2)) > 1e-6);
}

/// An implicit method solves the variational equations like any other system.
#[test]
fn the_wrapped_system_is_one_for_implicit_methods() {
    let motion = motion!();
    let start = motion.start(&Numbers(START)).unwrap();
    let mut sim = Integrator::new(motion, Radau5::new().rtol(1e-9), 0.0, start);
    sim.set_input(Push([0.3]));
    sim.advance_to(2.0).unwrap();
    for (found, expected) in sim.state().columns.iter().zip(exact()) {
        assert!(found.0.iter().zip(expected.0).all(|(a, b)| (a - b).abs() < 1e-6), "{found:?} {expected:?}");
    }
}

/// What follows another component in no time, and shows that only where the two are moved apart.
#[derive(Clone, Copy, Debug)]
struct Follows;

impl Dynamics for Follows {
    type State = Numbers<f64, 2>;
    type Input = ();
    fn derivative(&self, t: f64, Numbers([x, y]): &Numbers<f64, 2>, (): &()) -> Numbers<f64, 2> {
        Numbers([-1e5 * (x - 1.000_01 * y), t.cos() - y])
    }
}

impl Jacobian for Follows {
    type InputDim = D<0>;
    fn state_jacobian(&self, _t: f64, _x: &Numbers<f64, 2>, (): &()) -> [[f64; 2]; 2] {
        [[-1e5, 1e5 * 1.000_01], [0.0, -1.0]]
    }
    fn input_jacobian(&self, _t: f64, _x: &Numbers<f64, 2>, (): &()) -> [[f64; 0]; 2] {
        [[]; 2]
    }
}

/// Columns that are not looked at have no part in the choice of the method either.
#[test]
fn columns_that_are_not_looked_at_switch_no_method() {
    let uniform = Uniform::of(1e-6, 1e-6);
    let mut alone = Integrator::new(Follows, Auto::new().rtol(1e-6), 0.0, Numbers([0.4, 0.4]));
    alone.advance_to(30.0).unwrap();
    let motion = Variational::new(Follows, [By::Start(0), By::Start(1)]);
    let start = motion.start(&Numbers([0.4, 0.4])).unwrap();
    let tolerance = ColumnTolerance::of_state(uniform);
    let method = Auto::of(Tsit5::new().tolerance(tolerance), Radau5::new().tolerance(tolerance));
    let mut sim = Integrator::new(motion, method, 0.0, start);
    sim.advance_to(30.0).unwrap();
    assert_eq!((alone.statistics().switches, sim.statistics().switches), (1, 1));
    assert_eq!(sim.statistics().steps, alone.statistics().steps);
}

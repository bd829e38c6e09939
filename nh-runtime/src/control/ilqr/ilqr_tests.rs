//! One iteration of a linear system, an optimum between bounds, and a horizon that recedes.

use super::super::{Expansion, Quadratic, Regulator, shooting_gradient};
use super::*;
use nalgebra::{Matrix2, SMatrix, matrix, vector};

/// A mass by its place and speed, with the derivatives of these by the force.
struct Linear(SMatrix<f64, 2, 1>);

const PUSHED: Linear = Linear(matrix![0.005; 0.1]);

impl Model<f64, 2, 1> for Linear {
    fn step(&self, tick: usize, x: &SVector<f64, 2>, u: &SVector<f64, 1>) -> SVector<f64, 2> {
        let (a, b) = self.linearized(tick, x, u);
        a * x + b * u
    }
    fn linearized(
        &self,
        _tick: usize,
        _x: &SVector<f64, 2>,
        _u: &SVector<f64, 1>,
    ) -> (SMatrix<f64, 2, 2>, SMatrix<f64, 2, 1>) {
        (matrix![1.0, 0.1; 0.0, 1.0], self.0)
    }
}

#[test]
fn of_a_linear_system_one_iteration_is_the_regulator() {
    let cost = Quadratic {
        goal: vector![0.0, 0.0],
        state: vector![1.0, 1.0],
        input: vector![0.5],
        end: vector![0.0, 0.0],
    };
    let mut plan = Ilqr::<f64, 2, 1, 300>::new(vector![0.0]);
    let start = vector![1.0, 0.0];
    plan.improve(&PUSHED, &cost, &start).unwrap();
    let (a, b) = PUSHED.linearized(0, &start, &vector![0.0]);
    let stationary = Regulator::stationary(&a, &b, &Matrix2::identity(), &matrix![0.5]).unwrap();
    assert!((plan.inputs()[0] - stationary.input(&start)).norm() < 1e-10);
    let again = plan.improve(&PUSHED, &cost, &start).unwrap();
    assert!(again.promised.abs() < 1e-12 && again.decrease.abs() < 1e-12);
}

/// An input that two equal bounds hold is none, whatever it costs: without any curvature, too.
#[test]
fn an_input_between_equal_bounds_stays_there() {
    /// Inputs cost as much as they are.
    struct Price(f64);
    impl Cost<f64, 2, 1> for Price {
        fn stage(&self, _tick: usize, _x: &SVector<f64, 2>, u: &SVector<f64, 1>) -> f64 {
            self.0 * u[0]
        }
        fn stage_expansion(
            &self,
            _tick: usize,
            _x: &SVector<f64, 2>,
            _u: &SVector<f64, 1>,
        ) -> Expansion<f64, 2, 1> {
            Expansion { u: vector![self.0], ..Expansion::zero() }
        }
        fn end(&self, _x: &SVector<f64, 2>) -> f64 {
            0.0
        }
        fn end_expansion(&self, _x: &SVector<f64, 2>) -> Expansion<f64, 2, 1> {
            Expansion::zero()
        }
    }
    for price in [1.0, -3.0, 0.0, 1e300] {
        for force in [0.0, 0.5, -1e-9] {
            let held = vector![force];
            let mut plan = Ilqr::<f64, 2, 1, 7>::new(vector![9.0]).bounds(held, held);
            let found = plan.solve(&PUSHED, &Price(price), &vector![1.0, 0.0], 1e-12, 5);
            let found = found.unwrap_or_else(|error| panic!("{price} {force}: {error}"));
            assert_eq!((found.decrease, found.promised), (0.0, 0.0));
            assert_eq!(plan.inputs(), &[held; 7]);
            assert_eq!(plan.gains(), &[matrix![0.0, 0.0]; 7]);
        }
    }
}

/// The last force moves the place after the end, and costs nothing: it is not felt.
#[test]
fn an_input_that_is_not_felt_stays_as_it_is() {
    let late = Linear(matrix![0.0; 0.1]);
    let cost = Quadratic {
        goal: vector![0.3, 0.0],
        state: vector![0.0, 0.0],
        input: vector![0.0],
        end: vector![1.0, 0.0],
    };
    let start = vector![0.0, 0.0];
    for guess in [0.0, 0.4] {
        let mut plan = Ilqr::<f64, 2, 1, 20>::new(vector![guess]).bounds(vector![-1.0], vector![1.0]);
        let last = plan.solve(&late, &cost, &start, 1e-12, 200).unwrap();
        assert!(last.cost < 1e-9, "{last:?}");
        assert!((plan.inputs()[19][0] - guess).abs() < 1e-15, "{:?}", plan.inputs());
    }
}

/// A plan that was made without bounds is no start within them.
#[test]
fn inputs_that_are_given_are_brought_between_the_bounds() {
    let cost = Quadratic {
        goal: vector![0.0, 0.0],
        state: vector![1.0, 1.0],
        input: vector![0.5],
        end: vector![0.0, 0.0],
    };
    let start = vector![5.0, 0.0];
    let mut free = Ilqr::<f64, 2, 1, 60>::new(vector![0.0]);
    free.solve(&PUSHED, &cost, &start, 1e-9, 50).unwrap();
    assert!(free.inputs().iter().any(|u| u[0].abs() > 1.0));
    let held = |inputs: Option<&[SVector<f64, 1>; 60]>| {
        let mut plan = Ilqr::<f64, 2, 1, 60>::new(vector![0.0]).bounds(vector![-1.0], vector![1.0]);
        if let Some(inputs) = inputs {
            *plan.inputs_mut() = *inputs;
        }
        let last = plan.solve(&PUSHED, &cost, &start, 1e-9, 50).unwrap();
        assert!(plan.inputs().iter().all(|u| u[0].abs() <= 1.0), "{:?}", plan.inputs());
        assert!(last.promised >= 0.0, "{last:?}");
        last.cost
    };
    let (from_nothing, from_free) = (held(None), held(Some(free.inputs())));
    assert!((from_nothing - from_free).abs() < 1e-6 * from_nothing, "{from_nothing} {from_free}");
}

/// A pendulum swings up with a torque that cannot lift it at once; at the optimum the gradient
/// vanishes wherever no bound holds, and points outwards where one does.
#[test]
fn the_optimum_between_bounds_satisfies_its_conditions() {
    struct Pendulum;
    impl Model<f64, 2, 1> for Pendulum {
        fn step(&self, _tick: usize, x: &SVector<f64, 2>, u: &SVector<f64, 1>) -> SVector<f64, 2> {
            let speed = x[1] + 0.05 * (u[0] - 4.0 * x[0].sin());
            vector![x[0] + 0.05 * speed, speed]
        }
        fn linearized(
            &self,
            _tick: usize,
            x: &SVector<f64, 2>,
            _u: &SVector<f64, 1>,
        ) -> (SMatrix<f64, 2, 2>, SMatrix<f64, 2, 1>) {
            let pull = -0.2 * x[0].cos();
            (matrix![1.0 + 0.05 * pull, 0.05; pull, 1.0], matrix![0.0025; 0.05])
        }
    }
    let up = core::f64::consts::PI;
    let cost = Quadratic {
        goal: vector![up, 0.0],
        state: vector![0.0, 0.0],
        input: vector![0.01],
        end: vector![100.0, 10.0],
    };
    let bound = vector![1.0];
    let mut plan = Ilqr::<f64, 2, 1, 160>::new(vector![0.1]).bounds(-bound, bound);
    let start = vector![0.0, 0.0];
    let last = plan.solve(&Pendulum, &cost, &start, 1e-12, 500).unwrap();
    assert!(last.promised <= 1e-12 * last.cost, "{last:?}");
    let (mut states, mut gradient) = ([SVector::zeros(); 160], [SVector::zeros(); 160]);
    shooting_gradient(&Pendulum, &cost, &start, plan.inputs(), &mut states, &mut gradient).unwrap();
    let mut held = 0;
    for (u, g) in plan.inputs().iter().zip(&gradient) {
        assert!(u[0].abs() <= 1.0);
        if u[0].abs() < 1.0 {
            assert!(g[0].abs() < 1e-4, "{} {}", u[0], g[0]);
        } else {
            held += 1;
            assert!(g[0] * u[0] <= 1e-4, "{} {}", u[0], g[0]);
        }
    }
    assert!(held > 0);
    let end = Pendulum.step(0, &plan.states()[159], &plan.inputs()[159]);
    assert!((end[0] - up).abs() < 0.05, "{end}");
}

#[test]
fn the_horizon_recedes() {
    let mut plan = Ilqr::<f64, 2, 1, 3>::new(vector![0.0]);
    *plan.inputs_mut() = [vector![1.0], vector![2.0], vector![3.0]];
    plan.shift();
    assert_eq!(plan.inputs(), &[vector![2.0], vector![3.0], vector![3.0]]);
}

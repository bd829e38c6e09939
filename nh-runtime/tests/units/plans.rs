//! The law over plans: optimal inputs over a horizon, and their gradients.

use nalgebra::{SMatrix, SVector};
use nonholonomic::control::{
    Cost, Entry, Expansion, Ilqr, Model, Quadratic, Residuals, Squares, shooting_cost, shooting_gradient,
};
use nonholonomic::prelude::*;

use crate::blocks::{Outcome, Units};

/// A pendulum that a torque swings up, in the units of a run.
struct Swing<'a, T>(&'a Units<T>);

impl<T: Entry> Swing<'_, T> {
    fn inner(&self, x: &SVector<T, 2>, u: &SVector<T, 1>) -> ([T; 2], T) {
        ((x * self.0.state.recip()).into(), u[0] / self.0.input)
    }
}

impl<T: Entry> Model<T, 2, 1> for Swing<'_, T> {
    fn step(&self, _tick: usize, x: &SVector<T, 2>, u: &SVector<T, 1>) -> SVector<T, 2> {
        let ([angle, speed], torque) = self.inner(x, u);
        let w = T::from_f64;
        let next = speed + w(0.1) * (torque - w(2.0) * angle.sin());
        SVector::from([angle + w(0.1) * next, next]) * self.0.state
    }
    fn linearized(
        &self,
        _tick: usize,
        x: &SVector<T, 2>,
        u: &SVector<T, 1>,
    ) -> (SMatrix<T, 2, 2>, SMatrix<T, 2, 1>) {
        let ([angle, _], _) = self.inner(x, u);
        let w = T::from_f64;
        let pull = -w(0.2) * angle.cos();
        let by_state = SMatrix::from([[T::ONE + w(0.1) * pull, pull], [w(0.1), T::ONE]]);
        (by_state, SMatrix::from([[w(0.01), w(0.1)]]) * (self.0.state / self.0.input))
    }
}

/// A cost that is concave in the input where that is small: it has to be regularized.
struct Wavy<T>(Quadratic<T, 2, 1>, T, T);

impl<T: Entry> Cost<T, 2, 1> for Wavy<T> {
    fn stage(&self, tick: usize, x: &SVector<T, 2>, u: &SVector<T, 1>) -> T {
        self.0.stage(tick, x, u) + (u[0] / self.1).cos() * self.2
    }
    fn stage_expansion(&self, tick: usize, x: &SVector<T, 2>, u: &SVector<T, 1>) -> Expansion<T, 2, 1> {
        let mut expansion = self.0.stage_expansion(tick, x, u);
        let (sin, cos) = (u[0] / self.1).sin_cos();
        expansion.u[0] -= sin * self.2 / self.1;
        expansion.uu[0] -= cos * self.2 / self.1 / self.1;
        expansion
    }
    fn end(&self, x: &SVector<T, 2>) -> T {
        self.0.end(x)
    }
    fn end_expansion(&self, x: &SVector<T, 2>) -> Expansion<T, 2, 1> {
        self.0.end_expansion(x)
    }
}

/// The same weights as residuals, in units of the root of a cost.
struct Weighed<T> {
    state: T,
    input: T,
    root: T,
}

impl<T: Entry> Residuals<2, 1> for Weighed<T> {
    fn stage<N: Scalar>(&self, _tick: usize, x: &[N; 2], u: &[N; 1], mut add: impl FnMut(N)) {
        let w = |x: T| N::from_f64(x.to_f64());
        add(N::from_f64(0.1) * u[0] / w(self.input) * w(self.root));
        add(N::from_f64(0.1) * (x[0] / w(self.state)).cos() * w(self.root));
    }
    fn end<N: Scalar>(&self, x: &[N; 2], mut add: impl FnMut(N)) {
        let w = |x: T| N::from_f64(x.to_f64());
        add(N::from_f64(6.0) * (x[0] / w(self.state) - N::from_f64(3.0)) * w(self.root));
        add(x[1] / w(self.state) * w(self.root));
    }
}

fn quadratic<T: Entry>(u: &Units<T>) -> Quadratic<T, 2, 1> {
    let w = T::from_f64;
    let by_state = u.cost / (u.state * u.state);
    Quadratic {
        goal: SVector::from([w(3.1), w(0.0)]) * u.state,
        state: SVector::from([w(0.1), w(0.0)]) * by_state,
        input: SVector::from([w(0.02)]) * (u.cost / (u.input * u.input)),
        end: SVector::from([w(60.0), w(6.0)]) * by_state,
    }
}

fn plan<T: Entry>(u: &Units<T>, cost: &impl Cost<T, 2, 1>, bound: Option<f64>, out: &mut Outcome) {
    let model = Swing(u);
    let mut start = SVector::from([T::ZERO; 2]);
    let mut plan = Ilqr::<T, 2, 1, 25>::new(SVector::from([T::ZERO]));
    if let Some(bound) = bound {
        let bound = SVector::from([T::from_f64(bound) * u.input]);
        plan = plan.bounds(-bound, bound);
    }
    for tick in 0..14 {
        let improved = if tick == 10 {
            plan.solve(&model, cost, &start, T::from_f64(1e-3), 5)
        } else {
            plan.improve(&model, cost, &start)
        };
        match improved {
            Ok(improvement) => {
                for number in [improvement.cost, improvement.decrease, improvement.promised] {
                    out.number(number, u.cost);
                }
            }
            Err(error) => out.refused(&error),
        }
        plan.inputs().iter().for_each(|input| out.matrix(input, u.input));
        plan.gains().iter().for_each(|gain| out.matrix(gain, u.input / u.state));
        plan.states().iter().for_each(|state| out.matrix(state, u.state));
        if tick % 4 == 3 {
            start = model.step(0, &start, &plan.inputs()[0]);
            plan.shift();
        }
    }
}

pub(crate) fn plans<T: Entry>(u: &Units<T>, out: &mut Outcome) {
    let w = T::from_f64;
    plan(u, &quadratic(u), None, out);
    plan(u, &quadratic(u), Some(1.0), out);
    for hill in [0.01, 0.3, 5.0] {
        // in single precision the feedback of a plan without bounds leaves the range of the numbers
        let free = if T::EPSILON.to_f64() < 1e-10 { None } else { Some(1.0) };
        for bound in [free, Some(2.0)] {
            plan(u, &Wavy(quadratic(u), w(0.5) * u.input, w(hill) * u.cost), bound, out);
        }
    }
    // nothing but the end costs anything
    let free = Quadratic { input: SVector::from([T::ZERO]), ..quadratic(u) };
    plan(u, &free, Some(1.5), out);
}

pub(crate) fn residuals<T: Entry>(u: &Units<T>, out: &mut Outcome) {
    plan(u, &Squares(Weighed { state: u.state, input: u.input, root: u.cost.sqrt() }), Some(2.0), out);
}

pub(crate) fn gradients<T: Entry>(u: &Units<T>, out: &mut Outcome) {
    let start = SVector::from([T::from_f64(0.3), T::from_f64(-0.1)]) * u.state;
    let inputs = [SVector::from([T::from_f64(0.7) * u.input]); 12];
    let (mut states, mut gradient) = ([SVector::zeros(); 12], [SVector::zeros(); 12]);
    let (model, cost) = (Swing(u), quadratic(u));
    out.number(shooting_cost(&model, &cost, &start, &inputs), u.cost);
    match shooting_gradient(&model, &cost, &start, &inputs, &mut states, &mut gradient) {
        Ok(cost) => out.number(cost, u.cost),
        Err(error) => out.refused(&error),
    }
    for slope in &gradient {
        out.matrix(slope, u.cost / u.input);
    }
    for state in &states {
        out.matrix(state, u.state);
    }
}

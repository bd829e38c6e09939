//! Systems that are differentiated by jets.

use nonholonomic::nalgebra::SMatrix;
use nonholonomic::{D, Dynamics, Jacobian, Jet, Scalar, State};

/// Numbers without names.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Numbers<T, const N: usize>(pub(crate) [T; N]);

impl<T: Scalar, const N: usize> State for Numbers<T, N> {
    type Scalar = T;
    type Dim = D<N>;
    fn to_array(&self) -> [T; N] {
        self.0
    }
    fn from_array(components: [T; N]) -> Self {
        Self(components)
    }
    fn names() -> [&'static str; N] {
        ["x"; N]
    }
}

/// An input.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Push<T>(pub(crate) [T; 1]);

/// A pendulum of stiffness k with friction c, pushed, on a support that shakes, and the integral of its angle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pendulum<T> {
    pub(crate) k: T,
    pub(crate) c: T,
}

impl<T: Scalar> Pendulum<T> {
    fn rates(&self, t: T, [angle, rate, _]: [T; 3], push: T) -> [T; 3] {
        let w = T::from_f64;
        let shaken = self.k * (T::ONE + w(0.2) * (w(3.0) * t).sin());
        [rate, push * angle.cos() - shaken * angle.sin() - self.c * rate * rate.abs(), angle]
    }

    /// ∂F/∂(k, c).
    pub(crate) fn by_parameters(&self, t: T, x: &Numbers<T, 3>, Push([push]): &Push<T>) -> SMatrix<T, 3, 2> {
        let [k, c] = Jet::<T, 2>::variables([self.k, self.c]);
        let rates = Pendulum { k, c }.rates(Jet::constant(t), x.0.map(Jet::constant), Jet::constant(*push));
        let mut columns = [[T::ZERO; 3]; 2];
        for (j, column) in columns.iter_mut().enumerate() {
            *column = rates.map(|rate| rate.by[j]);
        }
        SMatrix::from(columns)
    }
}

impl<T: Scalar> Dynamics for Pendulum<T> {
    type State = Numbers<T, 3>;
    type Input = Push<T>;
    fn derivative(&self, t: T, x: &Numbers<T, 3>, Push([push]): &Push<T>) -> Numbers<T, 3> {
        Numbers(self.rates(t, x.0, *push))
    }
}

impl<T: Scalar> Jacobian for Pendulum<T> {
    type InputDim = D<1>;
    fn state_jacobian(&self, t: T, x: &Numbers<T, 3>, Push([push]): &Push<T>) -> [[T; 3]; 3] {
        let system = Pendulum { k: Jet::<T, 3>::constant(self.k), c: Jet::constant(self.c) };
        system.rates(Jet::constant(t), Jet::variables(x.0), Jet::constant(*push)).map(|rate| rate.by)
    }
    fn input_jacobian(&self, t: T, x: &Numbers<T, 3>, Push([push]): &Push<T>) -> [[T; 1]; 3] {
        let system = Pendulum { k: Jet::<T, 1>::constant(self.k), c: Jet::constant(self.c) };
        let [push] = Jet::variables([*push]);
        system.rates(Jet::constant(t), x.0.map(Jet::constant), push).map(|rate| rate.by)
    }
}

/// A pendulum without friction in canonical coordinates: its motions keep the area dq ∧ dp.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Free;

impl Dynamics for Free {
    type State = Numbers<f64, 2>;
    type Input = ();
    fn derivative(&self, _t: f64, Numbers([q, p]): &Numbers<f64, 2>, (): &()) -> Numbers<f64, 2> {
        Numbers([*p, -q.sin()])
    }
}

impl Jacobian for Free {
    type InputDim = D<0>;
    fn state_jacobian(&self, _t: f64, Numbers([q, _]): &Numbers<f64, 2>, (): &()) -> [[f64; 2]; 2] {
        [[0.0, 1.0], [-q.cos(), 0.0]]
    }
    fn input_jacobian(&self, _t: f64, _x: &Numbers<f64, 2>, (): &()) -> [[f64; 0]; 2] {
        [[]; 2]
    }
}

/// That two numbers agree to so many ulps of the larger of the second and 1.
pub(crate) fn close(found: f64, expected: f64, ulps: f64) {
    let size = expected.abs().max(1.0);
    assert!((found - expected).abs() <= ulps * f64::EPSILON * size, "{found} for {expected}");
}

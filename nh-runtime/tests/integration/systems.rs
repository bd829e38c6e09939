//! Small systems with known solutions.

use nonholonomic::{
    D, Dynamics, InputFault, Jacobian, ParameterError, ParameterFault, Real, Scalar, State, StateFault,
};

/// A state with named components of type `T`.
macro_rules! state {
    ($name:ident, $n:literal, $($component:ident),+) => {
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub(crate) struct $name<T> {
            $(pub $component: T,)+
        }

        impl<T: Scalar> State for $name<T> {
            type Scalar = T;
            type Dim = D<$n>;
            fn to_array(&self) -> [T; $n] {
                [$(self.$component),+]
            }
            fn from_array([$($component),+]: [T; $n]) -> Self {
                Self { $($component),+ }
            }
            fn names() -> [&'static str; $n] {
                [$(stringify!($component)),+]
            }
        }
    };
}

state!(Plane, 2, q, p);
state!(Line, 1, x);
state!(Spin, 3, w1, w2, w3);

/// q' = p, p' = −q + sin 2t: a force that makes the time matter.
#[derive(Clone, Copy)]
pub(crate) struct Driven;

impl Driven {
    /// The solution from (1, 0) at t = 0.
    pub(crate) fn solution(t: f64) -> Plane<f64> {
        Plane {
            q: t.cos() + 2.0 / 3.0 * t.sin() - (2.0 * t).sin() / 3.0,
            p: -t.sin() + 2.0 / 3.0 * t.cos() - 2.0 / 3.0 * (2.0 * t).cos(),
        }
    }
}

impl Dynamics for Driven {
    type State = Plane<f64>;
    type Input = ();
    fn derivative(&self, t: f64, x: &Plane<f64>, (): &()) -> Plane<f64> {
        Plane { q: x.p, p: -x.q + (2.0 * t).sin() }
    }
}

/// q' = p, p' = −q.
#[derive(Clone, Copy)]
pub(crate) struct Spring;

impl Dynamics for Spring {
    type State = Plane<f64>;
    type Input = ();
    fn derivative(&self, _t: f64, x: &Plane<f64>, (): &()) -> Plane<f64> {
        Plane { q: x.p, p: -x.q }
    }
}

/// A pendulum with a torque, of any scalar type.
#[derive(Clone, Copy)]
pub(crate) struct Pendulum<T> {
    pub g: T,
}

#[derive(Clone, Copy, Default)]
pub(crate) struct Torque<T> {
    pub torque: T,
}

impl<T: Real> Dynamics for Pendulum<T> {
    type State = Plane<T>;
    type Input = Torque<T>;
    fn derivative(&self, _t: T, x: &Plane<T>, u: &Torque<T>) -> Plane<T> {
        Plane { q: x.p, p: u.torque - self.g * x.q.sin() }
    }
    fn validate(&self) -> Result<(), ParameterError> {
        let error = |fault| Err(ParameterError { parameter: "g", value: self.g.to_f64(), fault });
        if !self.g.is_finite() {
            return error(ParameterFault::NotFinite);
        }
        if !self.g.all_gt(T::ZERO) {
            return error(ParameterFault::Assumption { text: "g > 0" });
        }
        Ok(())
    }
    fn check_input(&self, u: &Torque<T>) -> Result<(), InputFault> {
        if u.torque.is_finite() {
            Ok(())
        } else {
            Err(InputFault { input: "torque", value: u.torque.to_f64() })
        }
    }
    fn check_state(&self, _t: T, x: &Plane<T>) -> Result<(), StateFault> {
        // stands for an identity of embedded coordinates
        if x.q.abs() > T::from_f64(100.0) {
            return Err(StateFault { identity: "q = 0", residual: x.q.to_f64() });
        }
        Ok(())
    }
}

/// A derivative given by a function of time, state and input.
#[derive(Clone, Copy)]
pub(crate) struct Scalar1(pub fn(f64, f64, f64) -> f64);

impl Dynamics for Scalar1 {
    type State = Line<f64>;
    type Input = Torque<f64>;
    fn derivative(&self, t: f64, x: &Line<f64>, u: &Torque<f64>) -> Line<f64> {
        Line { x: (self.0)(t, x.x, u.torque) }
    }
}

/// Euler's equations of a free rigid body.
#[derive(Clone, Copy)]
pub(crate) struct FreeBody {
    pub i: [f64; 3],
}

impl FreeBody {
    /// Twice the energy and the squared angular momentum.
    pub(crate) fn invariants(&self, w: &Spin<f64>) -> [f64; 2] {
        let [a, b, c] = self.i;
        let squares = [w.w1 * w.w1, w.w2 * w.w2, w.w3 * w.w3];
        [
            a * squares[0] + b * squares[1] + c * squares[2],
            a * a * squares[0] + b * b * squares[1] + c * c * squares[2],
        ]
    }
}

impl Dynamics for FreeBody {
    type State = Spin<f64>;
    type Input = ();
    fn derivative(&self, _t: f64, w: &Spin<f64>, (): &()) -> Spin<f64> {
        let [a, b, c] = self.i;
        Spin { w1: (b - c) / a * w.w2 * w.w3, w2: (c - a) / b * w.w3 * w.w1, w3: (a - b) / c * w.w1 * w.w2 }
    }
}

/// x' = −λ (x − cos t) − sin t, whose solutions fall on cos t at the rate λ.
#[derive(Clone, Copy)]
pub(crate) struct Stiff {
    pub rate: f64,
}

impl Dynamics for Stiff {
    type State = Line<f64>;
    type Input = ();
    fn derivative(&self, t: f64, x: &Line<f64>, (): &()) -> Line<f64> {
        Line { x: -self.rate * (x.x - t.cos()) - t.sin() }
    }
}

/// Van der Pol's oscillator q'' = μ (1 − q²) q' − q, whose force is stiff for large μ.
#[derive(Clone, Copy)]
pub(crate) struct VanDerPol {
    pub mu: f64,
}

impl Dynamics for VanDerPol {
    type State = Plane<f64>;
    type Input = ();
    fn derivative(&self, _t: f64, x: &Plane<f64>, (): &()) -> Plane<f64> {
        Plane { q: x.p, p: self.mu * (1.0 - x.q * x.q) * x.p - x.q }
    }
}

impl Jacobian for VanDerPol {
    type InputDim = D<0>;
    fn state_jacobian(&self, _t: f64, x: &Plane<f64>, (): &()) -> [[f64; 2]; 2] {
        [[0.0, 1.0], [-2.0 * self.mu * x.q * x.p - 1.0, self.mu * (1.0 - x.q * x.q)]]
    }
    fn input_jacobian(&self, _t: f64, _x: &Plane<f64>, (): &()) -> [[f64; 0]; 2] {
        [[], []]
    }
}

/// The distance of two states of the plane.
pub(crate) fn distance(a: &Plane<f64>, b: &Plane<f64>) -> f64 {
    (a.q - b.q).hypot(a.p - b.p)
}

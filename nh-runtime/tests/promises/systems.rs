//! The system that the laws run over, and the list of all methods.

use nonholonomic::prelude::*;

/// The contact oscillator with all velocities in the state: every method accepts it.
#[nonholonomic(
    base { x, y, z }
    lagrangian { 1 / 2 * (der(x)^2 + der(y)^2 + der(z)^2) - k / 2 * (x^2 + y^2 + z^2) }
    constraints { roll: der(x) = -b * y * der(z); }
    formulation { projected }
    conserved { total = 1 / 2 * (der(x)^2 + der(y)^2 + der(z)^2) + k / 2 * (x^2 + y^2 + z^2); }
    assume { k > 0; }
    emit { discrete_gradient, leapfrog, invariants, taylor, jacobian }
)]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Contact<T> {
    pub(crate) k: T,
    pub(crate) b: T,
}

/// The system with a frequency and a length of about one.
pub(crate) fn contact<T: Real>() -> Contact<T> {
    Contact { k: T::ONE, b: T::ONE }
}

/// A start on the constraint.
pub(crate) fn start<T: Real>() -> ContactState<T> {
    let c = T::from_f64;
    ContactState { x: c(0.3), y: c(0.5), z: c(0.4), x_dot: c(-0.375), y_dot: c(1.0), z_dot: c(0.75) }
}

/// The largest difference of two states.
pub(crate) fn distance<T: Real>(a: &ContactState<T>, b: &ContactState<T>) -> f64 {
    let (a, b) = (a.to_array(), b.to_array());
    a.iter().zip(&b).fold(0.0, |most, (a, b)| Scalar::max(most, (*a - *b).to_f64().abs()))
}

/// Calls `check(name, method)` with all methods of fixed step, of length `h`.
macro_rules! every_fixed {
    ($check:expr, $h:expr) => {{
        let h = $h;
        macro_rules! call {
            ($method:expr) => {
                $check(stringify!($method), $method)
            };
        }
        call!(Euler::new(h));
        call!(Heun::new(h));
        call!(Ralston::new(h));
        call!(Rk4::new(h));
        call!(Rk4::new(h).compensated());
        call!(Dop853::fixed(h));
        call!(Vern9::fixed(h).compensated());
        call!(ImplicitMidpoint::new(h));
        call!(ImplicitMidpoint::new(h).fourth_order());
        call!(GaussLegendre4::new(h));
        call!(GaussLegendre6::new(h).with_jacobian().compensated());
        call!(DiscreteGradient::new(h));
        call!(DiscreteGradient::new(h).sixth_order());
        call!(ReflectedLeapfrog::new(h));
        call!(Conserving::new(Rk4::new(h)));
        call!(Projected::new(Rk4::new(h), 3));
    }};
}

/// Calls `check(name, method)` with all methods that choose their steps.
macro_rules! every_adaptive {
    ($check:expr) => {{
        macro_rules! call {
            ($method:expr) => {
                $check(stringify!($method), $method)
            };
        }
        call!(Bs23::new());
        call!(Dopri5::new());
        call!(Tsit5::new());
        call!(Dop853::new());
        call!(Vern9::new());
        call!(Taylor::new());
        call!(Radau5::new());
        call!(Radau5::new().with_jacobian());
        call!(Rodas5P::new());
        call!(Rodas5P::new().with_jacobian());
        call!(Auto::new());
        call!(Conserving::new(Dopri5::new()));
        call!(Projected::new(Tsit5::new(), 2));
    }};
}

/// Calls a law with methods of every kind, those of fixed step with steps of length `h`.
macro_rules! every_kind {
    ($law:expr, $h:expr) => {{
        let h = $h;
        macro_rules! call {
            ($method:expr) => {
                $law(stringify!($method), $method)
            };
        }
        call!(Heun::new(h));
        call!(Rk4::new(h));
        call!(Rk4::new(h).compensated());
        call!(Dop853::fixed(h));
        call!(ImplicitMidpoint::new(h));
        call!(GaussLegendre4::new(h));
        call!(GaussLegendre6::new(h));
        call!(Bs23::new());
        call!(Dopri5::new());
        call!(Tsit5::new());
        call!(Dop853::new());
        call!(Vern9::new());
        call!(Radau5::new());
        call!(Rodas5P::new());
        call!(Auto::new());
    }};
}

pub(crate) use {every_adaptive, every_fixed, every_kind};

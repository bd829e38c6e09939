//! Numbers with the runtime's own sine and cosine.

use core::fmt;
use core::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

use num_traits::{One, Zero};

use crate::{Real, Scalar, sine};

/// A number whose sine and cosine come from the runtime's own kernel rather than the platform.
///
/// They are most of the cost of a small system. The kernel computes the pair in about 40 instructions
/// without a branch that is taken in practice, half of what a platform's library needs, and has the same bits on
/// every platform with the same kind of multiply-add. Lanes use it too: a lane's result equals that
/// of `Fast` bit for bit. All else is the number's own.
///
/// | | largest error found of sine and cosine | reach of the fast reduction |
/// |---|---|---|
/// | `Fast<f64>` | 1.6 units in the last place | 1 647 099 rad |
/// | `Fast<f32>` | 2.4 units in the last place | 6 433 rad |
///
/// `Fast<f64>` gains most where the target has a multiply-add (`-C target-cpu=x86-64-v3`, aarch64). `Fast<f32>`, one
/// at a time, is there as fast as the `sinf` of a current platform, and slower on the default x86-64 target: the
/// platform looks for that instruction when the program runs. Its use is in lanes and without double precision.
///
/// Beyond that reach the error is the same, and the cost some ten times higher. Infinite and NaN
/// arguments give NaN. The sine of −0 is +0.
///
/// A system takes it as its scalar, if its struct is declared with a type parameter:
///
/// ```
/// use nonholonomic::Fast;
/// use nonholonomic::prelude::*;
///
/// /// A pendulum.
/// #[nonholonomic(
///     base       { theta }
///     lagrangian { m * l^2 / 2 * der(theta)^2 + m * g * l * cos(theta) }
/// )]
/// #[derive(Clone, Copy, Debug)]
/// struct Pendulum<T> { m: T, l: T, g: T }
///
/// let pendulum = Pendulum { m: 1.0, l: 0.5, g: 9.81 };
/// let fast = Pendulum { m: Fast(1.0), l: Fast(0.5), g: Fast(9.81) };
/// let ours = fast.derivative(Fast(0.0), &PendulumState { theta: Fast(1.0), ..Default::default() }, &());
/// let platforms = pendulum.derivative(0.0, &PendulumState { theta: 1.0, ..Default::default() }, &());
/// assert!((ours.theta_dot.0 - platforms.theta_dot).abs() < 1e-14);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(transparent))]
#[repr(transparent)]
pub struct Fast<T>(
    /// The number.
    pub T,
);

impl<T> From<T> for Fast<T> {
    #[inline]
    fn from(number: T) -> Self {
        Self(number)
    }
}

impl<T: fmt::Display> fmt::Display for Fast<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

/// Forwards the operators.
macro_rules! operators {
    ($($operator:ident $name:ident $assign:ident $name_assign:ident;)*) => {$(
        impl<T: $operator<Output = T>> $operator for Fast<T> {
            type Output = Self;
            #[inline]
            fn $name(self, other: Self) -> Self {
                Self(self.0.$name(other.0))
            }
        }
        impl<T: $assign> $assign for Fast<T> {
            #[inline]
            fn $name_assign(&mut self, other: Self) {
                self.0.$name_assign(other.0);
            }
        }
    )*};
}
operators! {
    Add add AddAssign add_assign;
    Sub sub SubAssign sub_assign;
    Mul mul MulAssign mul_assign;
}

impl<T: Div<Output = T>> Div for Fast<T> {
    type Output = Self;
    #[inline]
    fn div(self, other: Self) -> Self {
        Self(self.0 / other.0)
    }
}

impl<T: Neg<Output = T>> Neg for Fast<T> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

// what matrices are multiplied with: `control` takes this type too
impl<T: Zero> Zero for Fast<T> {
    #[inline]
    fn zero() -> Self {
        Self(T::zero())
    }
    #[inline]
    fn is_zero(&self) -> bool {
        self.0.is_zero()
    }
}

impl<T: One> One for Fast<T> {
    #[inline]
    fn one() -> Self {
        Self(T::one())
    }
}

/// Forwards the functions of a primitive type, except sine and cosine.
macro_rules! fast {
    ($float:ident) => {
        impl Scalar for Fast<$float> {
            const ZERO: Self = Self(0.0);
            const ONE: Self = Self(1.0);

            #[inline]
            fn from_f64(value: f64) -> Self {
                Self(Scalar::from_f64(value))
            }
            #[inline]
            fn to_f64(self) -> f64 {
                self.0.to_f64()
            }
            #[inline]
            fn sin(self) -> Self {
                self.sin_cos().0
            }
            #[inline]
            fn cos(self) -> Self {
                self.sin_cos().1
            }
            #[inline]
            fn sin_cos(self) -> (Self, Self) {
                let (sin, cos) = sine::sin_cos(self.0);
                (Self(sin), Self(cos))
            }
            fast! { @forward $float;
                sqrt() cbrt() tan() asin() acos() atan() atan2(x) sinh() cosh() tanh()
                exp() ln() powf(exponent) abs() sign() min(other) max(other) recip()
                mul_add(factor, summand) mul_add_exact(factor, summand)
            }
            #[inline]
            fn is_finite(self) -> bool {
                Scalar::is_finite(self.0)
            }
            #[inline]
            fn all_gt(self, other: Self) -> bool {
                self.0.all_gt(other.0)
            }
            #[inline]
            fn all_ge(self, other: Self) -> bool {
                self.0.all_ge(other.0)
            }
            #[inline]
            fn all_ne(self, other: Self) -> bool {
                self.0.all_ne(other.0)
            }
            #[inline]
            fn select_gt(self, other: Self, then: Self, otherwise: Self) -> Self {
                Self(self.0.select_gt(other.0, then.0, otherwise.0))
            }
        }

        impl Real for Fast<$float> {
            const EPSILON: Self = Self($float::EPSILON);
            const MIN_POSITIVE: Self = Self($float::MIN_POSITIVE);
            const DEFAULT_TOLERANCE: Self = Self(<$float as Real>::DEFAULT_TOLERANCE);

            #[inline]
            fn from_u32(count: u32) -> Self {
                Self(Real::from_u32(count))
            }
        }
    };
    (@forward $float:ident; $($name:ident($($argument:ident),*))*) => {
        $(
            #[inline]
            fn $name(self $(, $argument: Self)*) -> Self {
                Self(<$float as Scalar>::$name(self.0 $(, $argument.0)*))
            }
        )*
    };
}
fast!(f64);
fast!(f32);

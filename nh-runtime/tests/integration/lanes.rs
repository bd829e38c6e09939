//! A user's own scalar: two lanes, with a sine of its own.

use core::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

use nonholonomic::__private::solve_pivoted;
use nonholonomic::prelude::*;

use crate::systems::Plane;

#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Pair([f64; 2]);

impl Pair {
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        Self(self.0.map(f))
    }
    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self([f(self.0[0], other.0[0]), f(self.0[1], other.0[1])])
    }
    fn all(self, other: Self, f: impl Fn(f64, f64) -> bool) -> bool {
        f(self.0[0], other.0[0]) && f(self.0[1], other.0[1])
    }
}

macro_rules! operators {
    ($($operator:ident $name:ident $assign:ident $name_assign:ident $f:expr;)*) => {$(
        impl $operator for Pair {
            type Output = Self;
            fn $name(self, other: Self) -> Self {
                self.zip(other, $f)
            }
        }
        impl $assign for Pair {
            fn $name_assign(&mut self, other: Self) {
                *self = self.zip(other, $f);
            }
        }
    )*};
}
operators! {
    Add add AddAssign add_assign |a, b| a + b;
    Sub sub SubAssign sub_assign |a, b| a - b;
    Mul mul MulAssign mul_assign |a, b| a * b;
}
impl Div for Pair {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        self.zip(other, |a, b| a / b)
    }
}
impl Neg for Pair {
    type Output = Self;
    fn neg(self) -> Self {
        self.map(|a| -a)
    }
}

macro_rules! lanewise {
    ($($name:ident)*; $($binary:ident)*) => {
        $(fn $name(self) -> Self {
            self.map(|a| Scalar::$name(a))
        })*
        $(fn $binary(self, other: Self) -> Self {
            self.zip(other, |a, b| Scalar::$binary(a, b))
        })*
    };
}

impl Scalar for Pair {
    const ZERO: Self = Self([0.0; 2]);
    const ONE: Self = Self([1.0; 2]);
    fn from_f64(value: f64) -> Self {
        Self([value; 2])
    }
    fn to_f64(self) -> f64 {
        if self.0[0].is_finite() { self.0[1] } else { self.0[0] }
    }
    lanewise! {
        sqrt cbrt cos tan asin acos atan sinh cosh tanh exp ln abs sign; atan2 powf min max
    }
    fn sin(self) -> Self {
        // replaced: Taylor's polynomial, good enough for small angles
        self.map(|a| a - a.powi(3) / 6.0 + a.powi(5) / 120.0)
    }
    fn is_finite(self) -> bool {
        self.0.iter().all(|a| a.is_finite())
    }
    fn all_gt(self, other: Self) -> bool {
        self.all(other, |a, b| a > b)
    }
    fn all_ge(self, other: Self) -> bool {
        self.all(other, |a, b| a >= b)
    }
    fn all_ne(self, other: Self) -> bool {
        self.all(other, |a, b| a != b)
    }
    fn select_gt(self, other: Self, then: Self, otherwise: Self) -> Self {
        let lane = |i: usize| Scalar::select_gt(self.0[i], other.0[i], then.0[i], otherwise.0[i]);
        Self([lane(0), lane(1)])
    }
}

/// A pendulum of any scalar type.
struct Pendulum<T>(T);
impl<T: Scalar> Dynamics for Pendulum<T> {
    type State = Plane<T>;
    type Input = ();
    fn derivative(&self, _t: T, x: &Plane<T>, (): &()) -> Plane<T> {
        Plane { q: x.p, p: -self.0 * x.q.sin_cos().0 }
    }
}

#[test]
fn steps_of_lanes_are_the_steps_of_each() {
    let pair = |a, b| Pair([a, b]);
    let lanes = Rk4::step(
        &Pendulum(pair(1.0, 2.0)),
        Pair::ZERO,
        Pair::from_f64(0.1),
        &Plane { q: pair(0.1, 0.01), p: pair(0.0, 0.3) },
        &(),
    );
    for (i, (g, q, p)) in [(1.0, 0.1, 0.0), (2.0, 0.01, 0.3)].into_iter().enumerate() {
        let alone = Rk4::step(&Pendulum(g), 0.0, 0.1, &Plane { q, p }, &());
        assert!((lanes.q.0[i] - alone.q).abs() < 1e-9 && (lanes.p.0[i] - alone.p).abs() < 1e-9);
    }
}

#[test]
fn lanes_pivot_each_for_itself() {
    // the first lane needs an exchange, the second must not have one
    let a = [[Pair([0.0, 1.0]), Pair([1.0, 1.0])], [Pair([1.0, 0.0]), Pair([0.0, 2.0])]];
    let x = solve_pivoted(a, [Pair([3.0, 5.0]), Pair([4.0, 6.0])]);
    assert_eq!(x, [Pair([4.0, 2.0]), Pair([3.0, 3.0])]);
}

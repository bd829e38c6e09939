//! Expressions as they were written.

use super::{Binder, Name, Place};
use crate::report::Extent;

/// An expression.
#[derive(Clone, Debug)]
pub(crate) struct Expr {
    /// What it is.
    pub(crate) kind: ExprKind,
    /// Where it stands.
    pub(crate) extent: Extent,
}

/// What an expression is. Sums and products are flat, so that long ones are not deep.
#[derive(Clone, Debug)]
pub(crate) enum ExprKind {
    /// An exact number.
    Number(Number),
    /// A name, a whole family, an array; `pi` and `t` too.
    Name(Name),
    /// An entry, `I[0]` or `A[i][j]`: at most two indices.
    Index(Box<Expr>, Vec<Expr>),
    /// `der(x)`.
    Der(Place),
    /// `f(a, b)`: a function of the vocabulary, `dot` and `cross` included; any other name is
    /// still in here.
    Call(Name, Vec<Expr>),
    /// `self.motor(a, b)`.
    Method(Name, Vec<Expr>),
    /// `sum(i in 0..4: expr)`.
    Sum(Vec<Binder>, Box<Expr>),
    /// `[a, b, c]`.
    Vector(Vec<Expr>),
    /// `-a`.
    Negate(Box<Expr>),
    /// `a + b - c`: at least two terms, the first one with a plus.
    Add(Vec<(Sign, Expr)>),
    /// `a * b / c`: at least two factors, the first one a multiplication.
    Multiply(Vec<(Factor, Expr)>),
    /// `a ^ b`.
    Power(Box<Expr>, Box<Expr>),
}

/// How a term enters a sum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sign {
    /// Added.
    Plus,
    /// Subtracted.
    Minus,
}

/// How a factor enters a product.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Factor {
    /// Multiplied.
    Times,
    /// Divided by.
    Over,
}

/// An exact number: digits · 10^exponent.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Number {
    /// The literal as it was written.
    pub(crate) text: String,
    /// Its decimal digits without leading zeros; `0` for zero.
    pub(crate) digits: String,
    /// The power of ten; 0 for zero.
    pub(crate) exponent: i32,
}

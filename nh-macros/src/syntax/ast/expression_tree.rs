//! Expressions as they were written.

use super::{Binder, Name};
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
    /// An entry or a part, `I[0]`, `A[i][j]`, `p[0..2]`.
    Index(Box<Expr>, Vec<Expr>),
    /// `0..2`, which is an index only.
    Range(Box<Expr>, Box<Expr>),
    /// `der(x)`.
    Der(Box<Expr>),
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

impl Expr {
    /// Visits this expression and all that it is made of, in the order they are written.
    pub(crate) fn walk<'a>(&'a self, visit: &mut dyn FnMut(&'a Self)) {
        visit(self);
        match &self.kind {
            ExprKind::Number(_) | ExprKind::Name(_) => {}
            ExprKind::Index(of, indices) => {
                of.walk(visit);
                for index in indices {
                    index.walk(visit);
                }
            }
            ExprKind::Range(a, b) | ExprKind::Power(a, b) => {
                a.walk(visit);
                b.walk(visit);
            }
            ExprKind::Der(of) | ExprKind::Negate(of) => of.walk(visit),
            ExprKind::Call(_, parts) | ExprKind::Method(_, parts) | ExprKind::Vector(parts) => {
                for part in parts {
                    part.walk(visit);
                }
            }
            ExprKind::Sum(binders, body) => {
                for binder in binders {
                    binder.from.walk(visit);
                    binder.to.walk(visit);
                }
                body.walk(visit);
            }
            ExprKind::Add(terms) => terms.iter().for_each(|(_, term)| term.walk(visit)),
            ExprKind::Multiply(factors) => factors.iter().for_each(|(_, factor)| factor.walk(visit)),
        }
    }
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

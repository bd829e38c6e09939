//! One expression in terms of its operands, and the functions that there are.

use super::number::Rational;
use crate::id::{ConstantId, ExprId, SymbolId};
use std::rc::Rc;

/// A function of one argument. `tan x` is stored as `sin x / cos x`, `sqrt x` as `x^(1/2)`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[allow(missing_docs, reason = "the names are the functions")]
pub enum Function {
    Sin,
    Cos,
    Asin,
    Acos,
    Atan,
    Sinh,
    Cosh,
    Tanh,
    Exp,
    Ln,
    Abs,
    /// −1, 0 or 1.
    Sign,
}

impl Function {
    /// The name in a declaration.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Sin => "sin",
            Self::Cos => "cos",
            Self::Asin => "asin",
            Self::Acos => "acos",
            Self::Atan => "atan",
            Self::Sinh => "sinh",
            Self::Cosh => "cosh",
            Self::Tanh => "tanh",
            Self::Exp => "exp",
            Self::Ln => "ln",
            Self::Abs => "abs",
            Self::Sign => "sign",
        }
    }
}

/// A function of two arguments.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[allow(missing_docs, reason = "the names are the functions")]
pub enum Function2 {
    Atan2,
    Min,
    Max,
}

impl Function2 {
    /// The name in a declaration.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Atan2 => "atan2",
            Self::Min => "min",
            Self::Max => "max",
        }
    }
}

/// One expression, in terms of its operands.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Node {
    /// An exact number.
    Number(Rational),
    /// The number π.
    Pi,
    /// A number that has a name, an operand like a symbol (see `constants.rs`).
    Constant(ConstantId),
    /// A coordinate, velocity, parameter, input, or the time.
    Symbol(SymbolId),
    /// `constant + Σ coefficient · term`: terms ascend, none is a number or a sum, no coefficient
    /// is zero, and there are at least two summands.
    Sum {
        /// The number among the summands.
        constant: Rational,
        /// The other summands.
        terms: Rc<[(ExprId, Rational)]>,
    },
    /// `coefficient · Π base^exponent`: bases ascend, no exponent is zero, and it is not a mere
    /// number, symbol or sum. A sum among several factors is primitive (see `product.rs`).
    Product {
        /// The number in front.
        coefficient: Rational,
        /// Bases with their exponents.
        factors: Rc<[(ExprId, Rational)]>,
    },
    /// A function of one argument.
    Apply(Function, ExprId),
    /// A function of two arguments.
    Apply2(Function2, ExprId, ExprId),
}

impl Node {
    /// How many operands there are.
    #[must_use]
    pub fn breadth(&self) -> usize {
        match self {
            Self::Number(_) | Self::Pi | Self::Constant(_) | Self::Symbol(_) => 0,
            Self::Sum { terms: list, .. } | Self::Product { factors: list, .. } => list.len(),
            Self::Apply(..) => 1,
            Self::Apply2(..) => 2,
        }
    }

    /// The operands, in order.
    pub fn operands(&self) -> impl Iterator<Item = ExprId> + '_ {
        let (list, pair): (&[(ExprId, Rational)], [Option<ExprId>; 2]) = match self {
            Self::Number(_) | Self::Pi | Self::Constant(_) | Self::Symbol(_) => (&[], [None, None]),
            Self::Sum { terms, .. } => (terms, [None, None]),
            Self::Product { factors, .. } => (factors, [None, None]),
            Self::Apply(_, x) => (&[], [Some(*x), None]),
            Self::Apply2(_, x, y) => (&[], [Some(*x), Some(*y)]),
        };
        list.iter().map(|(id, _)| *id).chain(pair.into_iter().flatten())
    }
}

//! How the Taylor coefficients of a step follow from those of its operands, mathematics (24).

use super::step::Value;
use crate::algebra::Rational;
use crate::id::SymbolId;

/// A series in an inner sum.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Factor {
    /// a_j
    Plain(Value),
    /// j a_j
    Weighted(Value),
}

/// An inner sum Σ_{j=1}^{k−1} a_j b_{k−j}, by its number among those of [`Recurrences::products`](super::Recurrences::products).
pub type Inner = usize;

/// How the coefficient of order k ≥ 1 follows. `v₀` is the value at order 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Rule {
    /// Constant: all its coefficients of higher order are zero.
    Constant,
    /// Needed at order 0 only.
    Seed,
    /// A variable of the state: its coefficient follows from that of its rate.
    Variable(SymbolId),
    /// The time: 1 at order 1, else 0.
    Time,
    /// a_k
    Same(Value),
    /// −a_k
    Negative(Value),
    /// a_k + b_k
    Sum(Value, Value),
    /// a_k − b_k
    Difference(Value, Value),
    /// a_k c, with c constant
    Scaled(Value, Value),
    /// a_k b₀ + a₀ b_k + inner
    Product(Value, Value, Inner),
    /// 2 a₀ a_k + Σ_{j=1}^{k−1} a_j a_{k−j}, the sum by its number among [`Recurrences::squares`](super::Recurrences::squares)
    Square(Value, usize),
    /// q = a/b: (a_k − b_k q₀ − Σ b_j q_{k−j}) / b₀; without `numerator` a is constant
    Quotient {
        /// a
        numerator: Option<Value>,
        /// b
        denominator: Value,
        /// 1/b₀
        over: Value,
        /// Σ b_j q_{k−j}
        inner: Inner,
    },
    /// r² = a: (a_k − Σ r_j r_{k−j}) / (2 r₀)
    Root {
        /// a
        of: Value,
        /// 1/(2 r₀)
        over: Value,
        /// Σ r_j r_{k−j} among the squares
        inner: usize,
    },
    /// p = a^α: (α (k a_k p₀ + Σ p_j (k−j) a_{k−j}) − Σ j p_j a_{k−j}) / (k a₀)
    Power {
        /// a
        of: Value,
        /// α
        exponent: Rational,
        /// 1/a₀
        over: Value,
        /// Both sums in this order.
        inner: [Inner; 2],
    },
    /// y′ = ± g a′: ± (k a_k g₀ + Σ j a_j g_{k−j}) / k
    Integral {
        /// a
        of: Value,
        /// g, of which coefficients below k are needed only
        rate: Value,
        /// Whether the sign is −.
        negative: bool,
        /// Σ j a_j g_{k−j}
        inner: Inner,
    },
    /// w y′ = ± a′: (± k a_k − Σ j y_j w_{k−j}) / (k w₀)
    IntegralOver {
        /// a
        of: Value,
        /// 1/w₀
        over: Value,
        /// Whether the sign is −.
        negative: bool,
        /// Σ j y_j w_{k−j}
        inner: Inner,
    },
    /// The angle φ of the point (x, y), r² φ′ = x y′ − y x′:
    /// (k y_k x₀ + Σ j y_j x_{k−j} − k x_k y₀ − Σ j x_j y_{k−j} − Σ j φ_j (r²)_{k−j}) / (k r₀²)
    Angle {
        /// y
        y: Value,
        /// x
        x: Value,
        /// 1/r₀²
        over: Value,
        /// The three sums in this order.
        inner: [Inner; 3],
    },
    /// The unknowns of M x = b: M₀ x_k = b_k − M_k x₀ − Σ M_j x_{k−j}
    System {
        /// For each row, its entries that are not constant: entry, unknown, Σ M_j x_{k−j}.
        varying: Vec<Vec<(Value, Value, Inner)>>,
    },
    /// An unknown of a `System`, which has computed it.
    Unknown,
}

//! Ranges of expressions over all real points, and proofs that an expression vanishes nowhere.

use super::graph::Graph;
use super::node::{Function, Node};
use super::number::Rational;
use crate::id::{ExprId, SymbolId};
use crate::id_map::IdMap;
use rustc_hash::FxHashMap;

/// A closed range of real values, perhaps known to leave out zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// No value is below.
    pub low: f64,
    /// No value is above.
    pub high: f64,
    /// Zero is not a value.
    pub nonzero: bool,
}

impl Range {
    /// Every real number.
    pub const ALL: Self = Self { low: f64::NEG_INFINITY, high: f64::INFINITY, nonzero: false };
    /// The positive numbers.
    pub const POSITIVE: Self = Self { low: 0.0, high: f64::INFINITY, nonzero: true };
    const UNIT: Self = Self { low: -1.0, high: 1.0, nonzero: false };

    /// Widens by a rounding error, and notes when zero is outside.
    fn new(low: f64, high: f64, nonzero: bool) -> Self {
        let slack = |x: f64| if x.is_finite() { x.abs() * 1e-12 } else { 0.0 };
        let (low, high) = (low - slack(low), high + slack(high));
        if low.is_nan() || high.is_nan() {
            return Self::ALL;
        }
        Self { low, high, nonzero: nonzero || low > 0.0 || high < 0.0 }
    }

    /// Whether every value is positive.
    #[must_use]
    pub fn is_positive(self) -> bool {
        self.low >= 0.0 && self.nonzero
    }

    /// Whether no value is negative.
    #[must_use]
    pub fn is_not_negative(self) -> bool {
        self.low >= 0.0
    }

    /// The values in both.
    #[must_use]
    pub fn intersection(self, other: Self) -> Self {
        let (low, high) = (self.low.max(other.low), self.high.min(other.high));
        Self { low, high, nonzero: self.nonzero || other.nonzero || low > 0.0 || high < 0.0 }
    }

    /// Whether there is no value.
    #[must_use]
    pub fn is_empty(self) -> bool {
        self.low > self.high || (self.low == 0.0 && self.high == 0.0 && self.nonzero)
    }

    /// Every value moved.
    #[must_use]
    pub fn shifted(self, by: f64) -> Self {
        if by == 0.0 {
            return self;
        }
        // an excluded end point stays excluded only while it is zero, so it is included
        Self::new(self.low + by, self.high + by, false)
    }

    fn plus(self, other: Self) -> Self {
        let semidefinite = (self.low >= 0.0 && other.low >= 0.0) || (self.high <= 0.0 && other.high <= 0.0);
        Self::new(
            self.low + other.low,
            self.high + other.high,
            semidefinite && (self.nonzero || other.nonzero),
        )
    }

    fn times(self, other: Self) -> Self {
        let product = |a: f64, b: f64| if a == 0.0 || b == 0.0 { 0.0 } else { a * b };
        let corners = [
            product(self.low, other.low),
            product(self.low, other.high),
            product(self.high, other.low),
            product(self.high, other.high),
        ];
        let low = corners.iter().copied().fold(f64::INFINITY, f64::min);
        let high = corners.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        Self::new(low, high, self.nonzero && other.nonzero)
    }

    /// Every value multiplied.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        self.times(Self { low: factor, high: factor, nonzero: factor != 0.0 })
    }

    fn power(self, exponent: &Rational) -> Self {
        let even = exponent.is_integer() && !exponent.has_odd_numerator();
        let size = exponent.abs().to_f64();
        let magnitude = if even {
            let high = self.low.abs().max(self.high.abs()).powf(size);
            let low =
                if self.low > 0.0 || self.high < 0.0 { self.low.abs().min(self.high.abs()) } else { 0.0 };
            Self::new(low.powf(size), high, self.nonzero)
        } else if exponent.is_integer() {
            Self::new(odd_power(self.low, size), odd_power(self.high, size), self.nonzero)
        } else {
            Self::new(self.low.max(0.0).powf(size), self.high.max(0.0).powf(size), self.nonzero)
        };
        if exponent.is_negative() { magnitude.reciprocal() } else { magnitude }
    }

    /// A reciprocal never vanishes where it is defined.
    fn reciprocal(self) -> Self {
        // the sign of a zero is not that of the range
        if self.low >= 0.0 {
            Self { low: 1.0 / self.high, high: 1.0 / self.low.abs(), nonzero: true }
        } else if self.high <= 0.0 {
            Self { low: -1.0 / self.high.abs(), high: 1.0 / self.low, nonzero: true }
        } else {
            Self { nonzero: true, ..Self::ALL }
        }
    }

    fn function(self, function: Function) -> Self {
        match function {
            Function::Sin | Function::Cos => Self::UNIT,
            Function::Exp => Self { nonzero: true, ..Self::new(self.low.exp(), self.high.exp(), true) },
            Function::Cosh => Self::new(1.0, f64::INFINITY, true),
            Function::Abs => Self::new(0.0, self.low.abs().max(self.high.abs()), self.nonzero),
            Function::Sign | Function::Tanh => Self { nonzero: self.nonzero, ..Self::UNIT },
            Function::Atan => Self::new(self.low.atan(), self.high.atan(), self.nonzero),
            Function::Sinh => Self::new(self.low.sinh(), self.high.sinh(), self.nonzero),
            Function::Asin => Self { low: -1.6, high: 1.6, nonzero: self.nonzero },
            Function::Acos => Self { low: 0.0, high: 3.2, nonzero: false },
            Function::Ln => Self::ALL,
        }
    }
}

fn odd_power(x: f64, size: f64) -> f64 {
    x.abs().powf(size).copysign(x)
}

/// What is known of the ranges of symbols, and of whole expressions.
#[derive(Clone, Debug, Default)]
pub struct Facts {
    /// Ranges of symbols; a symbol without one may have any value.
    pub symbols: FxHashMap<SymbolId, Range>,
    /// Ranges of expressions.
    pub expressions: FxHashMap<ExprId, Range>,
}

impl Range {
    fn contains(self, value: f64) -> bool {
        self.low <= value && value <= self.high && !(self.nonzero && value == 0.0)
    }
}

impl Graph {
    /// Whether facts hold at a point, as far as it has values for their symbols.
    pub(crate) fn hold_at(&self, facts: &Facts, point: &[(SymbolId, f64)]) -> bool {
        let value =
            |symbol| point.iter().find(|(known, _)| *known == symbol).map_or(f64::NAN, |(_, value)| *value);
        let of_symbols = facts.symbols.iter().map(|(symbol, range)| (value(*symbol), range));
        let of_expressions =
            facts.expressions.iter().map(|(id, range)| (self.evaluate(&[*id], value)[0].value, range));
        of_symbols.chain(of_expressions).all(|(value, range)| value.is_nan() || range.contains(value))
    }

    /// A range that contains every value of the expression where it is defined.
    #[must_use]
    pub fn range(&self, expression: ExprId, facts: &Facts) -> Range {
        let mut known: IdMap<ExprId, Range> = IdMap::default();
        for id in self.reachable(&[expression]) {
            let range = match facts.expressions.get(&id) {
                Some(range) => *range,
                None => self.range_of_node(id, &known, facts),
            };
            known.insert(id, range);
        }
        known[&expression]
    }

    fn range_of_node(&self, id: ExprId, known: &IdMap<ExprId, Range>, facts: &Facts) -> Range {
        if let Some(number) = self.value_of(id) {
            let value = number.to_f64();
            return Range::new(value, value, !number.is_zero());
        }
        match self.node(id) {
            Node::Pi => Range::new(3.1, 3.2, true),
            Node::Symbol(symbol) => facts.symbols.get(symbol).copied().unwrap_or(Range::ALL),
            Node::Sum { constant, terms } => {
                let value = constant.to_f64();
                let start = Range { low: value, high: value, nonzero: !constant.is_zero() };
                terms.iter().fold(start, |sum, (term, c)| sum.plus(known[term].scaled(c.to_f64())))
            }
            Node::Product { coefficient, factors } => {
                let value = coefficient.to_f64();
                let start = Range { low: value, high: value, nonzero: true };
                factors.iter().fold(start, |product, (base, e)| product.times(known[base].power(e)))
            }
            Node::Apply(function, x) => known[x].function(*function),
            // numbers and constants have values
            Node::Number(_) | Node::Constant(_) | Node::Apply2(..) => Range::ALL,
        }
    }

    /// Whether the expression vanishes nowhere, for all values of its symbols within the facts.
    #[must_use]
    pub fn vanishes_nowhere(&self, expression: ExprId, facts: &Facts) -> bool {
        self.range(expression, facts).nonzero
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reciprocals_keep_their_sign() {
        let negative = Range { low: f64::NEG_INFINITY, high: 0.0, nonzero: true };
        for high in [0.0, -0.0, -2.0] {
            let found = Range { high, ..negative }.reciprocal();
            assert!(found.low < 0.0 && found.high <= 0.0 && found.nonzero, "{found:?}");
            let found = Range { low: -high, high: f64::INFINITY, nonzero: true }.reciprocal();
            assert!(found.low >= 0.0 && found.high > 0.0 && found.nonzero, "{found:?}");
        }
    }

    #[test]
    fn what_is_proved_and_what_is_not() {
        let mut g = Graph::new();
        let (x, m) = (g.new_symbol("x"), g.new_symbol("m"));
        let (ex, em) = (g.symbol(x), g.symbol(m));
        let (one, two) = (g.one(), g.number(2));
        let none = Facts::default();
        let square = g.square(ex);
        let sum = g.add(one, square);
        assert!(g.vanishes_nowhere(sum, &none));
        let cos = g.cos(ex);
        assert!(!g.vanishes_nowhere(cos, &none));
        let touching = g.add(one, cos);
        assert!(!g.vanishes_nowhere(touching, &none));
        let clear = g.add(two, cos);
        assert!(g.vanishes_nowhere(clear, &none));
        let exp = g.apply(Function::Exp, ex);
        let quotient = g.div(exp, sum);
        assert!(g.vanishes_nowhere(quotient, &none));
        let inertia = g.add(em, square);
        assert!(!g.vanishes_nowhere(inertia, &none));
        let facts = Facts { symbols: [(m, Range::POSITIVE)].into_iter().collect(), ..Facts::default() };
        assert!(g.vanishes_nowhere(inertia, &facts));
    }
}

//! Elementary functions. Automatic identities:
//!
//! | identity | condition |
//! |---|---|
//! | `sin(−x) = −sin x`, `cos(−x) = cos x`, likewise for the other odd and even functions | – |
//! | `sin(x + kπ/2)`, `cos(x + kπ/2)` | `k` an integer |
//! | `sin x = cos(π/2 − x)` | `x` contains a part of a quarter turn |
//! | sine and cosine of multiples of π/6 and π/4 | – |
//! | `tan x = sin x / cos x` | – |
//! | `sin(asin x) = x`, `cos(asin x) = √(1−x²)` and their kin | where `asin x` is defined |
//! | `exp(ln x) = x`, `ln(exp x) = x` | where the left side is defined |

use super::graph::Graph;
use super::node::{Function, Function2, Node};
use super::number::Rational;
use crate::id::ExprId;

impl Graph {
    /// `sin x`.
    pub fn sin(&mut self, x: ExprId) -> ExprId {
        self.sin_ahead(x, 0)
    }

    /// `cos x`.
    pub fn cos(&mut self, x: ExprId) -> ExprId {
        self.sin_ahead(x, 1)
    }

    /// `sin(x + k·π/2)` for `k` quarter turns.
    fn sin_ahead(&mut self, x: ExprId, quarter_turns: u8) -> ExprId {
        let (more, rest) = self.split_quarter_turns(x);
        let (is_reflected, rest) = self.reflected(rest);
        let turns = (quarter_turns + more) % 4;
        let value = if turns.is_multiple_of(2) == is_reflected {
            self.cos_of_rest(rest)
        } else {
            self.sin_of_rest(rest)
        };
        if turns < 2 { value } else { self.neg(value) }
    }

    /// `tan x`, as a quotient.
    pub fn tan(&mut self, x: ExprId) -> ExprId {
        let (sin, cos) = (self.sin(x), self.cos(x));
        self.div(sin, cos)
    }

    /// The coefficient of π among the terms of `x`.
    fn multiple_of_pi(&mut self, x: ExprId) -> Rational {
        let pi = self.pi();
        let coefficient = match self.node(x) {
            Node::Pi => Some(Rational::ONE),
            Node::Product { coefficient, factors } if **factors == [(pi, Rational::ONE)] => {
                Some(coefficient.clone())
            }
            Node::Sum { terms, .. } => terms.iter().find(|(term, _)| *term == pi).map(|(_, c)| c.clone()),
            _ => None,
        };
        coefficient.unwrap_or(Rational::ZERO)
    }

    /// Writes `x = k·π/2 + rest` with `k` in 0..4 and the multiple of π in `rest` in [0, 1/2).
    fn split_quarter_turns(&mut self, x: ExprId) -> (u8, ExprId) {
        let pi = self.pi();
        let multiple = self.multiple_of_pi(x);
        if multiple.is_zero() {
            return (0, x);
        }
        let doubled = multiple * Rational::from(2);
        let floor = num_integer::Integer::div_floor(&doubled.numerator(), &doubled.denominator());
        let quarter = num_integer::Integer::mod_floor(&floor, &4.into());
        let Some(whole) = Rational::from_big(floor, 1.into()) else { return (0, x) };
        let rest = self.linear_combination(&[(Rational::ONE, x), (-whole * Rational::new(1, 2), pi)]);
        (num_traits::ToPrimitive::to_u8(&quarter).unwrap_or(0), rest)
    }

    /// Chooses between `x` and `π/2 − x`, which swaps sine and cosine, for angles with a part of a
    /// quarter turn: the rest leads positive, or is below π/4 if there is no rest.
    fn reflected(&mut self, x: ExprId) -> (bool, ExprId) {
        let pi = self.pi();
        let multiple = self.multiple_of_pi(x);
        if multiple.is_zero() {
            return (false, x);
        }
        let rest = self.linear_combination(&[(Rational::ONE, x), (-multiple.clone(), pi)]);
        let is_beyond = self.is_literal_zero(rest) && multiple > Rational::new(1, 4);
        if !is_beyond && !self.leads_negative(rest) {
            return (false, x);
        }
        let reflection = [(Rational::new(1, 2), pi), (Rational::MINUS_ONE, x)];
        (true, self.linear_combination(&reflection))
    }

    fn sin_of_rest(&mut self, x: ExprId) -> ExprId {
        if let Some(degrees) = self.degrees(x) {
            match degrees {
                0 => return self.zero(),
                30 => return self.number(Rational::new(1, 2)),
                45 => return self.half_root(2),
                60 => return self.half_root(3),
                _ => {}
            }
        }
        self.odd(Function::Sin, x)
    }

    fn cos_of_rest(&mut self, x: ExprId) -> ExprId {
        if let Some(degrees) = self.degrees(x) {
            match degrees {
                0 => return self.one(),
                30 => return self.half_root(3),
                45 => return self.half_root(2),
                60 => return self.number(Rational::new(1, 2)),
                _ => {}
            }
        }
        self.even(Function::Cos, x)
    }

    /// The angle in whole degrees, if it is a rational multiple of π that allows it.
    fn degrees(&mut self, x: ExprId) -> Option<i64> {
        let pi = self.pi();
        if self.is_literal_zero(x) {
            return Some(0);
        }
        let (coefficient, rest) = self.split_coefficient(x);
        (rest == pi).then(|| (coefficient * Rational::from(180)).to_i64()).flatten()
    }

    fn half_root(&mut self, n: i64) -> ExprId {
        let n = self.number(n);
        let root = self.sqrt(n);
        self.scale(Rational::new(1, 2), root)
    }

    /// Whether the leading coefficient is negative, so that `x` and `−x` share one form.
    fn leads_negative(&self, x: ExprId) -> bool {
        match self.node(x) {
            Node::Number(value) => value.is_negative(),
            Node::Sum { .. } => self.content(x).is_negative(),
            Node::Product { coefficient, .. } => coefficient.is_negative(),
            _ => false,
        }
    }

    fn odd(&mut self, function: Function, x: ExprId) -> ExprId {
        if self.leads_negative(x) {
            let positive = self.neg(x);
            let value = self.applied(function, positive);
            return self.neg(value);
        }
        self.applied(function, x)
    }

    fn even(&mut self, function: Function, x: ExprId) -> ExprId {
        let x = if self.leads_negative(x) { self.neg(x) } else { x };
        self.applied(function, x)
    }

    /// A function of one argument, in canonical form.
    pub fn apply(&mut self, function: Function, x: ExprId) -> ExprId {
        match function {
            Function::Sin => self.sin(x),
            Function::Cos => self.cos(x),
            Function::Asin | Function::Atan | Function::Sinh | Function::Tanh | Function::Sign => {
                self.odd(function, x)
            }
            Function::Cosh | Function::Abs => self.even(function, x),
            Function::Acos | Function::Exp | Function::Ln => self.applied(function, x),
        }
    }

    /// A function of two arguments.
    pub fn apply2(&mut self, function: Function2, x: ExprId, y: ExprId) -> ExprId {
        if let (Some(a), Some(b)) = (self.as_number(x), self.as_number(y)) {
            match function {
                Function2::Min => return if a <= b { x } else { y },
                Function2::Max => return if a >= b { x } else { y },
                Function2::Atan2 => {}
            }
        }
        if x == y && function != Function2::Atan2 {
            return x;
        }
        self.intern(Node::Apply2(function, x, y))
    }

    /// Folds special values and inverse pairs, and stores the rest.
    fn applied(&mut self, function: Function, x: ExprId) -> ExprId {
        if let Some(value) = self.as_number(x).cloned() {
            match function {
                Function::Abs => return self.number(value.abs()),
                Function::Sign if value.is_zero() => return self.zero(),
                Function::Sign => return self.one(),
                Function::Exp | Function::Cosh if value.is_zero() => return self.one(),
                Function::Asin | Function::Atan | Function::Sinh | Function::Tanh if value.is_zero() => {
                    return self.zero();
                }
                Function::Ln if value.is_one() => return self.zero(),
                _ => {}
            }
        }
        self.inverse_pair(function, x).unwrap_or_else(|| self.intern(Node::Apply(function, x)))
    }

    fn inverse_pair(&mut self, function: Function, x: ExprId) -> Option<ExprId> {
        if let Node::Apply2(Function2::Atan2, y, x) = *self.node(x) {
            let opposite = match function {
                Function::Sin => y,
                Function::Cos => x,
                _ => return None,
            };
            let (xx, yy) = (self.square(x), self.square(y));
            let squares = self.add(xx, yy);
            let radius = self.sqrt(squares);
            return Some(self.div(opposite, radius));
        }
        let Node::Apply(inner, argument) = *self.node(x) else { return None };
        match (function, inner) {
            (Function::Sin, Function::Asin)
            | (Function::Cos, Function::Acos)
            | (Function::Exp, Function::Ln)
            | (Function::Ln, Function::Exp) => Some(argument),
            (Function::Sin, Function::Acos) | (Function::Cos, Function::Asin) => {
                let one = self.one();
                let squared = self.square(argument);
                let rest = self.sub(one, squared);
                Some(self.sqrt(rest))
            }
            (Function::Sin | Function::Cos, Function::Atan) => {
                let one = self.one();
                let squared = self.square(argument);
                let sum = self.add(one, squared);
                let hypotenuse = self.sqrt(sum);
                let opposite = if function == Function::Sin { argument } else { one };
                Some(self.div(opposite, hypotenuse))
            }
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn multiples_of_pi_fold() {
        let mut g = Graph::new();
        let theta = g.new_symbol("theta");
        let (theta, pi) = (g.symbol(theta), g.pi());
        let shifted = g.linear_combination(&[(Rational::ONE, theta), (Rational::new(-3, 2), pi)]);
        assert_eq!(g.sin(shifted), g.cos(theta));
        let third = g.scale(Rational::new(2, 3), pi);
        let (cos, half) = (g.cos(third), g.number(Rational::new(-1, 2)));
        assert_eq!(cos, half);
        let tan = g.tan(pi);
        assert!(g.is_literal_zero(tan));
    }

    #[test]
    fn parts_of_a_quarter_turn_have_one_form() {
        let mut g = Graph::new();
        let a = g.new_symbol("a");
        let (a, pi) = (g.symbol(a), g.pi());
        for n in 1..8 {
            let n = Rational::new(n, 7);
            let left = g.linear_combination(&[(n.clone(), pi), (Rational::MINUS_ONE, a)]);
            let right = g.linear_combination(&[(Rational::ONE - n.clone(), pi), (Rational::ONE, a)]);
            assert_eq!(g.sin(left), g.sin(right));
            let cos = g.cos(right);
            assert_eq!(g.cos(left), g.neg(cos));
        }
        let (fifth, rest) = (g.scale(Rational::new(1, 5), pi), g.scale(Rational::new(3, 10), pi));
        assert_eq!(g.sin(fifth), g.cos(rest));
    }

    #[test]
    fn parity() {
        let mut g = Graph::new();
        let (a, b) = (g.new_symbol("a"), g.new_symbol("b"));
        let (a, b) = (g.symbol(a), g.symbol(b));
        let (d, e) = (g.sub(a, b), g.sub(b, a));
        assert_eq!(g.cos(d), g.cos(e));
        let (s, t) = (g.sin(d), g.sin(e));
        assert_eq!(s, g.neg(t));
    }

    #[test]
    fn inverse_functions_cancel() {
        let mut g = Graph::new();
        let x = g.new_symbol("x");
        let x = g.symbol(x);
        let asin = g.apply(Function::Asin, x);
        assert_eq!(g.sin(asin), x);
        let ln = g.apply(Function::Ln, x);
        assert_eq!(g.apply(Function::Exp, ln), x);
    }
}

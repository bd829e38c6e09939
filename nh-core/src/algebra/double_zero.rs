//! Double zeros: an expression that vanishes to second order on a hypersurface, as 1 − cos x does at x = 0. A root of it is
//! an absolute value there, whatever square it is or is not.

use super::graph::Graph;
use super::node::Node;
use super::number::Rational;
use super::polynomial_terms::{Terms, multiplied, sum_of};
use super::substitute::Substitution;
use super::zero_test::sample;
use crate::id::{ExprId, SymbolId};

/// Arguments that are looked at.
const ARGUMENTS: usize = 12;
/// Parts of a turn that they are tried at, and other numbers.
const PARTS_OF_A_TURN: i64 = 24;
const NUMBERS: [(i64, i64); 6] = [(1, 1), (-1, 1), (2, 1), (-2, 1), (1, 2), (-1, 2)];

impl Graph {
    /// Something that is no number and made of other symbols than the `fixed` ones, on the zeros of which the expression
    /// has a double zero, for any values of the other symbols: zero with its first derivative, and not with the second.
    ///
    /// Looked at are symbols and the arguments of functions, at 0, at some numbers, and at the parts of a turn.
    pub fn double_zero(&mut self, expression: ExprId, fixed: &[SymbolId]) -> Option<ExprId> {
        let mut arguments: Vec<ExprId> = Vec::new();
        for id in self.reachable(&[expression]) {
            let argument = match self.node(id) {
                Node::Symbol(_) => id,
                Node::Apply(_, x) => *x,
                _ => continue,
            };
            let argument = self.primitive(argument);
            if !arguments.contains(&argument) {
                arguments.push(argument);
            }
        }
        let numbers = self.numbers();
        for argument in arguments.into_iter().take(ARGUMENTS) {
            let symbols = self.symbols_in(&[argument]);
            let Some(free) = symbols.into_iter().find(|symbol| !fixed.contains(symbol)) else { continue };
            let Ok(form) = self.linear_form(argument, &[free]) else { continue };
            let (slope, rest) = (form.coefficients[0], form.rest);
            for number in &numbers {
                let number = *number;
                let place = self.formula((number - rest) / slope);
                if self.is_double_zero(expression, free, place) {
                    return Some(self.sub(argument, number));
                }
            }
        }
        self.is_turned_circle(expression, fixed).then_some(expression)
    }

    /// A multiple without a number as factor.
    fn primitive(&mut self, argument: ExprId) -> ExprId {
        let content = self.content(argument).recip().unwrap_or(Rational::ONE);
        self.scale(content, argument)
    }

    /// Values at which functions are known to touch others.
    fn numbers(&mut self) -> Vec<ExprId> {
        let pi = self.pi();
        let half = PARTS_OF_A_TURN / 2;
        let mut found: Vec<ExprId> =
            NUMBERS.iter().map(|(n, d)| self.number(Rational::new(*n, *d))).collect();
        found.extend((1 - half..=half).map(|part| self.scale(Rational::new(part, half), pi)));
        // 0 first, then what is short
        found.sort_by_key(|number| self.text(*number).len());
        found
    }

    fn is_double_zero(&mut self, expression: ExprId, symbol: SymbolId, at: ExprId) -> bool {
        let mut there = Substitution::new([(symbol, at)]);
        let value = there.apply(self, expression);
        if !self.may_vanish(value) || !self.zero_test(value).is_zero() {
            return false;
        }
        let first = self.partial(expression, symbol);
        let slope = there.apply(self, first);
        if !self.may_vanish(slope) || !self.zero_test(slope).is_zero() {
            return false;
        }
        let second = self.partial(first, symbol);
        let curvature = there.apply(self, second);
        !self.is_undefined(curvature) && self.zero_test(curvature).is_nonzero()
    }

    /// Whether it has a value, and that at a point is not certainly another one than 0.
    fn may_vanish(&self, expression: ExprId) -> bool {
        if self.is_undefined(expression) {
            return false;
        }
        let symbols = self.symbols_in(&[expression]);
        let value = |symbol| sample(0, symbols.iter().position(|known| *known == symbol).unwrap_or(0));
        !self.evaluate(&[expression], value)[0].is_certainly_nonzero()
    }

    /// Whether it is p + s sin u + c cos u with p² = s² + c², which is p (1 + cos (u − u₀)).
    fn is_turned_circle(&self, expression: ExprId, fixed: &[SymbolId]) -> bool {
        let Some(polynomial) = self.polynomial_terms(expression) else { return false };
        let (mut amplitudes, others) = self.amplitudes(&polynomial);
        let (_, mean) = amplitudes.remove(&Terms::new()).unwrap_or_default();
        let mut amplitudes = amplitudes.into_iter();
        let (Some((angle, (sine, cosine))), None) = (amplitudes.next(), amplitudes.next()) else {
            return false;
        };
        let parts: Vec<ExprId> = angle.keys().flatten().map(|(part, _)| *part).collect();
        let varies = self.symbols_in(&parts).iter().any(|symbol| !fixed.contains(symbol));
        let mean = sum_of(&mean, &others);
        let [Some(squared_mean), Some(one), Some(other)] =
            [&mean, &sine, &cosine].map(|amplitude| multiplied(amplitude, amplitude))
        else {
            return false;
        };
        varies && !mean.is_empty() && squared_mean == sum_of(&one, &other)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::Function;

    /// Roots of x, y and a number a: where their radicands touch 0.
    #[test]
    fn what_touches_zero_and_what_does_not() {
        let mut g = Graph::new();
        let symbols = ["x", "y", "a"].map(|name| g.new_symbol(name));
        let [x, y, a] = symbols.map(|symbol| g.symbol(symbol));
        let (one, difference, twice) = (g.one(), g.sub(x, y), g.scale(2.into(), x));
        let (cx, cy, cd, ca, c2) = (g.cos(x), g.cos(y), g.cos(difference), g.cos(a), g.cos(twice));
        let (sx, hyperbolic, exp, ln) =
            (g.sin(x), g.apply(Function::Cosh, x), g.apply(Function::Exp, x), g.apply(Function::Ln, x));
        let (three, four) = (g.scale(3.into(), sx), g.scale(4.into(), cx));
        let five = g.number(5);
        let cubed = g.formula(x.square() * x);
        let cases = [
            (g.formula(one - cx), Some("x")),
            (g.formula(one + cx), Some("x - pi")),
            (g.formula(one - sx), Some("x - pi/2")),
            (g.formula(a - a * cx), Some("x")),
            (g.formula(one - cx.square()), Some("x")),
            (g.formula(hyperbolic - one), Some("x")),
            (g.formula(exp - x - one), Some("x")),
            (g.formula(x - ln - one), Some("x - 1")),
            (g.formula(one - cd), Some("x - y")),
            (g.formula(one + one - cx - c2), Some("x")),
            (g.formula(x.square() + cubed), Some("x")),
            (g.formula(five + three + four), Some("4*cos(x) + 3*sin(x) + 5")),
            (g.formula(one + one - cx), None),
            (g.formula(one + one - cx - cy), None),
            (g.formula(x.square() + y.square()), None),
            (g.formula(one - cx * cy), None),
            (g.formula(one - x.square()), None),
            (g.formula(one - ca), None),
            (g.formula(a * a + one - a * cx), None),
            (g.formula((one - cx) * (one - cx)), None),
            (cubed, None),
        ];
        for (radicand, at) in cases {
            let found = g.double_zero(radicand, &[symbols[2]]).map(|at| g.text(at));
            assert_eq!(found.as_deref(), at, "{}", g.text(radicand));
        }
    }
}

//! Expressions as text, in the syntax of the declaration: what is printed can be typed.

use super::graph::Graph;
use super::node::{Function2, Node};
use super::number::Rational;
use crate::id::ExprId;

/// How tightly the surroundings bind.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum Level {
    Sum,
    Term,
    Power,
}

struct Printer<'a> {
    graph: &'a Graph,
    text: String,
    limit: usize,
    is_cut: bool,
}

impl Graph {
    /// The expression as text: what is shared is written again wherever it occurs, so that texts can be
    /// exponentially longer than what they say. [`Self::text_within`] has a bound.
    #[must_use]
    pub fn text(&self, id: ExprId) -> String {
        self.text_within(id, usize::MAX)
    }

    /// The expression as text, cut with `…` where it would be much longer than `limit` bytes.
    #[must_use]
    pub fn text_within(&self, id: ExprId, limit: usize) -> String {
        let mut printer = Printer { graph: self, text: String::new(), limit, is_cut: false };
        printer.expression(id, Level::Sum);
        printer.text
    }
}

impl Printer<'_> {
    fn expression(&mut self, id: ExprId, level: Level) {
        if self.text.len() > self.limit {
            self.write("…");
            self.is_cut = true;
            return;
        }
        match self.graph.node(id) {
            Node::Number(value) => self.number(value, level),
            Node::Pi => self.write("pi"),
            Node::Constant(constant) => self.write(&self.graph.constants()[*constant].name),
            Node::Symbol(symbol) => self.write(&self.graph.symbols()[*symbol]),
            Node::Sum { constant, terms } => self.sum(constant, terms, level),
            Node::Product { coefficient, factors } => self.product(coefficient, factors, level),
            Node::Apply(function, x) => self.call(function.name(), &[*x]),
            Node::Apply2(function, x, y) => {
                debug_assert!(*function != Function2::Atan2 || function.name() == "atan2");
                self.call(function.name(), &[*x, *y]);
            }
        }
    }

    /// Writes on; where the text is cut, nothing but parentheses is closed.
    fn write(&mut self, text: &str) {
        if !self.is_cut {
            self.text.push_str(text);
        }
    }

    fn number(&mut self, value: &Rational, level: Level) {
        let bare = value.is_integer() && !value.is_negative();
        let fits = bare || level == Level::Sum || (level == Level::Term && !value.is_negative());
        self.parenthesised(!fits, |p| p.write(&value.to_string()));
    }

    fn parenthesised(&mut self, wrap: bool, print: impl FnOnce(&mut Self)) {
        let wrap = wrap && !self.is_cut;
        if wrap {
            self.text.push('(');
        }
        print(self);
        if wrap {
            self.text.push(')');
        }
    }

    fn call(&mut self, name: &str, arguments: &[ExprId]) {
        if self.is_cut {
            return;
        }
        self.write(name);
        self.write("(");
        for (index, argument) in arguments.iter().enumerate() {
            if index > 0 {
                self.write(", ");
            }
            self.expression(*argument, Level::Sum);
        }
        self.text.push(')');
    }

    /// A positive summand comes first, so that no sum starts with a minus needlessly.
    fn sum(&mut self, constant: &Rational, terms: &[(ExprId, Rational)], level: Level) {
        self.parenthesised(level > Level::Sum, |p| {
            let first = terms.iter().position(|(_, c)| !c.is_negative()).unwrap_or(0);
            let rest = (0..terms.len()).filter(|index| *index != first);
            for (position, index) in std::iter::once(first).chain(rest).enumerate() {
                let (term, coefficient) = &terms[index];
                p.sign(coefficient.is_negative(), position == 0);
                p.scaled(&coefficient.abs(), *term);
            }
            if !constant.is_zero() {
                p.sign(constant.is_negative(), false);
                p.write(&constant.abs().to_string());
            }
        });
    }

    fn sign(&mut self, negative: bool, first: bool) {
        self.write(match (negative, first) {
            (true, true) => "-",
            (false, true) => "",
            (true, false) => " - ",
            (false, false) => " + ",
        });
    }

    fn scaled(&mut self, coefficient: &Rational, term: ExprId) {
        match self.graph.node(term) {
            Node::Product { factors, .. } => self.product(coefficient, factors, Level::Sum),
            _ => self.product(coefficient, &[(term, Rational::ONE)], Level::Sum),
        }
    }

    /// Numerator factors, then `/` and the denominators.
    fn product(&mut self, coefficient: &Rational, factors: &[(ExprId, Rational)], level: Level) {
        let below = || factors.iter().filter(|(_, exponent)| exponent.is_negative());
        let above = || factors.iter().filter(|(_, exponent)| !exponent.is_negative());
        let lone_power = coefficient.is_one() && factors.len() == 1 && below().next().is_none();
        self.parenthesised(level == Level::Power && !(lone_power && factors[0].1.is_one()), |p| {
            p.sign(coefficient.is_negative(), true);
            let magnitude = coefficient.abs().to_string();
            let (numerator, denominator) = magnitude.split_once('/').unwrap_or((&magnitude, "1"));
            let mut started = false;
            if numerator != "1" || above().next().is_none() {
                p.write(numerator);
                started = true;
            }
            for (base, exponent) in above() {
                if started {
                    p.write("*");
                }
                p.power(*base, exponent);
                started = true;
            }
            if denominator != "1" {
                p.write("/");
                p.write(denominator);
            }
            for (base, exponent) in below() {
                p.write("/");
                p.power(*base, &exponent.abs());
            }
        });
    }

    fn power(&mut self, base: ExprId, exponent: &Rational) {
        if exponent.is_one() {
            return self.expression(base, Level::Power);
        }
        if *exponent == Rational::new(1, 2) {
            return self.call("sqrt", &[base]);
        }
        self.expression(base, Level::Power);
        self.write("^");
        self.number(exponent, Level::Power);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_like_a_declaration() {
        let mut g = Graph::new();
        let names = ["m", "a", "omega", "x"].map(|name| g.new_symbol(name));
        let [m, a, omega, x] = names.map(|symbol| g.symbol(symbol));
        let aa = g.square(a);
        let inertia = g.mul(m, aa);
        let e = g.mul(inertia, omega);
        let half = g.scale(Rational::new(-1, 2), e);
        assert_eq!(g.text(half), "-m*a^2*omega/2");
        let s = g.sub(half, x);
        let q = g.div(x, s);
        assert_eq!(g.text(q), "-2*x/(2*x + m*a^2*omega)");
        let root = g.sqrt(s);
        assert_eq!(g.text(root), "sqrt(-x - m*a^2*omega/2)");
        let negative_power = g.pow(x, Rational::new(-2, 3));
        assert_eq!(g.text(negative_power), "1/x^(2/3)");
    }

    #[test]
    fn long_text_is_cut() {
        let mut g = Graph::new();
        let x = g.new_symbol("x");
        let mut e = g.symbol(x);
        for _ in 0..200 {
            let one = g.one();
            let sum = g.add(e, one);
            let sin = g.sin(sum);
            e = g.mul(sin, sum);
        }
        let deep = g.text_within(e, 80);
        assert!(deep.len() < 200 && deep.contains('…'), "{deep}");
        let all: Vec<ExprId> = (0..500)
            .map(|index| {
                let symbol = g.new_symbol(format!("y{index}"));
                g.symbol(symbol)
            })
            .collect();
        let sum = g.sum(&all);
        assert_eq!(g.text_within(sum, 10), "y0 + y1 + y2 + …");
        let factors: Vec<_> = all.into_iter().map(|y| (y, Rational::ONE)).collect();
        let product = g.product(&factors);
        assert_eq!(g.text_within(product, 7), "y0*y1*y2*…");
    }
}

//! Expressions as formulas: fractions, roots, powers, functions without needless parentheses.

use super::line::{Line, Typeset};
use super::names::Names;
use crate::algebra::{Function, Function2, Graph, Node, Rational};
use crate::id::ExprId;

/// What is wider is written in a way that can be broken: a fraction as a product, a root as a power.
const WIDE: usize = 17_000;
/// What is wider between parentheses can be broken there.
const GROUP: usize = 9_000;
/// Products are broken where nothing else is left to break, as if so many brackets were around.
const FACTOR: usize = 4;
/// Where functions with names stand in a product: last.
const OPERATOR: u8 = 5;
/// Numbers with more digits are rounded.
const DIGITS: usize = 24;

/// How tightly the surroundings bind.
#[derive(Clone, Copy, PartialEq)]
enum Level {
    Sum,
    Factor,
    Base,
}

/// A factor of a product.
#[derive(Clone)]
enum Factor<'a> {
    Power(ExprId, Rational),
    /// A power of a tangent.
    Tangent(ExprId, Rational),
    /// A name that is no expression: a section, an acceleration.
    Name(&'a Typeset),
}

/// Writes expressions.
pub(super) struct Printer<'a> {
    graph: &'a Graph,
    names: &'a Names,
    /// The nodes that may still be written.
    left: usize,
}

impl<'a> Printer<'a> {
    /// Writes up to so many nodes; dots stand for the rest.
    pub(super) fn new(graph: &'a Graph, names: &'a Names, nodes: usize) -> Self {
        Self { graph, names, left: nodes }
    }

    /// The expression.
    pub(super) fn formula(&mut self, id: ExprId) -> Line {
        let mut line = Line::default();
        self.expression(&mut line, id, Level::Sum);
        line
    }

    /// Σ coefficient · name, with signs in front.
    pub(super) fn combination(&mut self, coefficients: &[ExprId], names: &[Typeset]) -> Line {
        let mut line = Line::default();
        for (coefficient, name) in coefficients.iter().zip(names) {
            if self.graph.is_literal_zero(*coefficient) {
                continue;
            }
            if !line.is_empty() {
                line.may_break(0, "");
            }
            if self.left == 0 {
                line.write(r" + \cdots", 2_500);
                break;
            }
            let (number, mut factors) = self.factors(*coefficient);
            factors.push(Factor::Name(name));
            sign(&mut line, number.is_negative());
            self.product(&mut line, &number.abs(), &factors);
        }
        if line.is_empty() {
            line.write("0", 500);
        }
        line
    }

    fn factors(&self, id: ExprId) -> (Rational, Vec<Factor<'a>>) {
        match self.graph.node(id) {
            Node::Number(number) => (number.clone(), Vec::new()),
            Node::Product { coefficient, factors } => (
                coefficient.clone(),
                factors.iter().map(|(base, e)| Factor::Power(*base, e.clone())).collect(),
            ),
            _ => (Rational::ONE, vec![Factor::Power(id, Rational::ONE)]),
        }
    }

    fn expression(&mut self, line: &mut Line, id: ExprId, level: Level) {
        if self.left == 0 {
            line.write(r"\cdots", 1_300);
            return;
        }
        self.left -= 1;
        match self.graph.node(id) {
            Node::Number(value) => {
                let mut inner = Line::default();
                sign(&mut inner, value.is_negative());
                number(&mut inner, &value.abs());
                let is_bare = level == Level::Sum || (value.is_integer() && !value.is_negative());
                enclosed_unless(is_bare, line, inner);
            }
            Node::Pi => line.write(r"\pi", 600),
            Node::Constant(constant) => line.push(&self.names.constant(*constant).typeset()),
            Node::Symbol(symbol) => match self.names.call(*symbol) {
                Some((name, arguments)) => self.call(line, &name.typeset(), &arguments.clone()),
                None => line.push(&self.names.symbol(*symbol).typeset()),
            },
            Node::Sum { constant, terms } => {
                let mut inner = Line::default();
                self.sum(&mut inner, constant, terms);
                enclosed_unless(level == Level::Sum, line, inner);
            }
            Node::Product { .. } => {
                let (coefficient, factors) = self.factors(id);
                let mut inner = Line::default();
                sign(&mut inner, coefficient.is_negative());
                self.product(&mut inner, &coefficient.abs(), &factors);
                let is_bare = level == Level::Sum || (level == Level::Factor && !coefficient.is_negative());
                enclosed_unless(is_bare, line, inner);
            }
            Node::Apply(function, x) => {
                let mut inner = Line::default();
                self.apply(&mut inner, *function, *x, None);
                let is_bare = level != Level::Base || *function == Function::Abs;
                enclosed_unless(is_bare, line, inner);
            }
            Node::Apply2(function, x, y) => {
                let name = match function {
                    Function2::Atan2 => Typeset::new(r"\operatorname{atan2}", 2_800),
                    Function2::Min => Typeset::new(r"\min", 2_000),
                    Function2::Max => Typeset::new(r"\max", 2_000),
                };
                let mut inner = Line::default();
                self.call(&mut inner, &name, &[*x, *y]);
                enclosed_unless(level != Level::Base, line, inner);
            }
        }
    }

    /// A positive summand comes first, so that no sum starts with a minus needlessly.
    fn sum(&mut self, line: &mut Line, constant: &Rational, terms: &[(ExprId, Rational)]) {
        let first = terms.iter().position(|(_, c)| !c.is_negative()).unwrap_or(0);
        let rest = (0..terms.len()).filter(|index| *index != first);
        for index in std::iter::once(first).chain(rest) {
            let Some((term, coefficient)) = terms.get(index) else { continue };
            line.may_break(0, "");
            if self.left == 0 || (!line.is_empty() && !self.fits(*term)) {
                self.left = 0;
                line.write(r" + \cdots", 2_500);
                return;
            }
            sign(line, coefficient.is_negative());
            let (own, factors) = self.factors(*term);
            self.product(line, &(own.abs() * coefficient.abs()), &factors);
        }
        if !constant.is_zero() {
            line.may_break(0, "");
            sign(line, constant.is_negative());
            number(line, &constant.abs());
        }
    }

    /// Whether all of an expression can still be written.
    fn fits(&self, id: ExprId) -> bool {
        let (mut open, mut left) = (vec![id], self.left);
        while let Some(id) = open.pop() {
            let Some(less) = left.checked_sub(1) else { return false };
            left = less;
            let node = self.graph.node(id);
            if node.breadth() > left {
                return false;
            }
            open.extend(node.operands());
        }
        true
    }

    /// A number that is not negative times factors: what has a negative exponent stands below.
    fn product(&mut self, line: &mut Line, number_in_front: &Rational, factors: &[Factor<'_>]) {
        let (above, below) = self.ordered(factors);
        let (over, under) =
            (number_in_front.numerator().to_string(), number_in_front.denominator().to_string());
        if below.is_empty() {
            let is_one = number_in_front.is_one();
            if !is_one || above.is_empty() {
                number(line, number_in_front);
            }
            return self.several(line, &above, is_one);
        }
        let (numerator, is_sum) = self.part(&over, &above);
        let (denominator, _) = self.part(&under, &below);
        if numerator.width() <= WIDE && denominator.width() <= WIDE {
            let (above, below) = (numerator.joined(), denominator.joined());
            let width = above.width.max(below.width) + 350;
            line.write(&format!(r"\frac{{{}}}{{{}}}", above.tex, below.tex), width);
            line.is_tall = true;
            return;
        }
        // a fraction that is too wide is a product
        let is_narrow = denominator.width() <= WIDE;
        if is_narrow {
            let below = denominator.clone().joined();
            line.write(&format!(r"\frac{{1}}{{{}}}\,", below.tex), below.width + 500);
            line.is_tall = true;
        }
        enclosed_unless(!is_sum, line, numerator);
        if !is_narrow {
            line.may_break(FACTOR, r"{}\cdot ");
            line.write(r"\,", 170);
            enclosed_unless(false, line, denominator);
            line.write("^{-1}", 1_000);
        }
    }

    /// What stands above or below the line of a fraction, and whether it is a sum.
    fn part(&mut self, number: &str, factors: &[Factor<'_>]) -> (Line, bool) {
        let mut line = Line::default();
        if let ("1", [Factor::Power(base, exponent)]) = (number, factors)
            && exponent.is_one()
            && matches!(self.graph.node(*base), Node::Sum { .. })
        {
            self.expression(&mut line, *base, Level::Sum);
            return (line, true);
        }
        let is_one = number == "1" && !factors.is_empty();
        if !is_one {
            line.push(&digits(number));
        }
        self.several(&mut line, factors, is_one);
        (line, false)
    }

    /// Factors with positive exponents in the order in which they are read, functions last, and those of the
    /// denominator. Sines over cosines are tangents.
    fn ordered<'f>(&self, factors: &[Factor<'f>]) -> (Vec<Factor<'f>>, Vec<Factor<'f>>) {
        let (mut above, mut below) = (Vec::new(), Vec::new());
        for factor in factors {
            match factor {
                Factor::Power(base, exponent) if exponent.is_negative() => {
                    below.push(Factor::Power(*base, exponent.abs()));
                }
                other => above.push(other.clone()),
            }
        }
        for factor in &mut above {
            let Factor::Power(sine, exponent) = factor else { continue };
            let Node::Apply(Function::Sin, x) = self.graph.node(*sine) else { continue };
            let is_cosine = |other: &Factor<'_>| {
                matches!(other, Factor::Power(base, e)
                    if e == exponent && *self.graph.node(*base) == Node::Apply(Function::Cos, *x))
            };
            if let Some(place) = below.iter().position(is_cosine) {
                below.remove(place);
                *factor = Factor::Tangent(*x, exponent.clone());
            }
        }
        above.sort_by_key(|factor| self.place(factor));
        below.sort_by_key(|factor| self.place(factor));
        (above, below)
    }

    /// Numbers and letters come first, then sums and roots, then functions.
    fn place(&self, factor: &Factor<'_>) -> u8 {
        match factor {
            Factor::Power(base, _) => match self.graph.node(*base) {
                Node::Number(_) | Node::Pi | Node::Constant(_) => 0,
                Node::Symbol(symbol) => self.names.place(*symbol),
                Node::Sum { .. } | Node::Product { .. } | Node::Apply(Function::Abs | Function::Exp, _) => 3,
                Node::Apply(..) | Node::Apply2(..) => OPERATOR,
            },
            Factor::Name(_) => 4,
            Factor::Tangent(..) => OPERATOR,
        }
    }

    fn several(&mut self, line: &mut Line, factors: &[Factor<'_>], is_first: bool) {
        for (index, factor) in factors.iter().enumerate() {
            if index > 0 || !is_first {
                line.may_break(FACTOR, r"{}\cdot ");
                // the names of functions bring their space along
                line.write(if self.place(factor) == OPERATOR { " " } else { r"\," }, 170);
            }
            match factor {
                Factor::Power(base, exponent) => self.power(line, *base, exponent),
                Factor::Tangent(x, exponent) => {
                    self.named(line, &Typeset::new(r"\tan", 1_600), *x, Some(exponent));
                }
                Factor::Name(name) => line.push(name),
            }
            if self.left == 0 {
                if factors.len() > index + 1 {
                    line.write(r"\cdots", 1_300);
                }
                return;
            }
        }
    }

    fn power(&mut self, line: &mut Line, base: ExprId, exponent: &Rational) {
        if exponent.is_one() {
            return self.expression(line, base, Level::Factor);
        }
        if let Node::Apply(function, x) = self.graph.node(base)
            && exponent.is_integer()
            && matches!(
                function,
                Function::Sin | Function::Cos | Function::Sinh | Function::Cosh | Function::Tanh
            )
        {
            self.left = self.left.saturating_sub(1);
            return self.apply(line, *function, *x, Some(exponent));
        }
        let root = exponent.recip().filter(Rational::is_integer);
        if let Some(root) = root {
            let mut inner = Line::default();
            self.expression(&mut inner, base, Level::Sum);
            if inner.width() > WIDE {
                enclosed_unless(false, line, inner);
                return line.write(&format!("^{{1/{root}}}"), 1_300);
            }
            line.is_tall |= inner.is_tall;
            let inner = inner.joined();
            let index = if root == Rational::from(2) { String::new() } else { format!("[{root}]") };
            return line.write(&format!(r"\sqrt{index}{{{}}}", inner.tex), inner.width + 1_000);
        }
        self.expression(line, base, Level::Base);
        let exponent = exponent.to_string();
        line.write(&format!("^{{{exponent}}}"), 400 * exponent.len() + 100);
    }

    fn apply(&mut self, line: &mut Line, function: Function, x: ExprId, exponent: Option<&Rational>) {
        let name = match function {
            Function::Abs | Function::Exp => {
                let mut inner = Line::default();
                self.expression(&mut inner, x, Level::Sum);
                let is_narrow = inner.width() <= GROUP;
                return match (function, is_narrow) {
                    (Function::Exp, true) => {
                        let inner = inner.joined();
                        line.write(&format!("e^{{{}}}", inner.tex), inner.width + 500);
                    }
                    (Function::Exp, false) => {
                        line.write(r"\exp", 1_600);
                        enclosed_unless(false, line, inner);
                    }
                    _ => between(line, inner, [r"\lvert", r"\rvert"]),
                };
            }
            Function::Sin => Typeset::new(r"\sin", 1_400),
            Function::Cos => Typeset::new(r"\cos", 1_600),
            Function::Asin => Typeset::new(r"\arcsin", 2_700),
            Function::Acos => Typeset::new(r"\arccos", 2_900),
            Function::Atan => Typeset::new(r"\arctan", 3_000),
            Function::Sinh => Typeset::new(r"\sinh", 1_900),
            Function::Cosh => Typeset::new(r"\cosh", 2_100),
            Function::Tanh => Typeset::new(r"\tanh", 2_200),
            Function::Ln => Typeset::new(r"\ln", 1_000),
            Function::Sign => Typeset::new(r"\operatorname{sgn}", 1_700),
        };
        self.named(line, &name, x, exponent);
    }

    /// A function with its argument, in parentheses unless it is a letter.
    fn named(&mut self, line: &mut Line, name: &Typeset, x: ExprId, exponent: Option<&Rational>) {
        line.push(name);
        if let Some(exponent) = exponent.filter(|exponent| !exponent.is_one()) {
            let exponent = exponent.to_string();
            line.write(&format!("^{{{exponent}}}"), 400 * exponent.len() + 100);
        }
        let is_letter = match self.graph.node(x) {
            Node::Symbol(symbol) => self.names.call(*symbol).is_none(),
            Node::Pi | Node::Constant(_) => true,
            _ => false,
        };
        let mut inner = Line::default();
        self.expression(&mut inner, x, Level::Sum);
        if is_letter {
            line.write(" ", 170);
        }
        enclosed_unless(is_letter, line, inner);
    }

    fn call(&mut self, line: &mut Line, name: &Typeset, arguments: &[ExprId]) {
        line.push(name);
        let mut inner = Line::default();
        for (index, argument) in arguments.iter().enumerate() {
            if index > 0 {
                inner.write(", ", 500);
                inner.may_break(1, "");
            }
            let mut one = Line::default();
            self.expression(&mut one, *argument, Level::Sum);
            inner.append(one, 1);
        }
        enclosed_unless(false, line, inner);
    }
}

/// A sign: between summands, or in front of the first.
fn sign(line: &mut Line, is_negative: bool) {
    match (is_negative, line.is_empty()) {
        (true, true) => line.write("-", 800),
        (false, true) => {}
        (true, false) => line.write(" - ", 1_300),
        (false, false) => line.write(" + ", 1_300),
    }
}

/// Any number.
pub(super) fn numeral(value: &Rational) -> Typeset {
    let mut line = Line::default();
    sign(&mut line, value.is_negative());
    number(&mut line, &value.abs());
    line.joined()
}

/// A number that is not negative.
fn number(line: &mut Line, value: &Rational) {
    let (over, under) = (value.numerator().to_string(), value.denominator().to_string());
    if under == "1" {
        return line.push(&digits(&over));
    }
    let (over, under) = (digits(&over), digits(&under));
    line.write(&format!(r"\frac{{{}}}{{{}}}", over.tex, under.tex), over.width.max(under.width) + 350);
    line.is_tall = true;
}

/// Digits; of very many of them, the first ones.
fn digits(text: &str) -> Typeset {
    if text.len() <= DIGITS {
        return Typeset::new(text, 510 * text.len());
    }
    let (first, rest) = text.split_at(1);
    let more: String = rest.chars().take(DIGITS / 2).collect();
    Typeset::new(format!(r"{first}.{more}{{\ldots}}\cdot 10^{{{}}}", rest.len()), 510 * (DIGITS / 2) + 5_500)
}

fn enclosed_unless(is_bare: bool, line: &mut Line, inner: Line) {
    if is_bare { line.append(inner, 0) } else { between(line, inner, ["(", ")"]) }
}

/// Between parentheses or bars: what is wide can be broken between them.
fn between(line: &mut Line, inner: Line, [open, close]: [&str; 2]) {
    let space = if open.starts_with('\\') { " " } else { "" };
    if inner.width() <= GROUP {
        let is_tall = inner.is_tall;
        let inner = inner.joined();
        let (left, right, more) = if is_tall { (r"\left", r"\right", 700) } else { ("", "", 0) };
        let tex = inner.tex;
        line.write(&format!("{left}{open}{space}{tex}{right}{close}"), inner.width + 900 + more);
        line.is_tall |= is_tall;
        return;
    }
    let size = if inner.is_tall { r"\Bigl" } else { r"\bigl" };
    line.write(&format!("{size}{open}{space}"), 700);
    line.append(inner, 1);
    line.write(&format!("{}{close}", size.replace('l', "r")), 700);
}

#[cfg(test)]
#[path = "expression_tests.rs"]
mod expression_tests;

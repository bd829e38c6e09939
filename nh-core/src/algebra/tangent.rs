//! Automatic differentiation at points of the field: derivatives along a direction, and gradients together
//! with their derivatives along it, which is all of a second-order jet that an equation of motion asks for.
//!
//! It shares the values of functions with [`FieldPass`], and no rule with the derivatives of expressions
//! (`derivative.rs`): what these come to is proved against it.

use super::field::Residue;
use super::modular::{FieldPass, NoValue};
use super::node::{Function, Function2, Node};
use super::number::Rational;
use crate::id::{ExprId, SymbolId};
use crate::id_map::IdMap;
use rustc_hash::{FxHashMap, FxHashSet};

/// A direction: the rates of symbols. The others rest.
pub(crate) type Direction = FxHashMap<SymbolId, Residue>;

/// A value, and its derivative along a direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Dual {
    pub(crate) value: Residue,
    pub(crate) rate: Residue,
}

impl Dual {
    pub(crate) const ZERO: Self = Self::constant(Residue::ZERO);

    pub(crate) const fn constant(value: Residue) -> Self {
        Self { value, rate: Residue::ZERO }
    }
}

impl std::ops::Add for Dual {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, rate: self.rate + other.rate }
    }
}

impl std::ops::Sub for Dual {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { value: self.value - other.value, rate: self.rate - other.rate }
    }
}

impl std::ops::Mul for Dual {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self { value: self.value * other.value, rate: self.value * other.rate + self.rate * other.value }
    }
}

/// The values of expressions at a point, and their rates along a direction.
pub(crate) struct TangentPass<'p, 'a> {
    pass: &'p mut FieldPass<'a>,
    direction: Direction,
    /// Nothing of what contains no symbol that moves: that has a rate of 0 even where the function of it has no slope.
    rates: IdMap<ExprId, Option<Residue>>,
}

impl<'p, 'a> TangentPass<'p, 'a> {
    pub(crate) fn new(pass: &'p mut FieldPass<'a>, direction: Direction) -> Self {
        Self { pass, direction, rates: IdMap::default() }
    }

    /// Gives a symbol a value with its rate before it occurs; false where it has another value already.
    #[must_use]
    pub(crate) fn choose(&mut self, symbol: SymbolId, dual: Dual) -> bool {
        self.direction.insert(symbol, dual.rate);
        self.pass.choose(symbol, dual.value)
    }

    /// As [`FieldPass::kernel`].
    pub(crate) fn kernel(&self, name: &str, arguments: &[Residue]) -> Residue {
        self.pass.kernel(name, arguments)
    }

    /// The expressions with their rates.
    ///
    /// # Errors
    /// As [`FieldPass::evaluate`].
    pub(crate) fn duals(&mut self, roots: &[ExprId]) -> Result<Vec<Dual>, NoValue> {
        self.pass.evaluate(roots)?;
        for id in self.pass.graph.reachable_beyond(roots, |id| self.rates.contains_key(&id)) {
            let mut rate = None;
            if let Node::Symbol(symbol) = self.pass.graph.node(id) {
                rate = self.direction.get(symbol).copied().filter(|rate| *rate != Residue::ZERO);
            } else if self.pass.graph.node(id).operands().any(|x| self.rates[&x].is_some()) {
                let mut sum = Residue::ZERO;
                for (operand, slope) in self.slopes(id)? {
                    sum = sum + slope.value * self.rate(operand);
                }
                rate = Some(sum);
            }
            self.rates.insert(id, rate);
        }
        Ok(roots.iter().map(|root| self.dual(*root)).collect())
    }

    /// ∂root/∂symbol, with their rates, for each of the symbols.
    ///
    /// # Errors
    /// As [`FieldPass::evaluate`].
    pub(crate) fn gradient(&mut self, root: ExprId, symbols: &[SymbolId]) -> Result<Vec<Dual>, NoValue> {
        self.duals(&[root])?;
        let graph = self.pass.graph;
        let order = graph.reachable(&[root]);
        // what none of the symbols moves needs no slope, and may have none: the arc of the cosine at -1
        let mut moved: FxHashSet<ExprId> = FxHashSet::default();
        for id in &order {
            let moves = match graph.node(*id) {
                Node::Symbol(symbol) => symbols.contains(symbol),
                node => node.operands().any(|operand| moved.contains(&operand)),
            };
            if moves {
                moved.insert(*id);
            }
        }
        let mut adjoints: FxHashMap<ExprId, Dual> = FxHashMap::default();
        let mut found: FxHashMap<SymbolId, Dual> = FxHashMap::default();
        adjoints.insert(root, Dual::constant(Residue::ONE));
        for id in order.into_iter().rev().filter(|id| moved.contains(id)) {
            let Some(adjoint) = adjoints.remove(&id).filter(|adjoint| *adjoint != Dual::ZERO) else {
                continue;
            };
            if let Node::Symbol(symbol) = self.pass.graph.node(id) {
                found.insert(*symbol, adjoint);
                continue;
            }
            for (operand, slope) in self.slopes(id)? {
                let slot = adjoints.entry(operand).or_insert(Dual::ZERO);
                *slot = *slot + adjoint * slope;
            }
        }
        Ok(symbols.iter().map(|symbol| found.get(symbol).copied().unwrap_or(Dual::ZERO)).collect())
    }

    fn dual(&self, id: ExprId) -> Dual {
        Dual { value: self.pass.known[&id], rate: self.rate(id) }
    }

    fn rate(&self, id: ExprId) -> Residue {
        self.rates[&id].unwrap_or(Residue::ZERO)
    }

    /// The partial derivatives of a node by its operands.
    fn slopes(&mut self, id: ExprId) -> Result<Vec<(ExprId, Dual)>, NoValue> {
        let graph = self.pass.graph;
        match graph.node(id) {
            Node::Number(_) | Node::Pi | Node::Constant(_) | Node::Symbol(_) => Ok(Vec::new()),
            Node::Sum { terms, .. } => terms
                .iter()
                .map(|(term, coefficient)| Ok((*term, Dual::constant(residue(coefficient)?))))
                .collect(),
            Node::Product { coefficient, factors } => self.slopes_of_product(coefficient, factors),
            Node::Apply(function, x) => Ok(vec![(*x, self.slope_of_function(*function, id, *x)?)]),
            Node::Apply2(function, x, y) => {
                let [by_x, by_y] = self.slopes_of_pair(*function, *x, *y)?;
                Ok(vec![(*x, by_x), (*y, by_y)])
            }
        }
    }

    /// `∂(c Π b^e)/∂b = c e b^(e−1) Π' b'^e'`.
    fn slopes_of_product(
        &self,
        coefficient: &Rational,
        factors: &[(ExprId, Rational)],
    ) -> Result<Vec<(ExprId, Dual)>, NoValue> {
        let coefficient = Dual::constant(residue(coefficient)?);
        let powers = factors.iter().map(|(base, exponent)| self.power(*base, exponent));
        let powers = powers.collect::<Result<Vec<Dual>, NoValue>>()?;
        let mut slopes = Vec::with_capacity(factors.len());
        for (position, (base, exponent)) in factors.iter().enumerate() {
            let mut slope = coefficient;
            if !exponent.is_one() {
                let lowered = self.power(*base, &(exponent.clone() - Rational::ONE))?;
                slope = slope * Dual::constant(residue(exponent)?) * lowered;
            }
            for (_, power) in powers.iter().enumerate().filter(|(other, _)| *other != position) {
                slope = slope * *power;
            }
            slopes.push((*base, slope));
        }
        Ok(slopes)
    }

    fn power(&self, base: ExprId, exponent: &Rational) -> Result<Dual, NoValue> {
        if exponent.is_one() {
            return Ok(self.dual(base));
        }
        let value = self.pass.power(base, exponent)?;
        let Some(along) = self.rates[&base].filter(|_| !exponent.is_zero()) else {
            return Ok(Dual::constant(value));
        };
        let lowered = self.pass.power(base, &(exponent.clone() - Rational::ONE))?;
        Ok(Dual { value, rate: residue(exponent)? * lowered * along })
    }

    /// f'(x), and f''(x) ẋ.
    fn slope_of_function(&mut self, function: Function, id: ExprId, x: ExprId) -> Result<Dual, NoValue> {
        let argument = self.dual(x);
        let value = self.pass.known[&id];
        let one = Dual::constant(Residue::ONE);
        let negative = |dual: Dual| Dual::ZERO - dual;
        // a function of x that is evaluated as part of no expression
        let beside = |value: Residue, slope: Residue| Dual { value, rate: slope * argument.rate };
        Ok(match function {
            Function::Sin => {
                let (cos, sin) = self.pass.circle(x)?;
                beside(cos, -sin)
            }
            Function::Cos => {
                let (cos, sin) = self.pass.circle(x)?;
                negative(beside(sin, cos))
            }
            Function::Sinh | Function::Cosh => {
                let up = self.pass.exponential(x)?;
                let down = up.inverse().ok_or(NoValue::Here)?;
                let half = Residue::of_word(2).inverse().ok_or(NoValue::Here)?;
                let (cosh, sinh) = ((up + down) * half, (up - down) * half);
                if function == Function::Sinh { beside(cosh, sinh) } else { beside(sinh, cosh) }
            }
            Function::Tanh => {
                let slope = Residue::ONE - value * value;
                beside(slope, -(value + value) * slope)
            }
            Function::Exp => beside(value, value),
            Function::Ln => inverse(argument)?,
            Function::Asin | Function::Acos => {
                let rest = one - argument * argument;
                let root = rest.value.sqrt().ok_or(NoValue::Here)?;
                let slope = root.inverse().ok_or(NoValue::Here)?;
                let cube = slope * slope * slope;
                let slope = beside(slope, argument.value * cube);
                if function == Function::Asin { slope } else { negative(slope) }
            }
            Function::Atan => inverse(one + argument * argument)?,
            Function::Abs => Dual::constant(self.pass.sign(argument.value)),
            Function::Sign => Dual::ZERO,
        })
    }

    fn slopes_of_pair(&self, function: Function2, x: ExprId, y: ExprId) -> Result<[Dual; 2], NoValue> {
        let (x, y) = (self.dual(x), self.dual(y));
        let half = Residue::of_word(2).inverse().ok_or(NoValue::Here)?;
        Ok(match function {
            // atan2(x, y): the first argument is the opposite side
            Function2::Atan2 => {
                let scale = inverse(x * x + y * y)?;
                [y * scale, (Dual::ZERO - x) * scale]
            }
            Function2::Min | Function2::Max => {
                let side = self.pass.sign(x.value - y.value);
                let side = if function == Function2::Max { side } else { -side };
                [(Residue::ONE + side) * half, (Residue::ONE - side) * half].map(Dual::constant)
            }
        })
    }
}

fn residue(number: &Rational) -> Result<Residue, NoValue> {
    Residue::of(number).ok_or(NoValue::Here)
}

fn inverse(x: Dual) -> Result<Dual, NoValue> {
    let value = x.value.inverse().ok_or(NoValue::Here)?;
    Ok(Dual { value, rate: -(value * value * x.rate) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::{FieldPoint, Graph};

    /// Every function, in one expression.
    fn all_functions(g: &mut Graph, x: ExprId, y: ExprId) -> Vec<ExprId> {
        let functions = [
            Function::Sin,
            Function::Cos,
            Function::Asin,
            Function::Acos,
            Function::Atan,
            Function::Sinh,
            Function::Cosh,
            Function::Tanh,
            Function::Exp,
            Function::Ln,
            Function::Abs,
        ];
        let xy = g.mul(x, y);
        let argument = g.add(x, xy);
        let mut list: Vec<ExprId> = functions.into_iter().map(|f| g.apply(f, argument)).collect();
        for function in [Function2::Atan2, Function2::Min, Function2::Max] {
            list.push(g.apply2(function, argument, y));
        }
        for exponent in [(1, 2), (-3, 2), (1, 3), (5, 4), (-2, 1), (3, 1)] {
            let power = g.pow(argument, Rational::new(exponent.0, exponent.1));
            list.push(g.mul(power, y));
        }
        list.push(g.div(x, argument));
        list
    }

    #[test]
    fn first_and_second_derivatives_agree_with_those_of_expressions() {
        let mut g = Graph::new();
        let (x, y) = (g.new_symbol("x"), g.new_symbol("y"));
        let (ex, ey) = (g.symbol(x), g.symbol(y));
        for expression in all_functions(&mut g, ex, ey) {
            // d/dt of the gradient along (ẋ, ẏ)
            let gradient = [g.partial(expression, x), g.partial(expression, y)];
            let second = gradient.map(|slope| [g.partial(slope, x), g.partial(slope, y)]);
            let roots = [&[expression], gradient.as_slice(), second.as_flattened()].concat();
            let division = g.angle_division(&roots);
            let mut compared = 0;
            for seed in 0..64 {
                let mut pass = FieldPass::new(&g, FieldPoint::random(seed), division);
                let Ok(values) = pass.evaluate(&roots) else { continue };
                let (v, w) = (Residue::of_word(71 + seed), Residue::of_word(1_000_003));
                let direction = [(x, v), (y, w)].into_iter().collect();
                let mut tangents = TangentPass::new(&mut pass, direction);
                let Ok(found) = tangents.gradient(expression, &[x, y]) else { continue };
                assert_eq!(found.iter().map(|dual| dual.value).collect::<Vec<_>>(), values[1..3]);
                let expected = [values[3] * v + values[4] * w, values[5] * v + values[6] * w];
                let text = g.text(expression);
                assert_eq!(found.iter().map(|dual| dual.rate).collect::<Vec<_>>(), expected, "{text}");
                let rate = tangents.duals(&[expression]).expect("it has a gradient")[0].rate;
                assert_eq!(rate, values[1] * v + values[2] * w);
                compared += 1;
            }
            assert!(compared > 10, "{}: {compared} points", g.text(expression));
        }
    }

    #[test]
    fn a_root_has_no_slope_where_it_is_zero_unless_nothing_in_it_moves() {
        let mut g = Graph::new();
        let (x, y) = (g.new_symbol("x"), g.new_symbol("y"));
        let (ex, ey) = (g.symbol(x), g.symbol(y));
        let (square, shifted) = (g.mul(ex, ex), g.mul(ex, ey));
        let half = Rational::new(1, 2);
        // |x|, whose radicand has a slope of 0 at x = 0, and √(xy)
        for (radicand, moves_y) in [(square, false), (shifted, true)] {
            let root = g.pow(radicand, half.clone());
            for along in [x, y] {
                let mut point = FieldPoint::random(3);
                point.chosen.insert(x, Residue::ZERO);
                let mut pass = FieldPass::new(&g, point, g.angle_division(&[root]));
                let direction = [(along, Residue::ONE)].into_iter().collect();
                let dual = TangentPass::new(&mut pass, direction).duals(&[root]);
                assert_eq!(dual.is_ok(), along == y && !moves_y);
            }
        }
    }

    #[test]
    fn what_no_symbol_moves_needs_no_slope() {
        let mut g = Graph::new();
        let x = g.new_symbol("x");
        let (ex, ending) = (g.symbol(x), g.number(-1));
        // the graph of the arc of the cosine ends at -1, upright
        let arc = g.apply(Function::Acos, ending);
        let root = g.mul(arc, ex);
        let mut pass = FieldPass::new(&g, FieldPoint::random(3), g.angle_division(&[root]));
        let value = pass.evaluate(&[arc]).expect("it has a value")[0];
        let slopes = TangentPass::new(&mut pass, Direction::default()).gradient(root, &[x]);
        assert_eq!(slopes, Ok(vec![Dual::constant(value)]));
    }
}

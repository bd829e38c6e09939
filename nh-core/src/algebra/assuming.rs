//! Identities that hold under facts about the symbols:
//!
//! | identity | condition |
//! |---|---|
//! | `(x^2 y)^(1/2) = x y^(1/2)` and its kin | `x ≥ 0` |
//! | `(x^2 y)^(1/2) = −x y^(1/2)` and its kin of even powers | `x ≤ 0` |
//! | `(a^2 + 2 a b + b^2)^(1/2) = ±(a + b)` | the sign of `a + b`, of symbols of which something is known |
//! | `abs(x) = x`, `abs(x) = −x` | `x ≥ 0`, `x ≤ 0` |
//! | `sign(x) = 1`, `sign(x) = −1` | `x > 0`, `x < 0` |
//! | `abs(x y) = x abs(y)`, `sign(x y) = sign(y)` and their kin | the sign of `x` |
//! | `min(x y, x z) = x min(y, z)`, and `max` | `x > 0` |
//! | `min(x, y)`, `max(x, y)` are one of the two | the sign of `x − y` |
//! | `sin(x) = sin(y)` and its kin | `x = y`, of fewer operations |
//! | `a x + b x = 0` for numbers, roots, arcs and logarithms a and b | `a + b = 0` by their values, though by no identity |

use super::graph::Graph;
use super::node::{Function, Function2, Node};
use super::number::Rational;
use super::range::Facts;
use crate::id::{ExprId, SymbolId};
use crate::id_map::IdMap;
use rustc_hash::FxHashSet;

/// Parts with their coefficients, and what all of them are multiplied by.
type Group = (ExprId, Vec<(Rational, ExprId)>);

impl Graph {
    /// The expressions with these identities applied throughout.
    pub fn assuming(&mut self, roots: &[ExprId], facts: &Facts) -> Vec<ExprId> {
        self.assuming_and_noting(roots, facts, &mut Vec::new())
    }

    /// The same; the arguments that became shorter are noted, as they were.
    pub(crate) fn assuming_and_noting(
        &mut self,
        roots: &[ExprId],
        facts: &Facts,
        long: &mut Vec<ExprId>,
    ) -> Vec<ExprId> {
        let mut known: IdMap<ExprId, ExprId> = IdMap::default();
        let order = self.reachable(roots);
        let may_vanish =
            self.have_irrational_numbers(&order) || order.iter().any(|id| self.is_node_beyond_field(*id));
        for id in order {
            let mut image = self.assuming_node(id, &known, facts, long);
            if may_vanish && matches!(self.node(image), Node::Sum { .. }) {
                image = self.without_vanishing_terms(image);
            }
            known.insert(id, image);
        }
        roots.iter().map(|root| known[root]).collect()
    }

    fn assuming_node(
        &mut self,
        id: ExprId,
        known: &IdMap<ExprId, ExprId>,
        facts: &Facts,
        long: &mut Vec<ExprId>,
    ) -> ExprId {
        match self.node(id).clone() {
            Node::Number(_) | Node::Pi | Node::Constant(_) | Node::Symbol(_) => id,
            Node::Sum { constant, terms } => {
                let one = self.one();
                let mut summands: Vec<_> = terms.iter().map(|(term, c)| (c.clone(), known[term])).collect();
                summands.push((constant, one));
                self.linear_combination(&summands)
            }
            Node::Product { coefficient, factors } => {
                let mut powers = Vec::with_capacity(factors.len());
                for (base, exponent) in factors.iter() {
                    self.open_root(known[base], exponent, facts, &mut powers);
                }
                let product = self.product(&powers);
                self.scale(coefficient, product)
            }
            Node::Apply(function, x) => self.assuming_function(function, known[&x], facts, long),
            Node::Apply2(function, x, y) => self.assuming_pair(function, known[&x], known[&y], facts),
        }
    }

    /// Whether there are numbers among nodes, operands before what is made of them, that are no rational numbers.
    fn have_irrational_numbers(&self, order: &[ExprId]) -> bool {
        let mut numbers: FxHashSet<ExprId> = FxHashSet::default();
        for id in order {
            match self.node(*id) {
                Node::Number(_) => _ = numbers.insert(*id),
                Node::Constant(_) | Node::Symbol(_) => {}
                // π, or what is made of numbers
                node => {
                    if node.operands().all(|operand| numbers.contains(&operand)) {
                        return true;
                    }
                }
            }
        }
        false
    }

    /// A sum without the terms whose coefficients add up to 0 although no identity of sums says so, as the numbers
    /// `cos(π/5) − (1 + √5)/4` and the functions `atan2(x, 1) − atan(x)` do.
    fn without_vanishing_terms(&mut self, sum: ExprId) -> ExprId {
        // 1. each term as what has values of its own on the reals times the rest
        let (constant, terms) = self.as_linear(sum);
        let one = self.one();
        let mut groups: Vec<Group> = vec![(one, vec![(constant, one)])];
        for (term, coefficient) in terms {
            let (own, rest) = self.valued_in(term);
            match groups.iter_mut().find(|(key, _)| *key == rest) {
                Some((_, parts)) => parts.push((coefficient, own)),
                None => groups.push((rest, vec![(coefficient, own)])),
            }
        }
        // 2. whether these add up to 0
        let mut left = Vec::with_capacity(groups.len());
        let mut is_shorter = false;
        for (rest, parts) in groups {
            let is_sum = parts.len() > 1;
            let whole = self.linear_combination(&parts);
            if is_sum && self.vanishes_by_value(whole) {
                is_shorter = true;
            } else {
                left.extend(parts.into_iter().map(|(coefficient, own)| (coefficient, self.mul(own, rest))));
            }
        }
        if is_shorter { self.linear_combination(&left) } else { sum }
    }

    /// Whether a sum is zero, but not as it stands; what a point of floating point tells from zero is not asked further.
    fn vanishes_by_value(&self, sum: ExprId) -> bool {
        self.value_of(sum).is_none() && self.witness(sum).is_none() && self.zero_test(sum).is_zero()
    }

    /// A term as what is a number, or has values on the reals that no identity of the field tells, times the rest.
    fn valued_in(&mut self, term: ExprId) -> (ExprId, ExprId) {
        let one = self.one();
        let has_own = |graph: &Self, part: ExprId| {
            graph.symbols_in(&[part]).is_empty() || graph.is_beyond_field(&[part])
        };
        if self.symbols_in(&[term]).is_empty() {
            return (term, one);
        }
        let Node::Product { coefficient, factors } = self.node(term).clone() else {
            return if has_own(self, term) { (term, one) } else { (one, term) };
        };
        let (own, rest): (Vec<_>, Vec<_>) = factors
            .iter()
            .cloned()
            .partition(|(base, exponent)| !exponent.is_integer() || has_own(self, *base));
        if own.is_empty() {
            return (one, term);
        }
        let own = self.product(&own);
        let rest = self.product(&rest);
        (self.scale(coefficient, own), rest)
    }

    /// Takes factors that are not negative out of a root.
    fn open_root(
        &mut self,
        base: ExprId,
        exponent: &Rational,
        facts: &Facts,
        powers: &mut Vec<(ExprId, Rational)>,
    ) {
        if exponent.is_integer() {
            return powers.push((base, exponent.clone()));
        }
        let Node::Product { coefficient, factors } = self.node(base).clone() else {
            if let Some((number, root)) = self.known_square(base, facts) {
                powers.extend([(number, exponent.clone()), (root, exponent.clone() * Rational::from(2))]);
            } else {
                powers.push((base, exponent.clone()));
            }
            return;
        };
        let mut rest = Vec::new();
        for (inner, power) in factors.iter().cloned() {
            let range = self.range(inner, facts);
            if range.low >= 0.0 {
                powers.push((inner, power * exponent.clone()));
            } else if range.high <= 0.0 && power.is_integer() && !power.has_odd_numerator() {
                powers.push((self.neg(inner), power * exponent.clone()));
            } else {
                rest.push((inner, power));
            }
        }
        let rest = self.product(&rest);
        let rest = self.scale(coefficient, rest);
        powers.push((rest, exponent.clone()));
    }

    /// A sum of symbols of which something is known, as a positive number times the square of what is not negative.
    fn known_square(&mut self, sum: ExprId, facts: &Facts) -> Option<(ExprId, ExprId)> {
        if !matches!(self.node(sum), Node::Sum { .. }) {
            return None;
        }
        let expressions: Vec<ExprId> = facts.expressions.keys().copied().collect();
        let mentioned = self.symbols_in(&expressions);
        let is_known = |symbol: &SymbolId| facts.symbols.contains_key(symbol) || mentioned.contains(symbol);
        if !self.symbols_in(&[sum]).iter().all(is_known) {
            return None;
        }
        let factor = self.square_factor(sum, &[])?;
        let square = self.square(factor);
        let ratio = self.formula(sum / square);
        let ratio = self.simplify(ratio);
        if self.value_of(ratio)?.is_negative() {
            return None;
        }
        let opposite = self.neg(factor);
        let signed = [factor, opposite].into_iter().find(|signed| self.range(*signed, facts).low >= 0.0);
        signed.map(|root| (ratio, root))
    }

    fn assuming_function(
        &mut self,
        function: Function,
        x: ExprId,
        facts: &Facts,
        long: &mut Vec<ExprId>,
    ) -> ExprId {
        match function {
            Function::Abs | Function::Sign => {
                self.assuming_sign(function, x, facts).unwrap_or_else(|| self.by_factors(function, x, facts))
            }
            _ => {
                let short = self.short_argument(x);
                if short != x {
                    long.push(x);
                }
                self.apply(function, short)
            }
        }
    }

    /// The absolute value or the sign of a product, as far as the signs of factors are known: `abs(a x) = a abs(x)`.
    fn by_factors(&mut self, function: Function, x: ExprId, facts: &Facts) -> ExprId {
        let Node::Product { coefficient, factors } = self.node(x).clone() else {
            return self.apply(function, x);
        };
        let (mut known, mut rest) = (Vec::new(), Vec::new());
        for (base, exponent) in factors.iter().cloned() {
            let power = self.pow(base, exponent);
            let image = self.assuming_sign(function, power, facts);
            image.map_or_else(
                || rest.push((power, Rational::ONE)),
                |image| known.push((image, Rational::ONE)),
            );
        }
        if known.is_empty() {
            return self.apply(function, x);
        }
        let rest = self.product(&rest);
        let rest = self.scale(coefficient, rest);
        known.push((self.apply(function, rest), Rational::ONE));
        self.product(&known)
    }

    /// The absolute value or the sign of what has a known sign.
    fn assuming_sign(&mut self, function: Function, x: ExprId, facts: &Facts) -> Option<ExprId> {
        let range = self.range(x, facts);
        match function {
            Function::Abs if range.low >= 0.0 => Some(x),
            Function::Abs if range.high <= 0.0 => Some(self.neg(x)),
            Function::Sign if range.is_positive() => Some(self.one()),
            Function::Sign if range.high <= 0.0 && range.nonzero => Some(self.number(-1)),
            _ => None,
        }
    }

    fn assuming_pair(&mut self, function: Function2, x: ExprId, y: ExprId, facts: &Facts) -> ExprId {
        let difference = self.sub(x, y);
        let range = self.range(difference, facts);
        match function {
            Function2::Min if range.low >= 0.0 => y,
            Function2::Min if range.high <= 0.0 => x,
            Function2::Max if range.low >= 0.0 => x,
            Function2::Max if range.high <= 0.0 => y,
            Function2::Min | Function2::Max => self.without_common_factors(function, x, y, facts),
            Function2::Atan2 => self.apply2(function, x, y),
        }
    }

    /// `max(a x, a y) = a max(x, y)` for what is not negative.
    fn without_common_factors(&mut self, function: Function2, x: ExprId, y: ExprId, facts: &Facts) -> ExprId {
        let of_y = self.factors(y);
        let mut common = self.factors(x);
        common.retain(|(base, exponent)| {
            let range = self.range(*base, facts);
            of_y.contains(&(*base, exponent.clone())) && range.low >= 0.0 && range.nonzero
        });
        if common.is_empty() {
            return self.apply2(function, x, y);
        }
        let common = self.product(&common);
        let (x, y) = (self.div(x, common), self.div(y, common));
        let pair = self.apply2(function, x, y);
        self.mul(common, pair)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::Range;

    #[test]
    fn numbers_that_add_up_to_zero_leave_nothing() {
        let mut g = Graph::new();
        let (x, y) = (g.new_symbol("x"), g.new_symbol("y"));
        let (x, y, pi, five) = (g.symbol(x), g.symbol(y), g.pi(), g.number(5));
        let fifth = g.scale(Rational::new(1, 5), pi);
        let (cos, root, one) = (g.cos(fifth), g.sqrt(five), g.one());
        let golden = g.formula((one + root) * x);
        let quarter = g.scale(Rational::new(-1, 4), golden);
        let (sum, more) = (g.formula(cos * x + quarter), g.formula(cos * x + quarter + y));
        assert!(!g.is_literal_zero(sum));
        let [short, rest] = g.assuming(&[sum, more], &Facts::default())[..] else { panic!("two") };
        assert!(g.is_literal_zero(short) && rest == y, "{}", g.text(rest));
    }

    #[test]
    fn functions_that_cancel_by_their_values_leave_nothing() {
        let mut g = Graph::new();
        let (x, y) = (g.new_symbol("x"), g.new_symbol("y"));
        let (x, y, one) = (g.symbol(x), g.symbol(y), g.one());
        let (arc, angle) = (g.apply(Function::Atan, x), g.apply2(Function2::Atan2, x, one));
        let sum = g.formula(angle * y - arc * y + y * y);
        let other = g.formula(angle * y - arc * x);
        let square = g.square(y);
        assert_eq!(g.assuming(&[sum, other], &Facts::default()), [square, other]);
    }

    #[test]
    fn roots_and_signs_under_facts() {
        let mut g = Graph::new();
        let (m, x) = (g.new_symbol("m"), g.new_symbol("x"));
        let (em, ex) = (g.symbol(m), g.symbol(x));
        let facts = Facts { symbols: [(m, Range::POSITIVE)].into_iter().collect(), ..Facts::default() };
        let (mm, xx) = (g.square(em), g.square(ex));
        let product = g.mul(mm, xx);
        let root = g.sqrt(product);
        let absolute = g.apply(Function::Abs, em);
        let sign = g.apply(Function::Sign, em);
        let opened = g.assuming(&[root, absolute, sign], &facts);
        assert_eq!(g.text(opened[0]), "m*sqrt(x^2)");
        assert_eq!(opened[1], em);
        assert_eq!(g.text(opened[2]), "1");
        assert_eq!(g.assuming(&[root], &Facts::default()), [root]);
    }

    #[test]
    fn roots_of_what_is_negative() {
        let mut g = Graph::new();
        let symbols = ["l", "k", "n", "x"].map(|name| g.new_symbol(name));
        let [l, k, n, x] = symbols.map(|symbol| g.symbol(symbol));
        let negative = Range { low: f64::NEG_INFINITY, high: 0.0, ..Range::POSITIVE };
        let known = [(symbols[0], Range::POSITIVE), (symbols[1], Range::POSITIVE), (symbols[2], negative)];
        let facts = Facts { symbols: known.into_iter().collect(), ..Facts::default() };
        let (square, cube) = (g.formula(n * n * x), g.formula(n * n * n * x));
        let sum = g.formula(l * l + k * k);
        let twice = g.formula(l * k + l * k);
        let whole = g.add(sum, twice);
        let with_x = g.formula(x * x + k * k);
        let roots = [square, cube, whole, with_x].map(|radicand| g.sqrt(radicand));
        let opened = g.assuming(&roots, &facts);
        assert_eq!(g.text(opened[0]), "-n*sqrt(x)");
        assert_eq!(opened[1], roots[1]);
        let expected = g.add(l, k);
        assert_eq!(opened[2], expected, "{}", g.text(opened[2]));
        assert_eq!(opened[3], roots[3]);
    }
}

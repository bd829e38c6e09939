//! Products and powers. Automatic identities:
//!
//! | identity | condition |
//! |---|---|
//! | `x^a · x^b = x^(a+b)`, `x^0 = 1` | where the left side is defined; this only removes divisions and roots |
//! | `(x^a)^b = x^(ab)` | `b` an integer, or the numerator of `a` odd |
//! | `(x^a y^c)^b = x^(ab) y^(cb)` | `a`, `c`, `ab` and `cb` are even, so that no sign is lost |
//! | `(c·x·y)^b = c^b x^b y^b` | `b` an integer; otherwise only `c > 0` is taken out, as far as its root is rational |
//! | `c · (a + b) = ca + cb` | `c` a number |
//! | `(2a + 2b)^n · x = 2^n (a + b)^n x` | sums among factors are primitive, their first coefficient positive; `n` an integer, or `2` a positive number as far as its root is rational |

use super::graph::Graph;
use super::node::Node;
use super::number::Rational;
use super::sum::collect_like;
use crate::id::ExprId;
use crate::limits;
use std::rc::Rc;

/// Factors collected while a product is built.
struct Factors {
    coefficient: Rational,
    powers: Vec<(ExprId, Rational)>,
}

impl Graph {
    /// `a · b`.
    pub fn mul(&mut self, a: ExprId, b: ExprId) -> ExprId {
        for (a, b) in [(a, b), (b, a)] {
            if let Some(number) = self.as_number(a) {
                let number = number.clone();
                return self.scale(number, b);
            }
        }
        self.product(&[(a, Rational::ONE), (b, Rational::ONE)])
    }

    /// `a / b`. Division by the number 0 is kept as `0^−1`, which the checks refuse.
    pub fn div(&mut self, a: ExprId, b: ExprId) -> ExprId {
        self.product(&[(a, Rational::ONE), (b, Rational::MINUS_ONE)])
    }

    /// `base^exponent`.
    pub fn pow(&mut self, base: ExprId, exponent: Rational) -> ExprId {
        self.product(&[(base, exponent)])
    }

    /// `base²`.
    pub fn square(&mut self, base: ExprId) -> ExprId {
        self.pow(base, Rational::from(2))
    }

    /// `√x`.
    pub fn sqrt(&mut self, x: ExprId) -> ExprId {
        self.pow(x, Rational::new(1, 2))
    }

    /// `coefficient · x`, distributed over a sum.
    pub fn scale(&mut self, coefficient: Rational, x: ExprId) -> ExprId {
        if coefficient.is_one() {
            return x;
        }
        if coefficient.is_zero() {
            return self.zero();
        }
        match self.node(x) {
            Node::Number(value) => {
                let product = coefficient * value.clone();
                self.number(product)
            }
            Node::Sum { constant, terms } => {
                let (constant, terms) = (constant.clone() * coefficient.clone(), terms.clone());
                let mut scaled = self.take_spare();
                scaled.extend(terms.iter().map(|(id, c)| (*id, c.clone() * coefficient.clone())));
                let sum = self.intern_sum(constant, scaled.as_slice());
                self.give_back(scaled);
                sum
            }
            Node::Product { coefficient: inner, factors } => {
                let (coefficient, factors) = (coefficient * inner.clone(), factors.clone());
                self.finish_product(coefficient, factors)
            }
            _ => self.intern_product(coefficient, [(x, Rational::ONE)]),
        }
    }

    /// A product as its number and the rest; anything else with the number 1.
    pub fn split_coefficient(&mut self, id: ExprId) -> (Rational, ExprId) {
        match self.node(id) {
            Node::Product { coefficient, factors } if !coefficient.is_one() => {
                let (coefficient, factors) = (coefficient.clone(), factors.clone());
                (coefficient, self.finish_product(Rational::ONE, factors))
            }
            _ => (Rational::ONE, id),
        }
    }

    /// `Π base^exponent`.
    pub fn product(&mut self, factors: &[(ExprId, Rational)]) -> ExprId {
        self.product_of(factors.iter().cloned())
    }

    pub(super) fn product_of(&mut self, factors: impl Iterator<Item = (ExprId, Rational)>) -> ExprId {
        let mut collected = Factors { coefficient: Rational::ONE, powers: self.take_spare() };
        for (base, exponent) in factors {
            self.collect_factor(base, &exponent, &mut collected);
        }
        self.merge(&mut collected);
        let product = self.finish_product(collected.coefficient, collected.powers.as_slice());
        self.give_back(collected.powers);
        product
    }

    /// Takes `base^exponent` apart as far as the identities allow.
    fn collect_factor(&mut self, base: ExprId, exponent: &Rational, into: &mut Factors) {
        if exponent.is_zero() {
            return;
        }
        match self.node(base) {
            Node::Number(value) => {
                let value = value.clone();
                self.collect_number(&value, exponent, into);
            }
            Node::Product { coefficient, factors } if exponent.is_one() => {
                into.coefficient = into.coefficient.clone() * coefficient.clone();
                into.powers.extend_from_slice(factors);
            }
            Node::Product { coefficient, factors } if exponent.is_integer() => {
                let (coefficient, factors) = (coefficient.clone(), factors.clone());
                self.collect_number(&coefficient, exponent, into);
                self.collect_powers(&factors, exponent, into);
            }
            Node::Product { coefficient, factors } => {
                let (coefficient, factors) = (coefficient.clone(), factors.clone());
                self.collect_root_of_product(&coefficient, &factors, exponent, into);
            }
            Node::Sum { .. } => self.collect_sum(base, exponent, into),
            _ => into.powers.push((base, exponent.clone())),
        }
    }

    /// `Π (x^a)^exponent` as the product of `x^(a exponent)`.
    fn collect_powers(&mut self, factors: &[(ExprId, Rational)], exponent: &Rational, into: &mut Factors) {
        for (inner, power) in factors {
            // an integer power of a root can uncover a number or a product again
            let power = power.clone() * exponent.clone();
            if power.is_integer() && !matches!(self.node(*inner), Node::Symbol(_)) {
                self.collect_factor(*inner, &power, into);
            } else {
                into.powers.push((*inner, power));
            }
        }
    }

    fn collect_number(&mut self, value: &Rational, exponent: &Rational, into: &mut Factors) {
        if value.is_one() {
            return;
        }
        let (outside, inside) = split_power(value, exponent);
        into.coefficient = into.coefficient.clone() * outside;
        if !inside.is_one() {
            let base = self.number(inside);
            into.powers.push((base, exponent.clone()));
        }
    }

    /// A fractional power of a product with a coefficient or several factors.
    fn collect_root_of_product(
        &mut self,
        coefficient: &Rational,
        factors: &[(ExprId, Rational)],
        exponent: &Rational,
        into: &mut Factors,
    ) {
        let keeps_signs = |power: &Rational| power.is_even() && (power.clone() * exponent.clone()).is_even();
        if !coefficient.is_negative() && factors.iter().all(|(_, power)| keeps_signs(power)) {
            self.collect_number(coefficient, exponent, into);
            self.collect_powers(factors, exponent, into);
            return;
        }
        let (outside, inside) = split_power(coefficient, exponent);
        into.coefficient = into.coefficient.clone() * outside;
        match factors {
            [(inner, power)] if inside.is_one() && power.has_odd_numerator() => {
                into.powers.push((*inner, power.clone() * exponent.clone()));
            }
            _ => {
                let base = self.finish_product(inside, factors);
                into.powers.push((base, exponent.clone()));
            }
        }
    }

    /// Takes the content out of a sum, so that equal sums up to a number become one base.
    fn collect_sum(&mut self, base: ExprId, exponent: &Rational, into: &mut Factors) {
        let content = self.content(base);
        if content.is_one() {
            into.powers.push((base, exponent.clone()));
            return;
        }
        let outside = if exponent.is_integer() { content } else { square_divisor(&content.abs(), exponent) };
        match rational_power(&outside, exponent).zip(outside.recip()) {
            Some((power, inverse)) => {
                into.coefficient = into.coefficient.clone() * power;
                let primitive = self.scale(inverse, base);
                into.powers.push((primitive, exponent.clone()));
            }
            None => into.powers.push((base, exponent.clone())),
        }
    }

    /// The expression without its content, as far as that is positive: it has the same zeros.
    pub fn without_content(&mut self, id: ExprId) -> ExprId {
        match self.content(id).abs().recip() {
            Some(factor) => self.scale(factor, id),
            None => id,
        }
    }

    /// The greatest common divisor of a sum's coefficients with the sign of the first term's.
    #[must_use]
    pub fn content(&self, id: ExprId) -> Rational {
        let Node::Sum { constant, terms } = self.node(id) else { return Rational::ONE };
        let mut content = constant.abs();
        for (_, coefficient) in terms.iter() {
            if !(content.is_one() && coefficient.is_integer()) {
                content = content.gcd(coefficient);
            }
        }
        let first_negative = terms.first().is_some_and(|(_, coefficient)| coefficient.is_negative());
        if first_negative { -content } else { content }
    }

    /// Adds the exponents of equal bases.
    fn merge(&mut self, factors: &mut Factors) {
        loop {
            limits::spend(1 + factors.powers.len());
            collect_like(&mut factors.powers);
            let mut reopened: Vec<(ExprId, Rational)> = Vec::new();
            factors.powers.retain(|(base, exponent)| {
                // roots that have become integer powers are taken apart again
                let again = exponent.is_integer()
                    && !exponent.is_zero()
                    && match self.node(*base) {
                        Node::Product { .. } => true,
                        Node::Number(value) => rational_power(value, exponent).is_some(),
                        _ => false,
                    };
                if again {
                    reopened.push((*base, exponent.clone()));
                }
                !again && !exponent.is_zero()
            });
            if reopened.is_empty() {
                return;
            }
            for (base, exponent) in reopened {
                self.collect_factor(base, &exponent, factors);
            }
        }
    }

    /// Stores `coefficient · Π powers`, which are merged already.
    fn finish_product<L>(&mut self, coefficient: Rational, powers: L) -> ExprId
    where
        L: AsRef<[(ExprId, Rational)]> + Into<Rc<[(ExprId, Rational)]>>,
    {
        if coefficient.is_zero() {
            return self.zero();
        }
        match powers.as_ref() {
            [] => self.number(coefficient),
            [(base, exponent)] if exponent.is_one() => {
                let base = *base;
                match self.node(base) {
                    Node::Sum { .. } => self.scale(coefficient, base),
                    _ if coefficient.is_one() => base,
                    _ => self.intern_product(coefficient, powers),
                }
            }
            _ => self.intern_product(coefficient, powers),
        }
    }
}

/// `value^exponent` where that is rational.
fn rational_power(value: &Rational, exponent: &Rational) -> Option<Rational> {
    if value.is_one() {
        return Some(Rational::ONE);
    }
    match exponent.to_small()? {
        (n, 1) => value.pow(n),
        (n, 2) => value.sqrt()?.pow(n),
        _ => None,
    }
}

/// `value^exponent` as a rational number times what is left under the root.
fn split_power(value: &Rational, exponent: &Rational) -> (Rational, Rational) {
    if let Some(power) = rational_power(value, exponent) {
        return (power, Rational::ONE);
    }
    let square = square_divisor(value, exponent);
    match (rational_power(&square, exponent), square.recip()) {
        (Some(power), Some(inverse)) => (power, value.clone() * inverse),
        _ => (Rational::ONE, value.clone()),
    }
}

/// A square that can be taken out of a square root, the largest as far as small factors tell.
fn square_divisor(value: &Rational, exponent: &Rational) -> Rational {
    const TRIED: i64 = 1000;
    let part = |n: i64| {
        let (mut rest, mut square) = (n.saturating_abs(), 1);
        let mut divisor = 2;
        while divisor < TRIED && divisor * divisor <= rest {
            while rest % (divisor * divisor) == 0 {
                rest /= divisor * divisor;
                square *= divisor * divisor;
            }
            divisor += 1;
        }
        if rest.isqrt() * rest.isqrt() == rest { square * rest } else { square }
    };
    match (value.to_small(), exponent.to_small()) {
        (Some((n, d)), Some((_, 2))) if n != 0 => Rational::new(part(n), part(d)),
        _ => Rational::ONE,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn symbols(g: &mut Graph) -> (ExprId, ExprId) {
        let (x, y) = (g.new_symbol("x"), g.new_symbol("y"));
        (g.symbol(x), g.symbol(y))
    }

    #[test]
    fn powers_merge() {
        let mut g = Graph::new();
        let (x, y) = symbols(&mut g);
        let a = g.mul(x, y);
        let b = g.div(a, x);
        assert_eq!(b, y);
        let root = g.sqrt(a);
        assert_eq!(g.mul(root, root), a);
        let third = g.pow(x, Rational::new(1, 3));
        assert_eq!(g.pow(third, Rational::from(3)), x);
    }

    #[test]
    fn the_root_of_a_square_is_not_the_number() {
        let mut g = Graph::new();
        let (x, _) = symbols(&mut g);
        let squared = g.square(x);
        assert_ne!(g.sqrt(squared), x);
        let four = g.scale(Rational::from(4), squared);
        let (two, root) = (g.sqrt(four), g.sqrt(squared));
        assert_eq!(two, g.scale(Rational::from(2), root));
    }

    #[test]
    fn even_roots_of_even_powers_are_powers_where_they_are_even() {
        let mut g = Graph::new();
        let (x, y) = symbols(&mut g);
        let (apart, fourth) = (g.sub(x, y), Rational::from(4));
        let product = g.product(&[(x, fourth.clone()), (apart, fourth.clone())]);
        let twice = g.scale(Rational::from(2), product);
        let root = g.sqrt(twice);
        assert_eq!(g.text(root), "x^2*(x - y)^2*sqrt(2)");
        let sixth = g.pow(x, Rational::from(6));
        assert_eq!(g.pow(sixth, Rational::new(-1, 3)), g.pow(x, Rational::from(-2)));
        let negative = g.scale(Rational::MINUS_ONE, sixth);
        for (base, exponent) in [(sixth, (1, 2)), (product, (1, 4)), (negative, (1, 3))] {
            let root = g.pow(base, Rational::new(exponent.0, exponent.1));
            let text = g.text(root);
            assert!(text.contains("sqrt(") || text.contains("^(1/"), "{text}");
        }
    }

    #[test]
    fn sums_in_products_are_primitive() {
        let mut g = Graph::new();
        let (x, y) = symbols(&mut g);
        let (d, e) = (g.sub(x, y), g.sub(y, x));
        let ratio = g.div(d, e);
        assert_eq!(g.as_number(ratio), Some(&Rational::MINUS_ONE));
        let twice = g.scale(Rational::from(2), d);
        let a = g.mul(twice, x);
        let b = g.mul(d, x);
        assert_eq!(a, g.scale(Rational::from(2), b));
    }

    #[test]
    fn a_division_by_zero_is_kept_for_the_checks() {
        let mut g = Graph::new();
        let (x, _) = symbols(&mut g);
        let zero = g.zero();
        let poison = g.div(x, zero);
        assert!(matches!(g.node(poison), Node::Product { .. }));
    }

    #[test]
    fn number_radicals_combine() {
        let mut g = Graph::new();
        let two = g.number(2);
        let root = g.sqrt(two);
        assert_eq!(g.mul(root, root), two);
    }

    #[test]
    fn squares_leave_a_root() {
        let mut g = Graph::new();
        let (x, y) = symbols(&mut g);
        let twelve = g.number(12);
        let root = g.sqrt(twelve);
        assert_eq!(g.text(root), "2*sqrt(3)");
        let inverse = g.pow(twelve, Rational::new(-1, 2));
        let product = g.mul(root, inverse);
        assert_eq!(g.as_number(product), Some(&Rational::ONE));
        let sum = g.linear_combination(&[(Rational::from(75), x), (Rational::new(50, 3), y)]);
        let root = g.sqrt(sum);
        assert_eq!(g.text(root), "5*sqrt(3*x + 2*y/3)");
        let product = g.product(&[(x, Rational::ONE), (y, Rational::ONE)]);
        let scaled = g.scale(Rational::from(-8), product);
        let root = g.sqrt(scaled);
        assert_eq!(g.text(root), "2*sqrt(-2*x*y)");
    }
}

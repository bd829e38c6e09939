//! Whether the signs that products are demanded to have exclude each other.
//!
//! Products that are all positive have a positive product. Where that is a negative number times even powers, there are no
//! such values: of a b > 0, b c > 0 and −a c > 0 the product is −(a b c)². Which of them to multiply is a linear system over
//! the field of two elements, with a row for each product and a column for each factor that stands in an odd power.

use super::graph::Graph;
use super::inequalities::Demand;
use super::node::Node;
use super::range::Facts;
use crate::id::ExprId;
use std::collections::BTreeSet;

/// What decides the sign of a product: whether its coefficient is negative, and the factors in odd powers.
struct Parity {
    is_negative: bool,
    odd: BTreeSet<ExprId>,
}

impl Parity {
    /// Multiplied by another: what is odd in both is even then.
    fn times(&mut self, other: &Self) {
        self.is_negative ^= other.is_negative;
        self.odd = &self.odd ^ &other.odd;
    }
}

impl Graph {
    /// Whether a product of some demands is positive by all of them and has no positive value.
    pub(super) fn have_no_signs(&self, demands: &[(ExprId, Demand)]) -> bool {
        let mut independent: Vec<(ExprId, Parity)> = Vec::new();
        let positive = demands.iter().filter(|(_, demand)| *demand == Demand::Positive);
        for (id, _) in positive {
            let mut parity = self.parity(*id);
            for (pivot, known) in &independent {
                if parity.odd.contains(pivot) {
                    parity.times(known);
                }
            }
            match parity.odd.first() {
                Some(pivot) => independent.push((*pivot, parity)),
                None if parity.is_negative => return true,
                None => {}
            }
        }
        false
    }

    fn parity(&self, id: ExprId) -> Parity {
        if let Some(number) = self.value_of(id) {
            return Parity { is_negative: number.is_negative(), odd: BTreeSet::new() };
        }
        match self.node(id) {
            Node::Sum { constant, terms } if constant.is_zero() && terms.len() == 1 => {
                let (term, coefficient) = &terms[0];
                let mut parity = self.parity(*term);
                parity.is_negative ^= coefficient.is_negative();
                parity
            }
            Node::Product { coefficient, factors } => {
                // where a root is defined it is of what is not negative
                let odd = factors.iter().filter(|(_, e)| e.is_integer() && e.has_odd_numerator());
                let signed = odd.map(|(base, _)| *base).filter(|base| !self.is_positive_anywhere(*base));
                Parity { is_negative: coefficient.is_negative(), odd: signed.collect() }
            }
            _ if self.is_positive_anywhere(id) => Parity { is_negative: false, odd: BTreeSet::new() },
            _ => Parity { is_negative: false, odd: BTreeSet::from([id]) },
        }
    }

    fn is_positive_anywhere(&self, id: ExprId) -> bool {
        self.range(id, &Facts::default()).is_positive()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_product_of_all_has_a_sign() {
        // exponents of a, b, c, d after the sign
        for (is_contradictory, list) in [
            (true, vec![[1, 1, 1, 0, 0], [1, 0, 1, 1, 0], [-1, 1, 0, 1, 0]]),
            (false, vec![[1, 1, 1, 0, 0], [1, 0, 1, 1, 0], [1, 1, 0, 1, 0]]),
            (true, vec![[1, 1, 1, 0, 0], [1, 0, 1, 1, 0], [1, 0, 0, 1, 1], [-1, 1, 0, 0, 1]]),
            (true, vec![[1, 1, -1, 0, 0], [1, 0, 3, 1, 0], [-1, 1, 0, -1, 0]]),
            (true, vec![[-1, 2, 2, 0, 0]]),
            (false, vec![[-1, 2, 1, 0, 0], [1, 1, 0, 1, 0]]),
            (false, vec![[-1, 1, 1, 0, 0], [-1, 0, 1, 1, 0], [-1, 0, 0, 1, 1], [-1, 1, 0, 0, 1]]),
        ] {
            let mut g = Graph::new();
            let symbols = ["a", "b", "c", "d"].map(|name| {
                let symbol = g.new_symbol(name);
                g.symbol(symbol)
            });
            let demands: Vec<(ExprId, Demand)> = list
                .iter()
                .map(|[sign, exponents @ ..]: &[i64; 5]| {
                    let start = g.number(*sign);
                    let powers = symbols.iter().zip(exponents);
                    let product = powers.fold(start, |product, (symbol, exponent)| {
                        let power = g.pow(*symbol, (*exponent).into());
                        g.mul(product, power)
                    });
                    (product, Demand::Positive)
                })
                .collect();
            assert_eq!(g.contradiction(&demands).is_some(), is_contradictory, "{list:?}");
        }
    }

    #[test]
    fn roots_and_exponentials_have_one_sign() {
        use crate::algebra::Function;
        let mut g = Graph::new();
        let [a, b] = ["a", "b"].map(|name| {
            let symbol = g.new_symbol(name);
            g.symbol(symbol)
        });
        let (exp, root) = (g.apply(Function::Exp, b), g.sqrt(a));
        let minus_one = g.number(-1);
        let product = g.mul(exp, a);
        let negative = g.mul(minus_one, a);
        assert!(g.have_no_signs(&[(product, Demand::Positive), (negative, Demand::Positive)]));
        let product = g.mul(root, b);
        let negative = g.mul(minus_one, b);
        assert!(g.have_no_signs(&[(product, Demand::Positive), (negative, Demand::Positive)]));
        assert!(!g.have_no_signs(&[(product, Demand::Positive), (negative, Demand::NotNegative)]));
    }
}

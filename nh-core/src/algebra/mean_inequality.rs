//! Sums of positive products that are never below another product: the inequality of weighted arithmetic and geometric
//! means, Σ cᵢ mᵢ ≥ Π (cᵢ/λᵢ)^λᵢ · m, where cᵢ, mᵢ > 0 and m = Π mᵢ^λᵢ, Σ λᵢ = 1 (B. Reznick, *Forms derived from the
//! arithmetic-geometric inequality*, Math. Ann. 283, 1989).

use super::combination::negative;
use super::graph::Graph;
use super::inequalities::{Demand, Known};
use super::node::Node;
use super::number::Rational;
use super::polynomial_terms::{Monomial, Terms, product_of, sum_of};
use super::simplex::{Inequality, contradiction};
use crate::id::ExprId;
use num_integer::Integer;
use std::collections::BTreeSet;

/// The common denominator of weights up to which their powers are compared.
const DENOMINATOR: i64 = 24;

impl Graph {
    /// Whether a polynomial is not as demanded, since one product is all that is above zero in it, and the others have a
    /// mean that is as large.
    pub(super) fn is_below_its_mean(&self, polynomial: &Terms, demand: Demand, known: &Known) -> bool {
        let mut terms = Terms::new();
        for (monomial, coefficient) in polynomial {
            let Some(monomial) = self.positive_parts(monomial, known) else { return false };
            terms = sum_of(&terms, &Terms::from([(monomial, coefficient.clone())]));
        }
        match demand {
            Demand::Positive => is_below(&terms, false),
            Demand::NotNegative => is_below(&terms, true),
            Demand::Zero => is_below(&terms, true) || is_below(&negative(&terms), true),
            Demand::Nonzero => false,
        }
    }

    /// A product of what is known to be positive, with products among its parts multiplied out.
    fn positive_parts(&self, monomial: &Monomial, known: &Known) -> Option<Monomial> {
        let mut product = Monomial::new();
        for (part, exponent) in monomial {
            let inside = match self.node(*part) {
                Node::Product { coefficient, factors } if coefficient.is_one() => {
                    let powers = factors.iter().map(|(base, e)| (*base, e.clone() * exponent.clone()));
                    self.positive_parts(&powers.collect(), known)?
                }
                _ => {
                    let interval = known.get(part)?;
                    let is_positive = interval.is_not_negative() && interval.is_nonzero();
                    is_positive.then(|| vec![(*part, exponent.clone())])?
                }
            };
            product = product_of(&product, &inside);
        }
        Some(product)
    }
}

/// Whether products with coefficients add up to nothing above zero, or to what is below.
fn is_below(terms: &Terms, strictly: bool) -> bool {
    let (below, above): (Vec<_>, Vec<_>) = terms.iter().partition(|(_, c)| c.is_negative());
    let [(product, most)] = above.as_slice() else { return false };
    let Some(weights) = weights(&below, product) else { return false };
    let used = || below.iter().zip(&weights).filter(|(_, weight)| !weight.is_zero());
    let common = used().try_fold(1_i64, |common, (_, weight)| {
        let denominator = weight.to_small()?.1;
        // a large one has no multiple that is a number of the machine
        let common = (denominator <= DENOMINATOR).then(|| common.lcm(&denominator))?;
        (common <= DENOMINATOR).then_some(common)
    });
    let Some(common) = common else { return false };
    // (most / Π (cᵢ/λᵢ)^λᵢ)^common
    let ratio = most.pow(common).and_then(|start| {
        used().try_fold(start, |ratio, ((_, c), weight)| {
            let times = (weight.clone() * Rational::from(common)).to_i64()?;
            Some(ratio * (weight.clone() * c.abs().recip()?).pow(times)?)
        })
    });
    let Some(ratio) = ratio else { return false };
    let more = Rational::ONE - ratio;
    let others = below.len() > used().count();
    !more.is_negative() && (!strictly || others || !more.is_zero())
}

/// Weights λᵢ ≥ 0 that add up to one, with the product as the weighted geometric mean.
fn weights(of: &[(&Monomial, &Rational)], product: &Monomial) -> Option<Vec<Rational>> {
    let monomials = of.iter().map(|(monomial, _)| *monomial).chain([product]);
    let parts: BTreeSet<ExprId> = monomials.flatten().map(|(part, _)| *part).collect();
    let exponent = |monomial: &Monomial, part: ExprId| {
        let found = monomial.iter().find(|(known, _)| *known == part);
        found.map_or(Rational::ZERO, |(_, exponent)| exponent.clone())
    };
    let differences: Vec<Inequality> = of
        .iter()
        .map(|(monomial, _)| Inequality {
            coefficients: parts
                .iter()
                .map(|part| exponent(monomial, *part) - exponent(product, *part))
                .collect(),
            constant: Rational::ZERO,
            strict: true,
        })
        .collect();
    let weights = contradiction(&differences)?;
    let sum = weights.iter().fold(Rational::ZERO, |sum, weight| sum + weight.clone()).recip()?;
    Some(weights.into_iter().map(|weight| weight * sum.clone()).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_of_positive_numbers() {
        use Demand::{NotNegative, Positive, Zero};
        // coefficients, with the exponents of a, b, c in sixths
        for (is_contradictory, demand, terms) in [
            // a + b + c < 3 (a b c)^(1/3), and 4 in place of 3
            (true, Positive, vec![(3, [2, 2, 2]), (-1, [6, 0, 0]), (-1, [0, 6, 0]), (-1, [0, 0, 6])]),
            (false, Positive, vec![(4, [2, 2, 2]), (-1, [6, 0, 0]), (-1, [0, 6, 0]), (-1, [0, 0, 6])]),
            (false, NotNegative, vec![(3, [2, 2, 2]), (-1, [6, 0, 0]), (-1, [0, 6, 0]), (-1, [0, 0, 6])]),
            // a/b + b/a < 2, and with 4 a/b: 2 √4
            (true, Positive, vec![(2, [0, 0, 0]), (-1, [6, -6, 0]), (-1, [-6, 6, 0])]),
            (true, NotNegative, vec![(3, [0, 0, 0]), (-4, [6, -6, 0]), (-1, [-6, 6, 0])]),
            (true, Positive, vec![(4, [0, 0, 0]), (-4, [6, -6, 0]), (-1, [-6, 6, 0])]),
            (false, Positive, vec![(5, [0, 0, 0]), (-4, [6, -6, 0]), (-1, [-6, 6, 0])]),
            // a² + 2/a = 3, 5/2: the least value is 3
            (false, Zero, vec![(-3, [0, 0, 0]), (1, [12, 0, 0]), (2, [-6, 0, 0])]),
            (true, Zero, vec![(-5, [0, 0, 0]), (2, [12, 0, 0]), (4, [-6, 0, 0])]),
            // what has no mean that is the other
            (false, Positive, vec![(1, [0, 0, 0]), (-1, [6, 0, 0]), (-1, [0, 6, 0])]),
            (
                true,
                Zero,
                vec![(3, [2, 2, 2]), (-1, [6, 0, 0]), (-1, [0, 6, 0]), (-1, [0, 0, 6]), (-1, [6, 6, 0])],
            ),
        ] {
            let mut g = Graph::new();
            let symbols = ["a", "b", "c"].map(|name| {
                let symbol = g.new_symbol(name);
                g.symbol(symbol)
            });
            let mut demands: Vec<_> = symbols.iter().map(|symbol| (*symbol, Positive)).collect();
            let terms: Vec<(Rational, ExprId)> = terms
                .iter()
                .map(|(coefficient, sixths)| {
                    let one = g.one();
                    let product = symbols.iter().zip(sixths).fold(one, |product, (symbol, sixths)| {
                        let power = g.pow(*symbol, Rational::new(*sixths, 6));
                        g.mul(product, power)
                    });
                    (Rational::from(*coefficient), product)
                })
                .collect();
            demands.push((g.linear_combination(&terms), demand));
            assert_eq!(g.contradiction(&demands).is_some(), is_contradictory, "{demand:?} {terms:?}");
        }
    }
    #[test]
    fn weights_of_large_denominators_are_left_alone() {
        let mut g = Graph::new();
        let [u, a] = ["u", "a"].map(|name| {
            let symbol = g.new_symbol(name);
            g.symbol(symbol)
        });
        // the weights are 1/3, a small one, and what is left; three times the denominator of the small one is too large
        let small = Rational::new(1, 9_000_000_000_000_000_001);
        let left = Rational::new(2, 3) - small.clone();
        let terms = Terms::from([
            (vec![], Rational::ONE),
            (vec![(u, Rational::from(-2))], Rational::MINUS_ONE),
            (vec![(u, Rational::ONE), (a, -left)], Rational::MINUS_ONE),
            (vec![(u, Rational::ONE), (a, small)], Rational::MINUS_ONE),
        ]);
        assert!(!is_below(&terms, false));
    }
}

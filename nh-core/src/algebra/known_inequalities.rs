//! What holds of functions whatever they are taken of, as polynomials in them and their arguments, and polynomials
//! without denominators.
//!
//! | inequality | condition |
//! |---|---|
//! | `sin² u + cos² u = 1`, `sin² u ≤ 1`, `cos² u ≤ 1` | – |
//! | `cosh² u − sinh² u = 1`, `tanh² u cosh² u = cosh² u − 1` | – |
//! | `cosh u ≥ 1 + u²/2`, `cosh u ± sinh u > 0` | – |
//! | `exp u ≥ c (1 + u − ln c)` for c = 1/2, 1, 2, `exp u > 0`, `exp u exp −u = 1` | – |
//! | `ln u ≤ u/c − 1 + ln c`, `ln u ≤ 2 (√u/c − 1 + ln c)`, `u > 0` | where the logarithm is defined |
//! | `−π/2 < atan u < π/2`, `−π/2 ≤ asin u ≤ π/2`, `0 ≤ acos u ≤ π`, `−π ≤ atan2(u, v) ≤ π` | beside π, and where they are defined |
//! | `√u ≥ 0`, `(√u)² = u` | where the root is defined |

use super::combination::negative;
use super::graph::Graph;
use super::inequalities::Demand;
use super::node::{Function, Function2, Node};
use super::number::Rational;
use super::polynomial_terms::{Monomial, Terms, multiplied, product_of, sum_of};
use crate::id::ExprId;
use std::collections::BTreeSet;

/// Functions of which something is said.
const FUNCTIONS: usize = 6;

/// Numbers c with rational numbers above ln c, by less than 1e-5.
fn tangents() -> [(Rational, Rational); 3] {
    [
        (Rational::ONE, Rational::ZERO),
        (Rational::from(2), Rational::new(69_315, 100_000)),
        (Rational::new(1, 2), Rational::new(-69_314, 100_000)),
    ]
}

/// factor · polynomial.
fn scaled(polynomial: &Terms, factor: &Rational) -> Terms {
    polynomial.iter().map(|(monomial, c)| (monomial.clone(), c.clone() * factor.clone())).collect()
}

/// Between which multiples of π/2 the values of an arc are, and whether they are strictly.
fn reach(arc: &Node) -> Option<([i64; 2], Demand)> {
    Some(match arc {
        Node::Apply(Function::Atan, _) => ([-1, 1], Demand::Positive),
        Node::Apply(Function::Asin, _) => ([-1, 1], Demand::NotNegative),
        Node::Apply(Function::Acos, _) => ([0, 2], Demand::NotNegative),
        Node::Apply2(Function2::Atan2, ..) => ([-2, 2], Demand::NotNegative),
        _ => return None,
    })
}

fn constant(value: Rational) -> Terms {
    if value.is_zero() { Terms::new() } else { Terms::from([(Monomial::new(), value)]) }
}

fn power(part: ExprId, exponent: i64) -> Monomial {
    vec![(part, exponent.into())]
}

impl Graph {
    /// What holds of the functions that polynomials are made of.
    pub(super) fn known_of_functions(&self, polynomials: &[Terms]) -> Vec<(Terms, Demand)> {
        let parts: BTreeSet<(ExprId, Rational)> =
            polynomials.iter().flat_map(|polynomial| polynomial.keys().flatten().cloned()).collect();
        let mut found: Vec<(Terms, Demand)> = Vec::new();
        let half = Rational::new(1, 2);
        let mut arguments: BTreeSet<(Function, ExprId)> = BTreeSet::new();
        let pi = parts.iter().map(|(part, _)| *part).find(|part| *self.node(*part) == Node::Pi);
        for (part, exponent) in parts.into_iter().take(FUNCTIONS) {
            if exponent == half {
                found.extend(self.known_of_root(part));
            }
            if let (Some(pi), Some(([low, high], demand))) = (pi, reach(self.node(part))) {
                let from = |sign: i64, end: i64| {
                    let value = Terms::from([(power(part, 1), Rational::from(sign))]);
                    match end {
                        0 => value,
                        _ => sum_of(&value, &Terms::from([(power(pi, 1), Rational::new(-sign * end, 2))])),
                    }
                };
                found.extend([(from(1, low), demand), (from(-1, high), demand)]);
            }
            let Node::Apply(function, x) = self.node(part) else { continue };
            let paired = match function {
                Function::Cos => Function::Sin,
                Function::Sinh | Function::Tanh => Function::Cosh,
                other => *other,
            };
            if arguments.insert((paired, *x)) {
                found.extend(self.known_of_function(paired, *x).unwrap_or_default());
            }
        }
        let exponentials = arguments.iter().filter(|(function, _)| *function == Function::Exp);
        let exponentials: Vec<ExprId> = exponentials.map(|(_, x)| *x).collect();
        found.extend(self.known_of_exponentials(&exponentials));
        found.retain(|(polynomial, _)| !polynomial.is_empty());
        found
    }

    /// √u ≥ 0, and its square, which stands as u itself, is what u is made of.
    fn known_of_root(&self, u: ExprId) -> Vec<(Terms, Demand)> {
        let root = Terms::from([(vec![(u, Rational::new(1, 2))], Rational::ONE)]);
        let mut known = vec![(root, Demand::NotNegative)];
        if let Some(inside) = self.polynomial_terms(u) {
            let squared = sum_of(&inside, &Terms::from([(power(u, 1), Rational::MINUS_ONE)]));
            known.push((squared, Demand::Zero));
        }
        known
    }

    fn known_of_function(&self, function: Function, x: ExprId) -> Option<Vec<(Terms, Demand)>> {
        let one = constant(Rational::ONE);
        let of = |wanted: Function| self.known_application(wanted, x);
        let square = |part: ExprId, sign: i64| (power(part, 2), Rational::from(sign));
        let line = |part: ExprId| Terms::from([(power(part, 1), Rational::ONE)]);
        let found = match function {
            Function::Sin => match [of(Function::Sin), of(Function::Cos)] {
                [Some(sin), Some(cos)] => {
                    let circle = Terms::from([square(sin, 1), square(cos, 1)]);
                    vec![(sum_of(&circle, &negative(&one)), Demand::Zero)]
                }
                [one_of, other] => {
                    let below = Terms::from([square(one_of.or(other)?, -1)]);
                    vec![(sum_of(&below, &one), Demand::NotNegative)]
                }
            },
            Function::Cosh => {
                let cosh = of(Function::Cosh)?;
                let u = self.polynomial_terms(x)?;
                let parabola = scaled(&multiplied(&u, &u)?, &Rational::new(-1, 2));
                let above = sum_of(&line(cosh), &negative(&one));
                let mut known = vec![(sum_of(&above, &parabola), Demand::NotNegative)];
                if let Some(sinh) = of(Function::Sinh) {
                    let hyperbola = Terms::from([square(cosh, 1), square(sinh, -1)]);
                    known.push((sum_of(&hyperbola, &negative(&one)), Demand::Zero));
                    known.push((sum_of(&line(cosh), &line(sinh)), Demand::Positive));
                    known.push((sum_of(&line(cosh), &negative(&line(sinh))), Demand::Positive));
                }
                if let Some(tanh) = of(Function::Tanh) {
                    let both = product_of(&power(tanh, 2), &power(cosh, 2));
                    let terms = Terms::from([(both, Rational::ONE), square(cosh, -1)]);
                    known.push((sum_of(&terms, &one), Demand::Zero));
                }
                known
            }
            Function::Exp => {
                let exp = line(of(Function::Exp)?);
                let u = self.polynomial_terms(x)?;
                let mut known = vec![(exp.clone(), Demand::Positive)];
                for (c, ln_c) in tangents() {
                    let tangent = scaled(&sum_of(&u, &constant(Rational::ONE - ln_c)), &c);
                    known.push((sum_of(&exp, &negative(&tangent)), Demand::NotNegative));
                }
                known
            }
            Function::Ln => {
                let ln = line(of(Function::Ln)?);
                let u = self.polynomial_terms(x)?;
                let root = Terms::from([(vec![(x, Rational::new(1, 2))], Rational::ONE)]);
                let mut known = vec![(u.clone(), Demand::Positive)];
                for (c, ln_c) in tangents() {
                    let inverse = c.recip()?;
                    let shift = constant(ln_c - Rational::ONE);
                    let of_root = scaled(&sum_of(&scaled(&root, &inverse), &shift), &Rational::from(2));
                    for tangent in [sum_of(&scaled(&u, &inverse), &shift), of_root] {
                        known.push((sum_of(&tangent, &negative(&ln)), Demand::NotNegative));
                    }
                }
                known
            }
            _ => return None,
        };
        Some(found)
    }

    /// exp u · exp −u = 1.
    fn known_of_exponentials(&self, arguments: &[ExprId]) -> Vec<(Terms, Demand)> {
        let mut known = Vec::new();
        for (k, x) in arguments.iter().enumerate() {
            for y in &arguments[..k] {
                let opposite = self.polynomial_terms(*x).zip(self.polynomial_terms(*y));
                let both = [*x, *y].map(|x| self.known_application(Function::Exp, x));
                if let ([Some(a), Some(b)], Some((u, v))) = (both, opposite)
                    && sum_of(&u, &v).is_empty()
                {
                    let product = product_of(&power(a, 1), &power(b, 1));
                    let unit =
                        Terms::from([(product, Rational::ONE), (Monomial::new(), Rational::MINUS_ONE)]);
                    known.push((unit, Demand::Zero));
                }
            }
        }
        known
    }

    /// A polynomial that is multiplied by the squares of what it is divided by, or by that itself where it is positive.
    pub(super) fn without_denominators(&self, polynomial: Terms) -> Option<Terms> {
        let negative_powers: BTreeSet<ExprId> = polynomial
            .keys()
            .flatten()
            .filter(|(_, exponent)| exponent.is_integer() && exponent.is_negative())
            .map(|(base, _)| *base)
            .collect();
        let mut cleared = polynomial;
        for base in negative_powers {
            let most = cleared.keys().flatten().filter(|(part, _)| *part == base);
            let most = most.filter_map(|(_, exponent)| Some(-exponent.to_i64()?)).max().unwrap_or(0);
            let is_positive = self.range(base, &super::range::Facts::default()).is_positive();
            let times = if is_positive || most % 2 == 0 { most } else { most + 1 };
            if !(1..=4).contains(&times) {
                return Some(cleared);
            }
            let inside = self.polynomial_terms(base)?;
            let mut product = Terms::new();
            for (monomial, coefficient) in &cleared {
                let raised = product_of(monomial, &power(base, times));
                // what is left of the power is multiplied out
                let (left, rest): (Monomial, Monomial) =
                    raised.into_iter().partition(|(part, exponent)| *part == base && !exponent.is_negative());
                let mut term = Terms::from([(rest, coefficient.clone())]);
                for _ in 0..left.first().and_then(|(_, exponent)| exponent.to_i64()).unwrap_or(0) {
                    term = multiplied(&term, &inside)?;
                }
                product = sum_of(&product, &term);
            }
            cleared = product;
        }
        Some(cleared)
    }
}

//! Gathers denominators, and makes high powers operands of their own.

use super::nary::{Arena, Nary, Term};
use crate::id::Id;
use rustc_hash::FxHashMap;

/// Higher powers are chains of their own; lower ones take part in the search for shared pairs.
const HIGH: u32 = 16;

/// Afterwards exponents are positive and small, and divisions are quotients or reciprocals.
pub(super) fn separate_powers(arena: &mut Arena) {
    let order = arena.operands_first(&arena.outputs);
    let denominators = Denominators::of(arena, &order);
    let constant = constants(arena, &order);
    for &term in &order {
        let Nary::Product(factors) = arena.get(term).clone() else { continue };
        let (below, mut above): (Vec<_>, Vec<_>) = factors.iter().partition(|(_, e)| *e < 0);
        let below: Vec<(Term, i32)> = below.iter().map(|(b, e)| (*b, e.saturating_neg())).collect();
        let mut divisor = Vec::new();
        if denominators.is_shared_whole(&below) {
            let product = powers_of(arena, below);
            above.push((arena.intern(Nary::Recip(product)), 1));
        } else {
            for (base, exponent) in below {
                if denominators.is_shared(base) || constant[base.index()] {
                    above.push((arena.intern(Nary::Recip(base)), exponent));
                } else {
                    divisor.push((base, exponent));
                }
            }
        }
        let form = if divisor.is_empty() {
            power_form(arena, above)
        } else {
            let divisor = powers_of(arena, divisor);
            match powers_of(arena, above) {
                one if arena.as_number(one).is_some_and(crate::algebra::Rational::is_one) => {
                    Nary::Recip(divisor)
                }
                numerator => Nary::Quotient(numerator, divisor),
            }
        };
        arena.rewrite(term, form);
    }
}

/// How often denominators occur.
#[derive(Default)]
struct Denominators {
    single: FxHashMap<Term, usize>,
    whole: FxHashMap<Vec<(Term, i32)>, usize>,
}

impl Denominators {
    fn of(arena: &Arena, order: &[Term]) -> Self {
        let mut found = Self::default();
        for term in order {
            let Nary::Product(factors) = arena.get(*term) else { continue };
            let below: Vec<_> = factors.iter().filter(|(_, e)| *e < 0).map(|(b, e)| (*b, -e)).collect();
            for (base, _) in &below {
                *found.single.entry(*base).or_default() += 1;
            }
            if below.len() > 1 {
                *found.whole.entry(below).or_default() += 1;
            }
        }
        found
    }

    /// Whether several products divide by `base`.
    fn is_shared(&self, base: Term) -> bool {
        self.single.get(&base).is_some_and(|count| *count > 1)
    }

    /// Whether several products divide by all of these, and none by only some of them.
    fn is_shared_whole(&self, below: &[(Term, i32)]) -> bool {
        self.whole.get(below).is_some_and(|count| {
            *count > 1 && below.iter().all(|(base, _)| self.single.get(base) == Some(count))
        })
    }
}

/// Which terms are made of numbers alone.
fn constants(arena: &Arena, order: &[Term]) -> Vec<bool> {
    let mut constant = vec![false; arena.len()];
    let mut operands = Vec::new();
    for term in order {
        operands.clear();
        arena.dependencies(*term, &mut operands);
        constant[term.index()] = match arena.get(*term) {
            Nary::Symbol(_) => false,
            _ => operands.iter().all(|operand| constant[operand.index()]),
        };
    }
    constant
}

/// A product of positive powers as a term.
fn powers_of(arena: &mut Arena, factors: Vec<(Term, i32)>) -> Term {
    match power_form(arena, factors) {
        Nary::Product(factors) if matches!(*factors, [(_, 1)]) => factors[0].0,
        form => arena.intern(form),
    }
}

/// A product of positive powers, each high power an operand of its own.
fn power_form(arena: &mut Arena, factors: Vec<(Term, i32)>) -> Nary {
    let mut operands = Vec::with_capacity(factors.len());
    for (base, exponent) in factors {
        if exponent.unsigned_abs() > HIGH {
            operands.push((arena.intern(Nary::Power(base, exponent.unsigned_abs())), 1));
        } else {
            operands.push((base, exponent));
        }
    }
    match *operands {
        [(only, 1)] => match arena.get(only).clone() {
            power @ (Nary::Power(..) | Nary::Recip(_)) => power,
            _ => Nary::Product(operands.into()),
        },
        _ => arena.product_form(operands),
    }
}

//! Takes common factors out of sums, and signs out of products, where that saves operations.

use super::nary::{Arena, Nary, Term};
use crate::id::Id;
use crate::limits;

/// How much a product counts that other terms use too: it has to be computed for them anyway.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sharing {
    /// Nothing.
    Ignored,
    /// Its part among its users.
    Divided,
}

/// The savings of one multiplication, in units that small counts of users divide.
const ONE: u32 = 12;

/// Factors of operands that are looked at, over and over: a long sum of long products takes the cube of its length.
/// Beyond this, sums stay as they are.
const PATIENCE: usize = 2_000_000;

/// `a·x + b·x = (a + b)·x`, the factor that saves most first, inner sums in turn.
pub(super) fn factor(arena: &mut Arena, sharing: Sharing) {
    let (mut uses, mut patience) = (arena.uses(), PATIENCE);
    let mut open: Vec<Term> = Arena::live(&uses);
    open.reverse();
    while let Some(term) = open.pop() {
        while let Some((base, exponent)) = best_factor(arena, &uses, term, sharing, &mut patience) {
            let before = arena.len();
            let inner = take_out(arena, &mut uses, term, base, exponent);
            if inner.index() >= before {
                open.push(inner);
            }
        }
    }
    flatten(arena);
    absorb_signs(arena);
}

/// The factors of one operand of a sum, which are `alone` if it is no product.
fn factors<'a>(arena: &'a Arena, alone: &'a [(Term, i32); 1]) -> &'a [(Term, i32)] {
    match arena.get(alone[0].0) {
        Nary::Product(factors) => factors,
        _ => alone,
    }
}

/// The power that most operands share, if taking it out pays.
fn best_factor(
    arena: &Arena,
    uses: &[u32],
    sum: Term,
    sharing: Sharing,
    patience: &mut usize,
) -> Option<(Term, i32)> {
    let Nary::Sum(operands) = arena.get(sum) else { return None };
    // base, whether it is a denominator, exponent, what taking it out of that operand saves
    let mut powers: Vec<(Term, bool, i32, u32)> = Vec::with_capacity(4 * operands.len());
    for (operand, _) in operands.iter() {
        let users = uses[operand.index()].max(1);
        let worth = match (arena.get(*operand), sharing) {
            (Nary::Product(_), Sharing::Divided) => ONE / users.min(ONE),
            (Nary::Product(_), Sharing::Ignored) if users == 1 => ONE,
            _ => 0,
        };
        let alone = [(*operand, 1)];
        let factors = factors(arena, &alone).iter();
        powers.extend(factors.map(|(base, exponent)| (*base, *exponent < 0, *exponent, worth)));
    }
    limits::spend(powers.len());
    *patience = patience.checked_sub(powers.len())?;
    powers.sort_unstable();
    let mut best: Option<(u32, Term, i32)> = None;
    for same in powers.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        // the product with what is left is one new multiplication
        let savings = same.iter().map(|(.., worth)| worth).sum();
        if same.len() > 1 && savings > ONE && best.is_none_or(|(most, ..)| savings > most) {
            let smallest = same.iter().map(|(_, _, exponent, _)| *exponent).min_by_key(|e| e.unsigned_abs());
            best = smallest.map(|exponent| (savings, same[0].0, exponent));
        }
    }
    best.map(|(_, base, exponent)| (base, exponent))
}

/// Replaces the operands that contain `base^exponent` by one product, and returns its inner sum.
fn take_out(arena: &mut Arena, uses: &mut Vec<u32>, sum: Term, base: Term, exponent: i32) -> Term {
    let Nary::Sum(operands) = arena.get(sum).clone() else { return sum };
    let mut rest = Vec::new();
    let mut inside = Vec::new();
    for &(operand, negative) in operands.iter() {
        let alone = [(operand, 1)];
        let factors = factors(arena, &alone);
        if factors.iter().any(|(b, e)| *b == base && (*e < 0) == (exponent < 0)) {
            let mut factors = factors.to_vec();
            factors.push((base, exponent.saturating_neg()));
            inside.push((arena.product(factors), negative));
            uses[operand.index()] = uses[operand.index()].saturating_sub(1);
        } else {
            rest.push((operand, negative));
        }
    }
    let (inner, negative) = arena.sum(inside.clone());
    let product = arena.product(vec![(inner, 1), (base, exponent)]);
    uses.resize(arena.len(), 0);
    for (operand, _) in inside {
        uses[operand.index()] += 1;
    }
    uses[inner.index()] += 1;
    if rest.is_empty() {
        let whole = if negative { Nary::Neg(product) } else { arena.get(product).clone() };
        uses[product.index()] += u32::from(negative);
        arena.rewrite(sum, whole);
    } else {
        uses[product.index()] += 1;
        rest.push((product, negative));
        rest.sort_unstable();
        arena.rewrite(sum, Nary::Sum(rest.into()));
    }
    inner
}

/// Products within products that nothing else uses become one.
fn flatten(arena: &mut Arena) {
    let uses = arena.uses();
    for term in arena.operands_first(&arena.outputs) {
        let Nary::Product(factors) = arena.get(term) else { continue };
        let mut flat = Vec::with_capacity(factors.len());
        let mut changed = false;
        for &(base, exponent) in factors.iter() {
            match arena.get(base) {
                Nary::Product(inner) if uses[base.index()] == 1 => {
                    let powers = inner.iter().map(|(b, e)| {
                        Some((*b, e.checked_mul(exponent).filter(|product| *product != i32::MIN)?))
                    });
                    if let Some(powers) = powers.collect::<Option<Vec<_>>>() {
                        flat.extend(powers);
                        changed = true;
                        continue;
                    }
                    flat.push((base, exponent));
                }
                _ => flat.push((base, exponent)),
            }
        }
        if changed {
            let form = arena.product_form(flat);
            arena.rewrite(term, form);
        }
    }
}

/// `−(2·x) = (−2)·x` and `−(a − b)·x = (b − a)·x`.
fn absorb_signs(arena: &mut Arena) {
    let uses = arena.uses();
    for term in Arena::live(&uses) {
        let Nary::Neg(inner) = *arena.get(term) else { continue };
        if uses[inner.index()] > 1 {
            continue;
        }
        if let Some(form) = negated(arena, &uses, inner) {
            arena.rewrite(term, form);
        }
    }
}

/// The negative at no cost, if there is one.
fn negated(arena: &mut Arena, uses: &[u32], term: Term) -> Option<Nary> {
    let flip = |operands: &[(Term, bool)]| operands.iter().map(|(o, negative)| (*o, !negative)).collect();
    match arena.get(term).clone() {
        Nary::Sum(operands) if operands.iter().any(|(_, negative)| *negative) => {
            Some(Nary::Sum(flip(&operands)))
        }
        Nary::Product(factors) => {
            let mut factors = factors.to_vec();
            for index in 0..factors.len() {
                let (base, exponent) = factors[index];
                let image = match arena.get(base).clone() {
                    Nary::Number(value) if exponent == 1 => Nary::Number(-value),
                    Nary::Sum(operands)
                        if exponent % 2 != 0
                            && uses.get(base.index()) == Some(&1)
                            && operands.iter().any(|(_, negative)| *negative) =>
                    {
                        Nary::Sum(flip(&operands))
                    }
                    _ => continue,
                };
                factors[index].0 = arena.intern(image);
                return Some(arena.product_form(factors));
            }
            None
        }
        _ => None,
    }
}

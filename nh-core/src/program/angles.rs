//! Sines and cosines of sums of angles from those of the parts, by the addition theorems.
//!
//! An evaluation of a sine costs as much as some fifteen multiplications, so that
//! `sin(a − b) = sin a cos b − cos a sin b` pays wherever the parts are needed anyway. It costs the
//! relative accuracy of small angles: what is left of two products of order one is as wrong as these.

use super::nary::{Arena, Nary, Term};
use crate::algebra::{Function, Rational};
use crate::id::Id;
use std::collections::BTreeMap;

/// An angle as a combination of terms that are no sums.
type Form = BTreeMap<Term, Rational>;

/// Replaces sines and cosines whose angles are sums or differences of two others.
pub(super) fn share_angles(arena: &mut Arena) {
    let angles = angles(arena);
    // 1. of other angles, the longest sums first
    let mut order: Vec<usize> = (0..angles.len()).collect();
    order.sort_by_key(|index| std::cmp::Reverse(angles[*index].1.len()));
    let mut is_part = vec![false; angles.len()];
    let mut is_whole = vec![false; angles.len()];
    for &whole in &order {
        if is_part[whole] {
            continue;
        }
        let free = |index: &usize| *index != whole && !is_whole[*index];
        let found = (0..angles.len()).filter(free).find_map(|first| {
            let signs = [false, true];
            let pairs =
                (first..angles.len()).filter(free).flat_map(|second| signs.map(|minus| (second, minus)));
            let mut sums =
                pairs.flat_map(|(second, minus)| signs.map(|minus_first| (minus_first, second, minus)));
            sums.find(|(minus_first, second, minus)| {
                combination(&angles[first].1, *minus_first, &angles[*second].1, *minus) == angles[whole].1
            })
            .map(|(minus_first, second, minus)| (first, minus_first, second, minus))
        });
        if let Some((first, minus_first, second, minus)) = found {
            is_whole[whole] = true;
            (is_part[first], is_part[second]) = (true, true);
            replace(arena, angles[whole].0, (angles[first].0, minus_first), (angles[second].0, minus));
        }
    }
    // 2. of terms, if that makes fewer; none of them is written by others already
    let wholes = angles.iter().zip(&is_whole).filter(|(_, is_whole)| **is_whole);
    let wholes: Vec<Term> = wholes.map(|((angle, _), _)| *angle).collect();
    let is_pair = |(angle, form): &&(Term, Form)| {
        let is_free = !wholes.contains(angle) && form.keys().all(|term| !wholes.contains(term));
        is_free && form.len() == 2 && form.values().all(|coefficient| coefficient.abs().is_one())
    };
    let pairs: Vec<&(Term, Form)> = angles.iter().filter(is_pair).collect();
    let mut new: Vec<Term> = pairs.iter().flat_map(|(_, form)| form.keys().copied()).collect();
    new.sort_unstable();
    new.dedup();
    new.retain(|term| angles.iter().all(|(angle, _)| angle != term));
    if new.len() < pairs.len() {
        for (angle, form) in pairs {
            let parts: Vec<(Term, bool)> = form.iter().map(|(term, c)| (*term, c.is_negative())).collect();
            if let [first, second] = *parts {
                replace(arena, *angle, first, second);
            }
        }
    }
}

/// The angles whose sine or cosine is needed.
fn angles(arena: &Arena) -> Vec<(Term, Form)> {
    let uses = arena.uses();
    let mut angles: Vec<(Term, Form)> = Vec::new();
    for term in Arena::live(&uses) {
        if let Nary::Apply(Function::Sin | Function::Cos, angle) = arena.get(term)
            && angles.iter().all(|(known, _)| known != angle)
        {
            angles.push((*angle, form(arena, *angle)));
        }
    }
    angles
}

fn form(arena: &Arena, angle: Term) -> Form {
    let mut form = Form::new();
    let single = [(angle, false)];
    let operands = if let Nary::Sum(operands) = arena.get(angle) { operands.as_slice() } else { &single };
    for (operand, negative) in operands {
        let (term, coefficient) = match arena.get(*operand) {
            Nary::Product(factors) => match factors.as_slice() {
                [(number, 1), (term, 1)] | [(term, 1), (number, 1)] if arena.as_number(*number).is_some() => {
                    (*term, arena.as_number(*number).cloned().unwrap_or(Rational::ONE))
                }
                _ => (*operand, Rational::ONE),
            },
            _ => (*operand, Rational::ONE),
        };
        let coefficient = if *negative { -coefficient } else { coefficient };
        let sum = form.remove(&term).map_or(coefficient.clone(), |before| before + coefficient);
        if !sum.is_zero() {
            form.insert(term, sum);
        }
    }
    form
}

/// `± a ± b`
fn combination(a: &Form, minus_a: bool, b: &Form, minus_b: bool) -> Form {
    let mut sum = Form::new();
    for (form, minus) in [(a, minus_a), (b, minus_b)] {
        for (term, coefficient) in form {
            let coefficient = if minus { -coefficient.clone() } else { coefficient.clone() };
            let total = sum.remove(term).map_or(coefficient.clone(), |before: Rational| before + coefficient);
            if !total.is_zero() {
                sum.insert(*term, total);
            }
        }
    }
    sum
}

/// Writes sine and cosine of `± a ± b` by those of a and b.
fn replace(arena: &mut Arena, angle: Term, (a, minus_a): (Term, bool), (b, minus_b): (Term, bool)) {
    let [sin_a, cos_a, sin_b, cos_b] =
        [(Function::Sin, a), (Function::Cos, a), (Function::Sin, b), (Function::Cos, b)]
            .map(|(function, angle)| arena.intern(Nary::Apply(function, angle)));
    let mut write =
        |function: Function, first: [Term; 2], minus_first: bool, second: [Term; 2], minus: bool| {
            let Some(term) = arena.find(&Nary::Apply(function, angle)) else { return };
            let [first, second] = [first, second].map(|[x, y]| arena.product(vec![(x, 1), (y, 1)]));
            if minus_first && minus {
                let sum = arena.intern(Nary::Sum(sorted([(first, false), (second, false)])));
                arena.rewrite(term, Nary::Neg(sum));
            } else if first == second && minus_first == minus {
                // sin 2a
                let two = arena.number(Rational::from(2));
                let form = arena.product_form(vec![(two, 1), (first, 1)]);
                arena.rewrite(term, form);
            } else {
                arena.rewrite(term, Nary::Sum(sorted([(first, minus_first), (second, minus)])));
            }
        };
    write(Function::Sin, [sin_a, cos_b], minus_a, [cos_a, sin_b], minus_b);
    write(Function::Cos, [cos_a, cos_b], false, [sin_a, sin_b], minus_a == minus_b);
}

fn sorted(mut operands: [(Term, bool); 2]) -> Vec<(Term, bool)> {
    operands.sort_unstable_by_key(|(term, _)| term.index());
    operands.to_vec()
}

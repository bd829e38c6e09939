//! Sines and cosines of sums of angles from those of the parts, by the addition theorems.
//!
//! An evaluation of a sine costs as much as some fifteen multiplications, so that
//! `sin(a − b) = sin a cos b − cos a sin b` pays wherever the parts are needed anyway. It costs the
//! relative accuracy of small angles: what is left of two products of order one is as wrong as these, which is what one or
//! two ulps of the parts explain. Fast code has it so; balanced code where bounds on the errors of the results grow
//! no larger by it. Careful code, which carries what rounding took of the products, has it so that
//! sines of sums and those of their parts, each rounded for itself, do not break what cancels by the theorems.

use super::nary::{Arena, Nary, Term};
use crate::algebra::{Function, Rational, Residue};
use crate::id::Id;
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::BTreeMap;
use std::rc::Rc;

/// An angle as a combination of terms that are no sums.
type Form = BTreeMap<Term, Rational>;

/// Of so many pairs of angles it is asked whether one is the sum of the other and a third: of four hundred angles it is of
/// all. Of more, what is found before is shared.
const PAIRS: usize = 200_000;

/// An angle whose sine or cosine is needed.
struct Angle {
    term: Term,
    form: Form,
    /// The value of the form at random numbers in the place of its terms: that of a sum is the sum of those of its parts.
    value: Residue,
    /// How many sines and cosines are nested in it.
    depth: usize,
}

/// A term, and whether it is subtracted.
type Signed = (Term, bool);

/// Replaces sines and cosines whose angles are sums or differences of two others; whether there are any.
pub(super) fn share_angles(arena: &mut Arena) -> bool {
    let angles = angles(arena);
    let wholes = from_other_angles(arena, &angles);
    let from_terms = from_terms(arena, &angles, &wholes);
    from_terms || !wholes.is_empty()
}

/// Takes angles from two others each, the longest sums first; those that were replaced.
///
/// The two are nested no deeper than the angle itself: none of them contains its sine, nor one that is
/// taken from it.
fn from_other_angles(arena: &mut Arena, angles: &[Angle]) -> Vec<Term> {
    let mut with_value: FxHashMap<u64, Vec<usize>> = FxHashMap::default();
    for (index, angle) in angles.iter().enumerate() {
        with_value.entry(angle.value.word()).or_default().push(index);
    }
    let mut order: Vec<usize> = (0..angles.len()).collect();
    order.sort_by_key(|index| std::cmp::Reverse(angles[*index].form.len()));
    let mut is_part = vec![false; angles.len()];
    let mut is_whole = vec![false; angles.len()];
    let mut pairs = 0;
    for whole in order {
        if is_part[whole] {
            continue;
        }
        let free = |index: &usize| {
            *index != whole && !is_whole[*index] && angles[*index].depth <= angles[whole].depth
        };
        let firsts = (0..angles.len()).filter(free).take(PAIRS - pairs).inspect(|_| pairs += 1);
        let found = { firsts }.find_map(|first| {
            let signs = [(false, false), (false, true), (true, false), (true, true)];
            let others = signs.into_iter().flat_map(|(minus, minus_first)| {
                let signed = |value: Residue, is_minus: bool| if is_minus { -value } else { value };
                let [whole, first] = [&angles[whole], &angles[first]];
                let minus_rest = minus == minus_first;
                let rest = signed(whole.value, minus) + signed(first.value, minus_rest);
                let others = with_value.get(&rest.word()).into_iter().flatten().copied();
                let is_rest = move |second: &usize| {
                    angles[*second].form == combination(&whole.form, minus, &first.form, minus_rest)
                };
                others.filter(is_rest).map(move |second| (second, minus, minus_first))
            });
            let (second, minus, minus_first) =
                others.filter(|(second, ..)| *second >= first && free(second)).min()?;
            Some(((first, minus_first), (second, minus)))
        });
        if let Some(((first, minus_first), (second, minus))) = found {
            is_whole[whole] = true;
            (is_part[first], is_part[second]) = (true, true);
            let parts = [(angles[first].term, minus_first), (angles[second].term, minus)];
            replace(arena, angles[whole].term, parts);
        }
    }
    angles.iter().zip(is_whole).filter(|(_, is_whole)| *is_whole).map(|(angle, _)| angle.term).collect()
}

/// Takes sums of two terms from these, if that makes fewer angles, and whether it does; none of them is written by others
/// already.
fn from_terms(arena: &mut Arena, angles: &[Angle], wholes: &[Term]) -> bool {
    let is_pair = |angle: &&Angle| {
        let is_free = !wholes.contains(&angle.term) && angle.form.keys().all(|term| !wholes.contains(term));
        is_free && angle.form.len() == 2 && angle.form.values().all(|coefficient| coefficient.abs().is_one())
    };
    let pairs: Vec<&Angle> = angles.iter().filter(is_pair).collect();
    let mut new: Vec<Term> = pairs.iter().flat_map(|angle| angle.form.keys().copied()).collect();
    new.sort_unstable();
    new.dedup();
    new.retain(|term| angles.iter().all(|angle| angle.term != *term));
    let is_shorter = new.len() < pairs.len();
    if is_shorter {
        for angle in pairs {
            let parts: Vec<Signed> = angle.form.iter().map(|(term, c)| (*term, c.is_negative())).collect();
            if let [first, second] = *parts {
                replace(arena, angle.term, [first, second]);
            }
        }
    }
    is_shorter
}

/// The angles whose sine or cosine is needed.
fn angles(arena: &Arena) -> Vec<Angle> {
    let uses = arena.uses();
    let depths = depths(arena);
    let mut known: FxHashSet<Term> = FxHashSet::default();
    let mut angles: Vec<Angle> = Vec::new();
    for term in Arena::live(&uses) {
        if let Nary::Apply(Function::Sin | Function::Cos, angle) = *arena.get(term)
            && known.insert(angle)
        {
            let form = form(arena, angle);
            let value = value(&form);
            angles.push(Angle { term: angle, form, value, depth: depths[angle.index()] });
        }
    }
    angles
}

/// How many sines and cosines are nested in each term.
fn depths(arena: &Arena) -> Vec<usize> {
    let mut depths = vec![0; arena.len()];
    let mut operands = Vec::new();
    for term in arena.operands_first(&arena.outputs) {
        operands.clear();
        arena.dependencies(term, &mut operands);
        let inside = operands.iter().map(|operand| depths[operand.index()]).max().unwrap_or(0);
        let own = matches!(arena.get(term), Nary::Apply(Function::Sin | Function::Cos, _));
        depths[term.index()] = inside + usize::from(own);
    }
    depths
}

/// The value of a form at random numbers in the place of its terms.
fn value(form: &Form) -> Residue {
    let parts = form.iter().map(|(term, coefficient)| {
        let coefficient = Residue::of(coefficient).unwrap_or(Residue::ZERO);
        coefficient * Residue::mixed(47_000, term.index() as u64)
    });
    parts.fold(Residue::ZERO, |sum, part| sum + part)
}

fn form(arena: &Arena, angle: Term) -> Form {
    let mut form = Form::new();
    let single = [(angle, false)];
    let operands = if let Nary::Sum(operands) = arena.get(angle) { &operands[..] } else { &single };
    for (operand, negative) in operands {
        let (term, coefficient) = match arena.get(*operand) {
            Nary::Product(factors) => match factors[..] {
                [(number, 1), (term, 1)] | [(term, 1), (number, 1)] if arena.as_number(number).is_some() => {
                    (term, arena.as_number(number).cloned().unwrap_or(Rational::ONE))
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
fn replace(arena: &mut Arena, angle: Term, [(a, minus_a), (b, minus_b)]: [Signed; 2]) {
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

fn sorted(mut operands: [Signed; 2]) -> Rc<[Signed]> {
    operands.sort_unstable_by_key(|(term, _)| term.index());
    operands.into()
}

//! The one zero test. Nothing else in the project compares an expression with zero.
//!
//! `Zero` is proved by random points of a large prime field: a non-zero rational function of
//! degree d vanishes at one with probability at most d/P < 2⁻⁴⁰ for any d that occurs, so two
//! points leave less than 2⁻⁸⁰ (Schwartz–Zippel). A square root has two branches, between which
//! the field chooses by chance; expressions with roots are tested at 80 points unless these are proved
//! to be independent, and where they do not vanish there, they are tested at random points with the roots of real numbers, exactly
//! (`enclosure.rs`). `NonZero` is proved at a point where the value exceeds its error bound, in floating
//! point or with as many digits as it takes. Expressions without symbols are decided by these
//! digits alone, where a bound says how many there have to be (`exact.rs`).

use super::ball::{Bits, NoBall};
use super::enclosure::Point;
use super::exact::Decision;
use super::graph::Graph;
use super::modular::{FieldPass, FieldPoint, NoValue};
use super::node::{Function, Node};
use super::range::Facts;
use super::square_points::Radicands;
use super::verdict::{Verdict, Witness};
use crate::id::{ExprId, SymbolId};

impl Witness {
    /// `x = 0.7, m = 1.2`.
    #[must_use]
    pub fn place(&self, graph: &Graph) -> String {
        let entries: Vec<_> = self
            .point
            .iter()
            .map(|(symbol, value)| format!("{} = {value}", graph.symbols()[*symbol]))
            .collect();
        entries.join(", ")
    }
}

/// Points of the field at which an expression without roots is tested.
const POINTS: u64 = 2;
/// Points for an expression with square roots.
const POINTS_WITH_ROOTS: u64 = 80;
/// Points for an expression whose square roots are independent (`independent_roots.rs`): up to six of them take twelve
/// bits of what a point proves.
const POINTS_WITH_INDEPENDENT_ROOTS: u64 = 3;
/// Failed points (poles, roots outside the field) before giving up, per point wanted.
const PATIENCE: u64 = 24;
/// Failed points before giving up where there was a value at none, half of them without regard to roots: what
/// divides by zero, or has the root of a negative number, does so everywhere.
const WITHOUT_VALUE: u64 = 2 * PATIENCE;
/// The same for points with the roots of real numbers, which are dear.
const WITHOUT_REAL_VALUE: u64 = PATIENCE;
/// Points tried for a witness.
const WITNESSES: u64 = 24;
/// Points tried for a witness where facts hold.
const WITNESSES_UNDER_FACTS: u64 = 400;
/// Points tried for a witness with more digits, and these digits.
const CLOSER_LOOKS: u64 = 8;
const CLOSER: Bits = 256;
/// Digits for exponentials, whose values may be far below those of floating point, and parts of an expression up to
/// which they are looked at with so many.
const CLOSER_TO_EXPONENTIALS: Bits = 1 << 12;
const LARGEST_WITH_EXPONENTIALS: usize = 200;
/// Random points with the roots of real numbers: coordinates have 20 bits, so that four leave less
/// than (d/2²⁰)⁴ for an expression of degree d.
const REAL_POINTS: u64 = 4;
/// Digits up to which numbers are decided.
const MOST_DIGITS: Bits = 1 << 14;
/// Digits up to which a number is looked at that has no separation bound.
const DIGITS_WITHOUT_BOUND: Bits = 1 << 11;
/// Expressions with more parts are not looked at with more digits.
const LARGEST: usize = 20_000;

impl Graph {
    /// Decides whether `expression` vanishes identically.
    #[must_use]
    pub fn zero_test(&self, expression: ExprId) -> Verdict {
        match self.value_of(expression) {
            Some(number) if number.is_zero() => return Verdict::Zero,
            Some(number) => return Verdict::NonZero(Witness { point: Vec::new(), value: number.to_f64() }),
            None => {}
        }
        if let Some(known) = self.verdicts.borrow().get(&expression) {
            return known.clone();
        }
        let verdict = self.decided(expression);
        self.verdicts.borrow_mut().insert(expression, verdict.clone());
        verdict
    }

    /// Whether `expression` is proved not to vanish identically. Where the field knows all identities that it
    /// could vanish by, a point of the field shows it: a point of the reals may take many digits.
    #[must_use]
    pub fn is_nonzero(&self, expression: ExprId) -> bool {
        let is_known = self.verdicts.borrow().contains_key(&expression);
        if !is_known
            && !self.symbols_in(&[expression]).is_empty()
            && !self.is_beyond_field(&[expression])
            && let Ok(vanishes) = self.vanishes_in_field(expression, false)
        {
            return !vanishes;
        }
        self.zero_test(expression).is_nonzero()
    }

    fn decided(&self, expression: ExprId) -> Verdict {
        if self.symbols_in(&[expression]).is_empty() {
            return self.decided_number(expression);
        }
        let has_roots = self.has_roots(expression);
        let in_field = self.vanishes_in_field(expression, has_roots);
        if in_field == Ok(true) && !has_roots {
            return Verdict::Zero;
        }
        // the field has no values of kinks
        let may_have_branches = has_roots || matches!(in_field, Err(NoValue::Ever(_)));
        match self.decided_beyond_identities(expression, &in_field) {
            Verdict::Zero => self.zero_on_all_branches(expression),
            Verdict::Unknown(why) if may_have_branches => match self.zero_on_all_branches(expression) {
                found @ Verdict::NonZero(_) => found,
                _ => Verdict::Unknown(why),
            },
            unknown @ Verdict::Unknown(_) => unknown,
            found @ Verdict::NonZero(_) => found,
        }
    }

    /// The same of what no identity of the field has decided.
    fn decided_beyond_identities(&self, expression: ExprId, in_field: &Result<bool, NoValue>) -> Verdict {
        let witness = self.witness(expression).or_else(|| self.closer_witness(expression, CLOSER));
        if let Some(witness) = witness {
            return Verdict::NonZero(witness);
        }
        if *in_field == Ok(false)
            && let Some(witness) = self.witness_of_exponentials(expression)
        {
            return Verdict::NonZero(witness);
        }
        // nothing else vanishes on the reals that does not in the field, or divides by zero there and not on the reals
        let may_vanish = || match in_field {
            Err(NoValue::Ever(_)) => true,
            // roots that are independent are no functions of each other on the reals either
            Ok(false) => self.is_beyond_field(&[expression]) && !self.has_independent_roots(expression),
            _ => self.is_beyond_field(&[expression]),
        };
        match in_field {
            // the sign of a root on the reals had the last word: `sqrt(x^2) − x`
            Ok(true) => Verdict::Zero,
            _ if may_vanish() && self.vanishes_on_reals(expression) => self.zero_by_values(expression),
            Ok(false) => {
                let why = "it could not be told from zero at any point tried, and is zero by no identity known here";
                Verdict::Unknown(why.into())
            }
            Err(NoValue::Here) => Verdict::Unknown(
                "it has no value at the points tried (a division by zero, or the root of a negative number)"
                    .into(),
            ),
            Err(NoValue::Ever(reason)) => Verdict::Unknown(reason.clone()),
        }
    }

    /// Decides an expression without symbols.
    fn decided_number(&self, expression: ExprId) -> Verdict {
        let by_identity =
            || !self.has_roots(expression) && self.vanishes_in_field(expression, false) == Ok(true);
        let mut bits = 128;
        let mut seen = 0;
        let mut most = DIGITS_WITHOUT_BOUND;
        while bits <= most {
            let point = Point::Given(&|_| super::Rational::ZERO);
            let mut next = 2 * bits;
            match self.evaluate_exactly(&[expression], point, bits) {
                Ok(evaluated) => {
                    let value = &evaluated.values[0];
                    if value.ball.is_nonzero() {
                        return Verdict::NonZero(Witness { point: Vec::new(), value: value.ball.to_f64() });
                    }
                    seen = bits;
                    match value.form.as_ref().map(|form| form.decided(evaluated.degree, bits)) {
                        Some(Ok(Decision::Zero)) if by_identity() => return Verdict::Zero,
                        Some(Ok(Decision::Zero)) => return self.zero_by_values(expression),
                        Some(Ok(Decision::Digits(wanted))) => {
                            most = MOST_DIGITS;
                            next = next.max(wanted);
                        }
                        _ => {}
                    }
                }
                Err(NoBall::Undefined) => {
                    return Verdict::Unknown("it is not a real number".into());
                }
                Err(NoBall::TooWide) => {}
                Err(NoBall::TooLong) => break,
            }
            bits = next;
        }
        if seen > 0 && by_identity() {
            return Verdict::Zero;
        }
        if seen > 0 && self.vanishes_on_reals(expression) {
            return self.zero_by_values(expression);
        }
        Verdict::Unknown(match seen {
            0 => "its value is beyond the numbers that can be compared with zero".into(),
            bits => format!("it is zero to {} digits, but not by any identity known here", bits * 3 / 10),
        })
    }

    /// A point where the expression is not zero, though floating point may not tell exponentials from zero there: they
    /// have no zeros, however small they are.
    fn witness_of_exponentials(&self, expression: ExprId) -> Option<Witness> {
        let parts = self.reachable(&[expression]);
        let is_exponential = |id: ExprId| matches!(self.node(id), Node::Apply(Function::Exp, _));
        if parts.len() > LARGEST_WITH_EXPONENTIALS || !parts.iter().any(|part| is_exponential(*part)) {
            return None;
        }
        // in a product the other factors decide
        let factors: Vec<ExprId> = match self.node(expression) {
            Node::Product { factors, .. } => factors.iter().map(|(base, _)| *base).collect(),
            _ => vec![expression],
        };
        let others: Vec<ExprId> = factors.iter().copied().filter(|base| !is_exponential(*base)).collect();
        if others.len() < factors.len() {
            let symbols = self.symbols_in(&[expression]);
            let found = (0..WITNESSES).find_map(|attempt| {
                let point = point_of(&symbols, attempt);
                let values = self.evaluate(&others, |symbol| value_at(&point, symbol));
                let value = self.evaluate(&[expression], |symbol| value_at(&point, symbol))[0].value;
                values.iter().all(|value| value.is_certainly_nonzero()).then_some(Witness { point, value })
            });
            if found.is_some() {
                return found;
            }
        }
        self.closer_witness(expression, CLOSER_TO_EXPONENTIALS)
    }

    /// A point where the expression is not zero, with more digits than floating point has.
    fn closer_witness(&self, expression: ExprId, bits: Bits) -> Option<Witness> {
        if self.reachable(&[expression]).len() > LARGEST {
            return None;
        }
        let symbols = self.symbols_in(&[expression]);
        (0..CLOSER_LOOKS).find_map(|attempt| {
            let point = point_of(&symbols, attempt);
            let value =
                |symbol| super::Rational::of_f64(value_at(&point, symbol)).unwrap_or(super::Rational::ZERO);
            let evaluated = self.evaluate_exactly(&[expression], Point::Given(&value), bits).ok()?;
            let ball = &evaluated.values[0].ball;
            ball.is_nonzero().then(|| Witness { value: ball.to_f64(), point: point.clone() })
        })
    }

    /// Whether the expression vanishes at random points with the roots of real numbers.
    fn vanishes_on_reals(&self, expression: ExprId) -> bool {
        if self.reachable(&[expression]).len() > LARGEST {
            return false;
        }
        [false, true].into_iter().any(|tied| {
            let mut seen = 0;
            for seed in 0..REAL_POINTS * PATIENCE {
                if seen == 0 && seed == WITHOUT_REAL_VALUE {
                    return false;
                }
                match self.vanishes_at(expression, Point::Random { seed, tied }) {
                    Ok(true) => seen += 1,
                    Err(NoBall::Undefined) => {}
                    Ok(false) | Err(_) => return false,
                }
                if seen == REAL_POINTS {
                    return true;
                }
            }
            false
        })
    }

    /// Whether the expression is zero at a point, decided with as many digits as it takes.
    fn vanishes_at(&self, expression: ExprId, point: Point<'_>) -> Result<bool, NoBall> {
        let mut bits = 128;
        while bits <= MOST_DIGITS {
            let mut next = 2 * bits;
            match self.evaluate_exactly(&[expression], point, bits) {
                Err(NoBall::TooWide) => {}
                Err(other) => return Err(other),
                Ok(evaluated) => {
                    let Some(form) = &evaluated.values[0].form else { return Err(NoBall::TooLong) };
                    match form.decided(evaluated.degree, bits)? {
                        Decision::Zero => return Ok(true),
                        Decision::NonZero => return Ok(false),
                        Decision::Digits(wanted) => next = next.max(wanted),
                    }
                }
            }
            bits = next;
        }
        Err(NoBall::TooWide)
    }

    fn has_roots(&self, expression: ExprId) -> bool {
        let mut found = false;
        self.each_reachable(&[expression], |id| {
            if let Node::Product { factors, .. } = self.node(id) {
                found |= factors.iter().any(|(_, exponent)| !exponent.is_integer());
            }
            !found
        });
        found
    }

    /// Whether there are roots in the expression, of more than numbers, that are proved to be independent.
    fn has_independent_roots(&self, expression: ExprId) -> bool {
        let roots = [expression];
        let division = self.angle_division(&roots);
        let pass = |point| FieldPass::new(self, point, division);
        self.independent_roots(&roots, &[], pass, |_, _| None)
            .is_some_and(|found| !found.radicands.is_empty())
    }

    /// Whether the expression has a value at one of the points tried of the field, or may have one elsewhere.
    pub(crate) fn has_value(&self, expression: ExprId) -> bool {
        self.vanishes_in_field(expression, self.has_roots(expression)) != Err(NoValue::Here)
    }

    /// Whether the expression vanishes by what the field knows of functions as well, and not by their values on the reals
    /// alone, as `atan2(x, 1) − atan(x)` does: what is derived by no other identity can be proved in the field.
    pub(crate) fn vanishes_by_identity(&self, expression: ExprId) -> bool {
        self.zero_test(expression).is_zero() && !self.zeros_by_values.borrow().contains(&expression)
    }

    /// The verdict on what vanishes by its values.
    fn zero_by_values(&self, expression: ExprId) -> Verdict {
        self.zeros_by_values.borrow_mut().insert(expression);
        Verdict::Zero
    }

    /// Whether the expression vanishes at every point tried of the field.
    fn vanishes_in_field(&self, expression: ExprId, has_roots: bool) -> Result<bool, NoValue> {
        let wanted = if has_roots { POINTS_WITH_ROOTS } else { POINTS };
        let mut seen = 0;
        let mut radicands = None;
        for seed in 0..wanted * PATIENCE {
            if seen == 0 && seed == WITHOUT_VALUE {
                break;
            }
            // where few points have roots for all radicands, those to come are chosen so that they have
            let point = if has_roots && seed >= PATIENCE && seen < seed / 8 {
                let radicands = radicands.get_or_insert_with(|| Radicands::of(self, &[expression], &[]));
                radicands.point(self, seed)
            } else {
                FieldPoint::random(seed)
            };
            match self.evaluate_in_field(&[expression], &point) {
                Ok(values) if values[0] != super::field::Residue::ZERO => return Ok(false),
                Ok(_) => seen += 1,
                Err(NoValue::Here) => {}
                Err(ever) => return Err(ever),
            }
            if seen == wanted
                || has_roots
                    && seen == POINTS_WITH_INDEPENDENT_ROOTS
                    && self.has_independent_roots(expression)
            {
                return Ok(true);
            }
        }
        Err(NoValue::Here)
    }

    /// The verdict with a witness for which facts hold: without any, what is not zero elsewhere may be so where they do.
    #[must_use]
    pub(crate) fn verdict_under(&self, expression: ExprId, facts: &Facts, verdict: Verdict) -> Verdict {
        let Verdict::NonZero(witness) = &verdict else { return verdict };
        if self.hold_at(facts, &witness.point) {
            return verdict;
        }
        let assumed: Vec<ExprId> = facts.expressions.keys().copied().collect();
        let mut symbols = self.symbols_in(&[&assumed[..], &[expression]].concat());
        let further: Vec<SymbolId> =
            facts.symbols.keys().filter(|symbol| !symbols.contains(symbol)).copied().collect();
        symbols.extend(further);
        let found = (0..WITNESSES_UNDER_FACTS).find_map(|attempt| {
            let point = point_of(&symbols, attempt);
            let result = self.evaluate(&[expression], |symbol| value_at(&point, symbol))[0];
            (self.hold_at(facts, &point) && result.is_certainly_nonzero())
                .then_some(Witness { value: result.value, point })
        });
        match found {
            Some(witness) => Verdict::NonZero(witness),
            None => Verdict::Unknown(
                "it is not zero everywhere, but no point was found where it is not and the \
                                      assumptions hold"
                    .into(),
            ),
        }
    }

    /// A point with short numbers where the expression is certainly not zero.
    #[must_use]
    pub fn witness(&self, expression: ExprId) -> Option<Witness> {
        let symbols = self.symbols_in(&[expression]);
        for attempt in 0..WITNESSES {
            let point = point_of(&symbols, attempt);
            let result = self.evaluate(&[expression], |symbol| value_at(&point, symbol))[0];
            if result.is_certainly_nonzero() {
                return Some(Witness { value: result.value, point });
            }
        }
        None
    }
}

/// Short numbers for symbols.
fn point_of(symbols: &[SymbolId], attempt: u64) -> Vec<(SymbolId, f64)> {
    symbols.iter().enumerate().map(|(i, symbol)| (*symbol, sample(attempt, i))).collect()
}

/// The number for a symbol.
fn value_at(point: &[(SymbolId, f64)], symbol: SymbolId) -> f64 {
    point.iter().find(|(known, _)| *known == symbol).map_or(f64::NAN, |(_, value)| *value)
}

/// Values of one or two digits: first positive and of order one, then smaller, then of both signs.
pub(crate) fn sample(attempt: u64, index: usize) -> f64 {
    let word = super::field::Residue::mixed(attempt, index as u64).word();
    let tenths = f64::from(u16::try_from(word % 16).unwrap_or(0));
    match attempt % 4 {
        0 => (tenths + 5.0) / 10.0,
        1 => (tenths + 1.0) / 20.0,
        2 => (tenths - 7.5) / 5.0,
        _ => (tenths + 1.0) / 4.0,
    }
}

#[cfg(test)]
mod zero_test_tests;

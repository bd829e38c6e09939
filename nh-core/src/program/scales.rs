//! Sums take the scale at which they are used.
//!
//! `½ (a − 2 h) w` is `(½ a − h) w`: a power of two that multiplies a product with a sum in it goes into the sum, where it
//! costs nothing, as terms of a sum are multiplied and added in one step. A factor 2^k changes no digit of what it
//! multiplies. That is done for sums of which more products lose their number by it than get one.

use super::nary::{Arena, Nary, Source, System, Term};
use crate::algebra::Rational;
use crate::id::Id;

/// Larger powers are left where they are: intermediate results go over where they went over before, but for so many
/// binary digits.
const LARGEST: i32 = 8;

/// How many times a term is doubled.
type Shift = i32;

/// So many multiplications have to be saved: the search for shared work that follows saves one as often as not.
const WORTH_IT: usize = 2;

/// The same arena with sums at other scales.
pub(super) fn scaled(arena: &Arena) -> Option<Arena> {
    let is_power = |(base, _): &(Term, i32)| {
        arena.as_number(*base).and_then(exponent_of_two).is_some_and(|exponent| exponent != 0)
    };
    let is_sum = |(base, _): &(Term, i32)| matches!(arena.get(*base), Nary::Sum(_));
    let candidates =
        arena.products().filter(|factors| factors.iter().any(is_sum) && factors.iter().any(is_power));
    if candidates.count() < WORTH_IT {
        return None;
    }
    let order = arena.operands_first(&arena.outputs);
    let mut scales = Scales::of(arena, &order);
    let saved: usize = order.iter().rev().map(|term| scales.settle(*term)).sum();
    (saved >= WORTH_IT).then(|| scales.rebuilt(&order))
}

/// The exponent of a power of two.
fn exponent_of_two(number: &Rational) -> Option<Shift> {
    let (numerator, denominator) = number.to_small()?;
    let is_power = |number: i64| number > 0 && number & (number - 1) == 0;
    let exponent = |power: i64| power.trailing_zeros().cast_signed();
    (is_power(numerator) && is_power(denominator)).then(|| exponent(numerator) - exponent(denominator))
}

/// A power of two.
fn power(exponent: Shift) -> Rational {
    let magnitude = 1_i64 << exponent.unsigned_abs().min(62);
    if exponent < 0 { Rational::new(1, magnitude) } else { Rational::from(magnitude) }
}

/// A use of a sum as a factor of a product that is needed at some scale.
#[derive(Clone, Copy, Debug)]
struct Use {
    /// The place of the product among those that are wanted.
    product: usize,
    /// The exponent of the sum in it.
    exponent: i32,
}

/// A product at a scale.
#[derive(Clone, Copy, Debug)]
struct Wanted {
    /// The power of two that is left before it, if its number is one.
    shift: Option<Shift>,
    /// Whether it has several factors beside its number.
    is_long: bool,
}

/// The scales of sums, decided one after the other, uses first.
struct Scales<'a> {
    arena: &'a Arena,
    /// How many times each sum is doubled.
    shifts: Vec<Shift>,
    /// Whether something else than sums and products uses a term, which takes it as it is.
    is_used_as_it_is: Vec<bool>,
    wanted: Vec<Wanted>,
    /// The products in which each sum is a factor.
    uses: Vec<Vec<Use>>,
}

impl<'a> Scales<'a> {
    fn of(arena: &'a Arena, order: &[Term]) -> Self {
        let mut scales = Self {
            arena,
            shifts: vec![0; arena.len()],
            is_used_as_it_is: vec![false; arena.len()],
            wanted: Vec::new(),
            uses: vec![Vec::new(); arena.len()],
        };
        let mut operands = Vec::new();
        for term in order {
            operands.clear();
            arena.dependencies(*term, &mut operands);
            let takes_any = |operand: &Term| {
                matches!(
                    (arena.get(*term), arena.get(*operand)),
                    (Nary::Sum(_), _) | (Nary::Product(_), Nary::Sum(_))
                )
            };
            for operand in operands.iter().filter(|operand| !takes_any(operand)) {
                scales.is_used_as_it_is[operand.index()] = true;
            }
        }
        arena.outputs.iter().for_each(|output| scales.is_used_as_it_is[output.index()] = true);
        scales
    }

    /// Notes that a product is wanted, doubled so many times.
    fn want(&mut self, term: Term, by: Shift) {
        let Nary::Product(factors) = self.arena.get(term) else { return };
        let mut shift = Some(by);
        let mut others = 0;
        for (base, exponent) in factors.iter() {
            match self.arena.as_number(*base) {
                Some(number) if *exponent == 1 => {
                    shift = exponent_of_two(number).map(|exponent| exponent + by);
                }
                _ => others += 1,
            }
        }
        let product = self.wanted.len();
        self.wanted.push(Wanted { shift, is_long: others > 1 });
        for (base, exponent) in factors.iter() {
            if matches!(self.arena.get(*base), Nary::Sum(_)) {
                self.uses[base.index()].push(Use { product, exponent: *exponent });
            }
        }
    }

    /// Decides the scale of a sum, or at which scale a product is wanted; how many multiplications that saves.
    fn settle(&mut self, term: Term) -> usize {
        match self.arena.get(term) {
            Nary::Product(_) => {
                if self.is_used_as_it_is[term.index()] {
                    self.want(term, 0);
                }
                0
            }
            Nary::Sum(operands) => {
                let (by, saved) = self.best(term, operands);
                self.shifts[term.index()] = by;
                for Use { product, exponent } in std::mem::take(&mut self.uses[term.index()]) {
                    let wanted = &mut self.wanted[product];
                    wanted.shift = wanted.shift.map(|shift| shift - by * exponent);
                }
                for (operand, _) in operands.iter() {
                    self.want(*operand, by);
                }
                saved
            }
            _ => 0,
        }
    }

    /// The scale of a sum with which the fewest products have a power of two as a factor, and how many fewer.
    fn best(&self, term: Term, operands: &[(Term, bool)]) -> (Shift, usize) {
        let uses = &self.uses[term.index()];
        let cost = |by: Shift| {
            let of_use = |Use { product, exponent }: &Use| {
                let Wanted { shift, is_long } = self.wanted[*product];
                usize::from(is_long && shift.is_some_and(|shift| shift != by * exponent))
            };
            let of_operand = |(operand, _): &(Term, bool)| self.cost_as_operand(*operand, by);
            let as_it_is = usize::from(by != 0 && self.is_used_as_it_is[term.index()]);
            as_it_is
                + uses.iter().map(of_use).sum::<usize>()
                + operands.iter().map(of_operand).sum::<usize>()
                + usize::from(!operands.iter().any(|(operand, _)| self.is_unit(*operand, by)))
        };
        let before = cost(0);
        let mut best = (before, 0);
        for Use { product, exponent } in uses {
            let Some(shift) = self.wanted[*product].shift else { continue };
            let by = shift / exponent;
            if by * exponent == shift && by != 0 && by.abs() <= LARGEST {
                let found = cost(by);
                if found < best.0 {
                    best = (found, by);
                }
            }
        }
        (best.1, before - best.0)
    }

    /// Whether a product of a sum has to be multiplied by a power of two if the sum is doubled so many times. One with a
    /// sum in it is counted as if that took it over.
    fn cost_as_operand(&self, operand: Term, by: Shift) -> usize {
        let Nary::Product(factors) = self.arena.get(operand) else { return 0 };
        let mut shift = Some(by);
        let mut others = 0;
        for (base, exponent) in factors.iter() {
            match (self.arena.as_number(*base), self.arena.get(*base)) {
                (Some(number), _) if *exponent == 1 => {
                    shift = exponent_of_two(number).map(|exponent| exponent + by);
                }
                (_, Nary::Sum(_)) => return 0,
                _ => others += 1,
            }
        }
        usize::from(others > 1 && shift.is_some_and(|shift| shift != 0))
    }

    /// Whether an operand of a sum is added as it is if the sum is doubled so many times.
    fn is_unit(&self, operand: Term, by: Shift) -> bool {
        let number = match self.arena.get(operand) {
            Nary::Number(_) => return true,
            Nary::Product(factors) => {
                factors.iter().find_map(|(base, _)| self.arena.as_number(*base)).map(exponent_of_two)
            }
            _ => None,
        };
        number.unwrap_or(Some(0)).is_some_and(|shift| shift + by == 0)
    }

    /// The arena with sums at these scales.
    fn rebuilt(&self, order: &[Term]) -> Arena {
        let mut into = Arena::default();
        into.parameters.clone_from(&self.arena.parameters);
        into.nameless.clone_from(&self.arena.nameless);
        let mut rebuilt = Rebuilt { scales: self, into, images: vec![None; self.arena.len()] };
        for term in order {
            let image = rebuilt.image_of(*term);
            rebuilt.images[term.index()] = Some(image);
        }
        rebuilt.finish()
    }
}

struct Rebuilt<'a> {
    scales: &'a Scales<'a>,
    into: Arena,
    /// Terms of the new arena, those of sums at their scale.
    images: Vec<Option<Term>>,
}

impl Rebuilt<'_> {
    fn image(&self, term: Term) -> Term {
        self.images[term.index()].expect("operands come first")
    }

    /// A term at the scale that it had.
    fn restored(&mut self, term: Term) -> Term {
        self.times(term, 0)
    }

    /// A term, doubled so many times.
    fn times(&mut self, term: Term, by: Shift) -> Term {
        let arena = self.scales.arena;
        match arena.get(term) {
            Nary::Number(number) => self.into.number(number.clone() * power(by)),
            Nary::Product(factors) => self.product(factors, by),
            _ => self.product(&[(term, 1)], by),
        }
    }

    /// A product, doubled so many times.
    fn product(&mut self, factors: &[(Term, i32)], mut by: Shift) -> Term {
        let mut list = Vec::with_capacity(factors.len() + 1);
        for (base, exponent) in factors {
            by -= self.scales.shifts[base.index()] * exponent;
            list.push((self.image(*base), *exponent));
        }
        if by != 0 {
            list.push((self.into.number(power(by)), 1));
        }
        self.into.product(list)
    }

    fn image_of(&mut self, term: Term) -> Term {
        let arena = self.scales.arena;
        let nary = match arena.get(term) {
            nary @ (Nary::Number(_) | Nary::Pi | Nary::Constant(..) | Nary::Symbol(_)) => nary.clone(),
            Nary::Sum(operands) => {
                let by = self.scales.shifts[term.index()];
                let mut scaled: Vec<(Term, bool)> = operands
                    .iter()
                    .map(|(operand, negative)| (self.times(*operand, by), *negative))
                    .collect();
                scaled.sort_unstable();
                Nary::Sum(scaled.into())
            }
            Nary::Product(factors) => return self.product(factors, 0),
            Nary::Quotient(a, b) => Nary::Quotient(self.restored(*a), self.restored(*b)),
            Nary::Power(a, exponent) => Nary::Power(self.restored(*a), *exponent),
            Nary::Neg(a) => Nary::Neg(self.restored(*a)),
            Nary::Recip(a) => Nary::Recip(self.restored(*a)),
            Nary::Sqrt(a) => Nary::Sqrt(self.restored(*a)),
            Nary::Cbrt(a) => Nary::Cbrt(self.restored(*a)),
            Nary::PowReal(a, exponent) => Nary::PowReal(self.restored(*a), exponent.clone()),
            Nary::Apply(function, a) => Nary::Apply(*function, self.restored(*a)),
            Nary::Apply2(function, a, b) => Nary::Apply2(*function, self.restored(*a), self.restored(*b)),
        };
        self.into.intern(nary)
    }

    /// What the symbols, the calls, the systems and the outputs are made of.
    fn finish(mut self) -> Arena {
        let arena = self.scales.arena;
        let all = |rebuilt: &mut Self, terms: &[Term]| -> Vec<Term> {
            terms.iter().map(|term| rebuilt.restored(*term)).collect()
        };
        self.into.outputs = all(&mut self, &arena.outputs);
        for call in &arena.calls {
            let arguments = all(&mut self, &call.arguments);
            self.into.calls.push(super::nary::Call { method: call.method.clone(), arguments });
        }
        for System { matrix, right } in &arena.systems {
            let matrix = matrix.iter().map(|row| all(&mut self, row)).collect();
            let right = all(&mut self, right);
            self.into.systems.push(System { matrix, right });
        }
        let mut sources: Vec<_> = arena.sources.iter().collect();
        sources.sort_unstable_by_key(|(symbol, _)| **symbol);
        for (symbol, source) in sources {
            let source = match source {
                Source::Value(value) => Source::Value(self.restored(*value)),
                source => *source,
            };
            self.into.sources.insert(*symbol, source);
        }
        self.into
    }
}

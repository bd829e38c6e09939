//! Sums and products of any number of operands, on which the search for shared work runs.

use crate::algebra::{Function, Function2, Rational};
use crate::id::{ConstantId, Id, SymbolId, Table, ids};
use crate::limits;
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::hash_map::Entry;
use std::rc::Rc;

ids! {
    /// An expression of the arena.
    pub(super) struct Term;
}

/// What a term is made of.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) enum Nary {
    Number(Rational),
    Pi,
    /// A number that has a name, an operand like a symbol until it is folded.
    Constant(ConstantId, Rational),
    /// A symbol; one with a definition is an opaque operand.
    Symbol(SymbolId),
    /// Operands ascend; the flag says that one is subtracted.
    Sum(Rc<[(Term, bool)]>),
    /// Bases ascend, exponents are not zero; after the denominators are gathered, they are positive.
    /// A numeric coefficient is a base like any other.
    Product(Rc<[(Term, i32)]>),
    /// `numerator / denominator`, after the denominators are gathered.
    Quotient(Term, Term),
    /// `base^exponent` with a high exponent, after the denominators are gathered.
    Power(Term, u32),
    Neg(Term),
    Recip(Term),
    Sqrt(Term),
    Cbrt(Term),
    PowReal(Term, Rational),
    Apply(Function, Term),
    Apply2(Function2, Term, Term),
}

/// Where a symbol with a definition gets its value.
#[derive(Clone, Copy, Debug)]
pub(super) enum Source {
    /// The value of a term.
    Value(Term),
    /// The result of a method call.
    Call(usize),
    /// An unknown of a linear system.
    Unknown { system: usize, component: usize },
}

/// A call of a method of the user's.
#[derive(Clone, Debug)]
pub(super) struct Call {
    pub(super) method: String,
    pub(super) arguments: Vec<Term>,
}

/// A linear system.
#[derive(Clone, Debug)]
pub(super) struct System {
    pub(super) matrix: Vec<Vec<Term>>,
    pub(super) right: Vec<Term>,
}

/// The terms of one procedure.
#[derive(Clone, Debug, Default)]
pub(super) struct Arena {
    terms: Table<Term, Nary>,
    known: FxHashMap<Nary, Term>,
    pub(super) sources: FxHashMap<SymbolId, Source>,
    pub(super) calls: Vec<Call>,
    pub(super) systems: Vec<System>,
    pub(super) outputs: Vec<Term>,
    /// Symbols that do not change while a system moves.
    pub(super) parameters: FxHashSet<SymbolId>,
    /// Symbols of intermediate results that nobody has named.
    pub(super) nameless: FxHashSet<SymbolId>,
}

/// The sum of two exponents, if it and its opposite fit.
fn exponents_together(first: i32, second: i32) -> Option<i32> {
    first.checked_add(second).filter(|sum| *sum != i32::MIN)
}

impl Arena {
    pub(super) fn intern(&mut self, nary: Nary) -> Term {
        match self.known.entry(nary) {
            Entry::Occupied(known) => *known.get(),
            Entry::Vacant(new) => {
                let term = self.terms.push(new.key().clone());
                *new.insert(term)
            }
        }
    }

    pub(super) fn find(&self, nary: &Nary) -> Option<Term> {
        self.known.get(nary).copied()
    }

    pub(super) fn get(&self, term: Term) -> &Nary {
        &self.terms[term]
    }

    pub(super) fn len(&self) -> usize {
        self.terms.len()
    }

    /// Whether two arenas for the same procedure have come to the same terms.
    pub(super) fn computes_alike(&self, other: &Self) -> bool {
        self.len() == other.len() && self.terms.iter().eq(other.terms.iter())
    }

    /// Gives a term another form of the same value.
    pub(super) fn rewrite(&mut self, term: Term, nary: Nary) {
        self.known.entry(nary.clone()).or_insert(term);
        self.terms[term] = nary;
    }

    pub(super) fn number(&mut self, value: Rational) -> Term {
        self.intern(Nary::Number(value))
    }

    /// `Π base^exponent`; bases may repeat.
    pub(super) fn product(&mut self, factors: Vec<(Term, i32)>) -> Term {
        match self.product_form(factors) {
            Nary::Product(factors) if matches!(*factors, [(_, 1)]) => factors[0].0,
            nary => self.intern(nary),
        }
    }

    /// The form of a product: equal bases are merged, coefficients multiplied.
    pub(super) fn product_form(&mut self, mut factors: Vec<(Term, i32)>) -> Nary {
        limits::spend(1 + factors.len());
        let mut coefficient = Rational::ONE;
        factors.retain(|(base, exponent)| match self.as_number(*base) {
            Some(value) if *exponent == 1 => {
                coefficient = coefficient.clone() * value.clone();
                false
            }
            _ => true,
        });
        if factors.is_empty() {
            return Nary::Number(coefficient);
        }
        if !coefficient.is_one() {
            factors.push((self.number(coefficient), 1));
        }
        factors.sort_unstable_by_key(|(base, _)| *base);
        let mut merged: Vec<(Term, i32)> = Vec::with_capacity(factors.len());
        for (base, exponent) in factors {
            match merged.last_mut() {
                // two powers whose exponents together overflow stay apart
                Some((last, sum)) if *last == base => match exponents_together(*sum, exponent) {
                    Some(together) => *sum = together,
                    None => merged.push((base, exponent)),
                },
                _ => merged.push((base, exponent)),
            }
        }
        merged.retain(|(_, exponent)| *exponent != 0);
        if merged.is_empty() { Nary::Number(Rational::ONE) } else { Nary::Product(merged.into()) }
    }

    /// The sum of signed operands, at least one and all different, up to the sign in front, which is
    /// taken out so that the first operand is added.
    pub(super) fn sum(&mut self, mut operands: Vec<(Term, bool)>) -> (Term, bool) {
        limits::spend(1 + operands.len());
        operands.sort_unstable();
        let negative = operands[0].1;
        if let [(only, _)] = *operands {
            return (only, negative);
        }
        for operand in &mut operands {
            operand.1 ^= negative;
        }
        (self.intern(Nary::Sum(operands.into())), negative)
    }

    /// The factors of all products.
    pub(super) fn products(&self) -> impl Iterator<Item = &[(Term, i32)]> {
        self.terms.iter().filter_map(|nary| match nary {
            Nary::Product(factors) => Some(&**factors),
            _ => None,
        })
    }

    pub(super) fn as_number(&self, term: Term) -> Option<&Rational> {
        match self.get(term) {
            Nary::Number(value) => Some(value),
            _ => None,
        }
    }

    /// Appends what has to be computed before a term, definitions of symbols included.
    pub(super) fn dependencies(&self, term: Term, list: &mut Vec<Term>) {
        match self.get(term) {
            Nary::Number(_) | Nary::Pi | Nary::Constant(..) => {}
            Nary::Symbol(symbol) => match self.sources.get(symbol) {
                None => {}
                Some(Source::Value(value)) => list.push(*value),
                Some(Source::Call(call)) => list.extend(&self.calls[*call].arguments),
                Some(Source::Unknown { system, .. }) => {
                    let System { matrix, right } = &self.systems[*system];
                    list.extend(matrix.iter().flatten().chain(right));
                }
            },
            // plain loops: every pass over the terms asks for their operands
            Nary::Sum(operands) => {
                let (operands, mut place): (&[(Term, bool)], usize) = (operands, 0);
                while place < operands.len() {
                    list.push(operands[place].0);
                    place += 1;
                }
            }
            Nary::Product(factors) => {
                let (factors, mut place): (&[(Term, i32)], usize) = (factors, 0);
                while place < factors.len() {
                    list.push(factors[place].0);
                    place += 1;
                }
            }
            Nary::Quotient(a, b) | Nary::Apply2(_, a, b) => {
                list.push(*a);
                list.push(*b);
            }
            Nary::Power(a, _)
            | Nary::Neg(a)
            | Nary::Recip(a)
            | Nary::Sqrt(a)
            | Nary::Cbrt(a)
            | Nary::PowReal(a, _)
            | Nary::Apply(_, a) => list.push(*a),
        }
    }

    /// Which terms the outputs depend on, and by how many others (or outputs) each is used.
    pub(super) fn uses(&self) -> Vec<u32> {
        let mut counts: Vec<u32> = vec![0; self.len()];
        let uses: &mut [u32] = &mut counts;
        // every use once; what a term depends on is listed at its first
        let mut open: Vec<Term> = Vec::with_capacity(self.len());
        open.extend(&self.outputs);
        let mut terms = 0;
        while let Some(term) = open.pop() {
            uses[term.index()] += 1;
            if uses[term.index()] == 1 {
                terms += 1;
                self.dependencies(term, &mut open);
            }
        }
        limits::spend(terms);
        counts
    }

    /// `roots` and the terms that they depend on, each after its operands.
    pub(super) fn operands_first(&self, roots: &[Term]) -> Vec<Term> {
        let mut seen = vec![false; self.len()];
        let seen: &mut [bool] = &mut seen;
        let mut order = Vec::with_capacity(self.len());
        let mut operands = Vec::new();
        let mut open: Vec<(Term, bool)> = Vec::with_capacity(self.len());
        open.extend(roots.iter().rev().map(|term| (*term, false)));
        let mut steps = 0;
        while let Some((term, ready)) = open.pop() {
            if ready {
                order.push(term);
            } else if !seen[term.index()] {
                seen[term.index()] = true;
                open.push((term, true));
                operands.clear();
                self.dependencies(term, &mut operands);
                let (operands, mut place): (&[Term], usize) = (&operands, operands.len());
                steps += 1 + place / 2;
                while place > 0 {
                    place -= 1;
                    if !seen[operands[place].index()] {
                        open.push((operands[place], false));
                    }
                }
            }
        }
        limits::spend(steps);
        order
    }

    /// The terms in order of their ids that are used, by a count of [`Self::uses`].
    pub(super) fn live(uses: &[u32]) -> Vec<Term> {
        (0..uses.len()).filter(|index| uses[*index] > 0).map(Term::from_index).collect()
    }
}

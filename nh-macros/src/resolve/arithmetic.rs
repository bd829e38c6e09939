//! Sums, products and powers of expressions, with limits on the size of what is built.

use nonholonomic_core::algebra::{Node, Rational};
use nonholonomic_core::id::ExprId;

use super::reports::Outcome;
use super::resolver::Resolver;
use crate::report::Diagnostic;
use crate::syntax::ast::Expr;
use crate::syntax::limits;

/// Bits of a number: what a literal may have, and a result.
const BITS: u64 = 4096;
/// Numerator and denominator of an exponent that products and powers of powers add up to.
const STEEP: i64 = 1_000_000;
/// Bits of the numbers that are combined in one go.
const TOGETHER: u64 = 2 * BITS;

impl Resolver {
    /// `Σ coefficient · term`, of terms that have the same unit.
    pub(super) fn sum_of(&mut self, at: &Expr, terms: Vec<(Rational, ExprId)>) -> Outcome<ExprId> {
        self.terms_are_alike(at, &terms);
        self.combination_of(at, terms)
    }

    /// `Σ coefficient · term`
    pub(super) fn combination_of(&mut self, at: &Expr, terms: Vec<(Rational, ExprId)>) -> Outcome<ExprId> {
        let mut constant = Rational::ZERO;
        let mut chunk: Vec<(Rational, ExprId)> = Vec::new();
        let mut bits = 0;
        for (coefficient, term) in terms {
            if let Some(number) = self.graph.as_number(term) {
                constant = constant + coefficient * number.clone();
                self.check_length(at, large(&constant), 1)?;
                continue;
            }
            let more = self.bits(term);
            if bits + more > TOGETHER {
                let sum = self.graph.linear_combination(&chunk);
                let sum = self.checked(at, sum, chunk.len())?;
                bits = self.bits(sum);
                chunk = vec![(Rational::ONE, sum)];
            }
            bits += more;
            chunk.push((coefficient, term));
        }
        if !constant.is_zero() || chunk.is_empty() {
            chunk.push((Rational::ONE, self.graph.number(constant)));
        }
        let sum = match chunk.as_slice() {
            [(coefficient, only)] if coefficient.is_one() => return Ok(*only),
            chunk => self.graph.linear_combination(chunk),
        };
        self.checked(at, sum, chunk.len())
    }

    /// `Σ a_i b_i`
    pub(super) fn inner_product(&mut self, at: &Expr, a: &[ExprId], b: &[ExprId]) -> Outcome<ExprId> {
        let mut terms = Vec::with_capacity(a.len());
        for (a, b) in a.iter().zip(b) {
            terms.push((Rational::ONE, self.product_of(at, &[(*a, Rational::ONE), (*b, Rational::ONE)])?));
        }
        self.sum_of(at, terms)
    }

    /// `a · b`
    pub(super) fn times(&mut self, at: &Expr, a: ExprId, b: ExprId) -> Outcome<ExprId> {
        self.product_of(at, &[(a, Rational::ONE), (b, Rational::ONE)])
    }

    /// `Π base^exponent`
    pub(super) fn product_of(&mut self, at: &Expr, factors: &[(ExprId, Rational)]) -> Outcome<ExprId> {
        let mut chunk: Vec<(ExprId, Rational)> = Vec::new();
        let mut bits = 0;
        for (base, exponent) in factors {
            if let Node::Sum { terms, .. } = self.graph.node(*base) {
                // the common divisor of the coefficients is looked for
                let steps = terms.len();
                self.reports.spend(at.extent, steps)?;
            }
            let more = self.bits(*base);
            if bits + more > TOGETHER {
                let product = self.graph.product(&chunk);
                let product = self.checked(at, product, chunk.len())?;
                bits = self.bits(product);
                chunk = vec![(product, Rational::ONE)];
            }
            bits += more;
            chunk.push((*base, exponent.clone()));
        }
        let product = match chunk.as_slice() {
            [(only, exponent)] if exponent.is_one() => return Ok(*only),
            chunk => self.graph.product(chunk),
        };
        self.checked(at, product, chunk.len())
    }

    /// `base^exponent`, where the exponent stands at `written`.
    pub(super) fn power_of(
        &mut self,
        at: &Expr,
        base: ExprId,
        exponent: Rational,
        written: &Expr,
    ) -> Outcome<ExprId> {
        let limit = i64::from(limits::EXPONENT);
        match exponent.to_small() {
            Some((n, d)) if (-limit..=limit).contains(&n) && d <= limit => {
                self.product_of(at, &[(base, exponent)])
            }
            _ => {
                let error = Diagnostic::new(written.extent, "this exponent is too large").way_out(format!(
                    "exponents are fractions with numerator and denominator of at most {limit}"
                ));
                Err(self.report(written, error))
            }
        }
    }

    /// Charges for what was built of so many operands, and refuses numbers that grow without bound.
    pub(super) fn checked(&mut self, at: &Expr, built: ExprId, operands: usize) -> Outcome<ExprId> {
        let mut steep = false;
        let (entries, bits) = match self.graph.node(built) {
            Node::Number(value) => (1, large(value)),
            Node::Sum { constant, terms } => (terms.len(), largest(terms).max(large(constant))),
            Node::Product { coefficient, factors } => {
                steep = factors.iter().any(|(_, exponent)| is_steep(exponent));
                (factors.len(), large(coefficient))
            }
            _ => (1, 0),
        };
        self.reports.spend(at.extent, entries)?;
        self.check_length(at, bits, operands)?;
        if steep {
            let error = Diagnostic::new(at.extent, "an exponent in this expression becomes too large");
            return Err(self.report(at, error));
        }
        Ok(built)
    }

    /// Charges for arithmetic with long numbers, which takes the square of their length.
    fn check_length(&mut self, at: &Expr, bits: u64, operations: usize) -> Outcome<()> {
        if bits > BITS {
            let error = Diagnostic::new(at.extent, "the numbers in this expression become too long")
                .evidence(format!("one of them has more than {} digits", BITS * 3 / 10))
                .way_out("round them");
            return Err(self.report(at, error));
        }
        let words = usize::try_from(bits / 64).unwrap_or(0);
        self.reports.spend(at.extent, words * words * operations)
    }

    /// A bound on the bits that a summand or factor adds to the longest number.
    fn bits(&self, id: ExprId) -> u64 {
        let of = |value: &Rational| if value.is_one() { 1 } else { large(value).max(128) };
        match self.graph.node(id) {
            Node::Number(value) => of(value),
            Node::Sum { constant, terms } => {
                terms.iter().map(|(_, coefficient)| of(coefficient)).max().unwrap_or(1).max(of(constant))
            }
            Node::Product { coefficient, .. } => of(coefficient),
            _ => 1,
        }
    }
}

/// Whether no honest expression has such an exponent.
fn is_steep(exponent: &Rational) -> bool {
    !exponent.to_small().is_some_and(|(n, d)| n.abs() <= STEEP && d <= STEEP)
}

/// The bits of a number, or 0 where it fits machine words.
fn large(value: &Rational) -> u64 {
    if value.to_small().is_some() { 0 } else { value.bits() }
}

fn largest(entries: &[(ExprId, Rational)]) -> u64 {
    entries.iter().map(|(_, value)| large(value)).max().unwrap_or(0)
}

//! Expressions read as polynomials over atoms: products are multiplied out, roots and
//! denominators become atoms with their base in normal form.

use super::polynomial::{Exponent, Kind, Monomial, Polynomial};
use crate::algebra::graph::{Function, Graph, Node};
use crate::algebra::number::Rational;
use crate::id::ExprId;
use rustc_hash::{FxBuildHasher, FxHashMap};
use std::cell::Cell;
use std::collections::BTreeMap;
use std::rc::Rc;

/// How far an expression is taken apart.
#[derive(Clone, Copy, Debug)]
pub(super) struct Style {
    /// Multiply out the positive powers of sums.
    pub(super) expand: bool,
    /// Apply the addition theorems.
    pub(super) angles: bool,
    /// Prefer the canonical form of trigonometric polynomials to a shorter one.
    pub(super) canonical: bool,
}

/// Reads expressions within a budget; every method that may exceed it returns an `Option`.
pub(super) struct Reader<'g> {
    pub(super) graph: &'g mut Graph,
    pub(super) style: Style,
    /// Multiplications of monomials that are left.
    pub(super) work: usize,
    /// Largest number of monomials of one polynomial.
    pub(super) monomials: usize,
    /// The common denominator of the coefficients of each term of an angle.
    pub(super) divisions: FxHashMap<ExprId, i64>,
    /// Whether a common denominator has grown after it was used.
    pub(super) stale: bool,
    /// Whether multiplying out would have read anything otherwise.
    pub(super) kept_sums: Cell<bool>,
    known: FxHashMap<ExprId, Rc<Polynomial>>,
    composites: BTreeMap<ExprId, Rc<Polynomial>>,
    depth: usize,
}

/// Expressions that appear while reading (`sin(acos x)`) are read in turn up to this depth.
const DEPTH: usize = 6;
/// Room for the subexpressions of most that are read.
const USUAL: usize = 24;
/// Denominators that a new denominator is divided by, to find common factors.
const FACTORS_TRIED: usize = 8;

impl<'g> Reader<'g> {
    pub(super) fn new(graph: &'g mut Graph, style: Style, work: usize, monomials: usize) -> Self {
        Self {
            graph,
            style,
            work,
            monomials,
            divisions: FxHashMap::default(),
            stale: false,
            kept_sums: Cell::new(false),
            known: FxHashMap::with_capacity_and_hasher(USUAL, FxBuildHasher),
            composites: BTreeMap::new(),
            depth: 0,
        }
    }

    /// Forgets what was read, but not the common denominators.
    pub(super) fn restart(&mut self) {
        self.known.clear();
        self.composites.clear();
        self.stale = false;
    }

    pub(super) fn spend(&mut self, work: usize) -> Option<()> {
        self.work = self.work.checked_sub(work)?;
        Some(())
    }

    /// The polynomial of an expression.
    pub(super) fn read(&mut self, root: ExprId) -> Option<Rc<Polynomial>> {
        let mut open = vec![root];
        while let Some(&id) = open.last() {
            if self.known.contains_key(&id) {
                open.pop();
                continue;
            }
            let before = open.len();
            open.extend(self.graph.node(id).operands().filter(|operand| !self.known.contains_key(operand)));
            if open.len() == before {
                let polynomial = self.read_node(id)?;
                self.known.insert(id, Rc::new(polynomial));
            }
        }
        self.known.get(&root).cloned()
    }

    /// A node whose operands have been read.
    fn read_node(&mut self, id: ExprId) -> Option<Polynomial> {
        self.spend(1)?;
        match self.graph.node(id).clone() {
            Node::Number(value) => Some(Polynomial::constant(value)),
            Node::Pi | Node::Symbol(_) => Some(plain(id)),
            Node::Sum { constant, terms } => {
                let mut sum = Polynomial::constant(constant);
                for (term, coefficient) in terms {
                    let term = self.known.get(&term)?.clone();
                    self.spend(term.len())?;
                    sum.add_scaled(&term, &coefficient);
                    self.fits(&sum)?;
                }
                Some(sum)
            }
            Node::Product { coefficient, factors } => {
                let mut product = Polynomial::constant(coefficient);
                for (base, exponent) in factors {
                    let base = self.known.get(&base)?.clone();
                    let power = self.power(&base, Exponent::of(&exponent)?)?;
                    product = self.multiply(&product, &power)?;
                }
                Some(product)
            }
            Node::Apply(function, x) => {
                let argument = self.known.get(&x)?.clone();
                let argument = self.tidy(&argument)?;
                self.read_function(function, &argument)
            }
            Node::Apply2(function, x, y) => {
                let (x, y) = (self.known.get(&x)?.clone(), self.known.get(&y)?.clone());
                let (x, y) = (self.tidy(&x)?, self.tidy(&y)?);
                let (x, y) = (self.expression(&x), self.expression(&y));
                let value = self.graph.apply2(function, x, y);
                self.read_value(value)
            }
        }
    }

    /// A function as one atom, its argument rebuilt.
    pub(super) fn read_opaque(&mut self, function: Function, argument: &Polynomial) -> Option<Polynomial> {
        let argument = self.expression(argument);
        let value = self.graph.apply(function, argument);
        self.read_value(value)
    }

    /// What a function with a rebuilt argument has become.
    pub(super) fn read_value(&mut self, value: ExprId) -> Option<Polynomial> {
        match self.graph.node(value).clone() {
            Node::Number(number) => Some(Polynomial::constant(number)),
            Node::Apply(..) | Node::Apply2(..) | Node::Symbol(_) | Node::Pi => Some(plain(value)),
            Node::Product { coefficient, factors } if factors.len() == 1 && factors[0].1.is_one() => {
                Some(Polynomial::term(Monomial::of(factors[0].0, Kind::Plain, Exponent::ONE), coefficient))
            }
            _ if self.depth < DEPTH => {
                self.depth += 1;
                let polynomial = self.read(value);
                self.depth -= 1;
                polynomial.map(|polynomial| (*polynomial).clone())
            }
            _ => Some(plain(value)),
        }
    }

    fn fits(&self, polynomial: &Polynomial) -> Option<()> {
        (polynomial.len() <= self.monomials).then_some(())
    }

    pub(super) fn multiply(&mut self, a: &Polynomial, b: &Polynomial) -> Option<Polynomial> {
        self.spend(a.len() * b.len())?;
        let settled = |monomial: &Monomial| {
            monomial.0.iter().all(|factor| self.is_settled(factor.kind, factor.exponent))
        };
        if a.is_one() && b.0.keys().all(settled) {
            self.fits(b)?;
            return Some(b.clone());
        }
        let mut product = Polynomial::default();
        for (m, c) in a.0.iter() {
            for (n, d) in b.0.iter() {
                let (monomial, coefficient) = (m.times(n)?, c.clone() * d.clone());
                if monomial.0.iter().all(|factor| self.is_settled(factor.kind, factor.exponent)) {
                    product.add_term(monomial, coefficient);
                } else {
                    let opened = self.open(&monomial, coefficient)?;
                    product.add(opened);
                }
            }
            self.fits(&product)?;
        }
        Some(product)
    }

    /// Whether an atom of this kind stays an atom under this exponent.
    fn is_settled(&self, kind: Kind, exponent: Exponent) -> bool {
        match kind {
            Kind::Plain => true,
            Kind::Number => exponent > Exponent::ZERO && exponent < Exponent::ONE,
            Kind::Product => !exponent.is_integer(),
            Kind::Sum => exponent < Exponent::ONE || !self.expands(),
        }
    }

    /// Replaces integer powers of composite atoms by what they stand for.
    fn open(&mut self, monomial: &Monomial, coefficient: Rational) -> Option<Polynomial> {
        let (settled, unsettled) = monomial.split(|factor| self.is_settled(factor.kind, factor.exponent));
        let mut result = Polynomial::term(settled, coefficient);
        for factor in unsettled.0 {
            let (whole, rest) = factor.exponent.floor();
            let rest = Polynomial::term(Monomial::of(factor.atom, factor.kind, rest), Rational::ONE);
            let power = match factor.kind {
                Kind::Plain => return None,
                Kind::Number => Polynomial::constant(self.graph.as_number(factor.atom)?.pow(whole.into())?),
                Kind::Product | Kind::Sum => {
                    let base = self.composites.get(&factor.atom)?.clone();
                    self.power(&base, Exponent::whole(whole))?
                }
            };
            result = self.multiply(&result, &power)?;
            result = self.multiply(&result, &rest)?;
        }
        Some(result)
    }

    /// Whether a positive power of a sum is multiplied out.
    fn expands(&self) -> bool {
        if !self.style.expand {
            self.kept_sums.set(true);
        }
        self.style.expand
    }

    /// A power of what has been read.
    pub(super) fn power(&mut self, base: &Polynomial, exponent: Exponent) -> Option<Polynomial> {
        if base.is_zero() {
            // a division by zero is left to the checks
            return (!exponent.is_negative()).then(Polynomial::default);
        }
        if let Some((monomial, coefficient)) = base.single() {
            return self.power_of_monomial(monomial, coefficient, exponent);
        }
        match exponent.integer() {
            Some(1) if self.expands() => Some(base.clone()),
            Some(times @ 2..) if self.expands() => {
                let mut product = base.clone();
                for _ in 1..times {
                    product = self.multiply(&product, base)?;
                }
                Some(product)
            }
            _ => self.power_of_sum(base, exponent),
        }
    }

    fn power_of_monomial(
        &mut self,
        monomial: &Monomial,
        coefficient: &Rational,
        exponent: Exponent,
    ) -> Option<Polynomial> {
        if let Some(times) = exponent.integer() {
            let power = Polynomial::constant(coefficient.pow(times.into())?);
            let monomial = Polynomial::term(monomial.power(exponent)?, Rational::ONE);
            return self.multiply(&power, &monomial);
        }
        if monomial.is_unit() {
            return self.power_of_number(coefficient, exponent);
        }
        // the identities of construction say which roots may be taken
        let inside = self.monomial_expression(monomial, coefficient);
        let value = self.graph.pow(inside, exponent.to_rational());
        let Node::Product { coefficient, factors } = self.graph.node(value).clone() else {
            return self.read_value(value);
        };
        let mut product = Polynomial::constant(coefficient);
        for (base, exponent) in factors {
            let exponent = Exponent::of(&exponent)?;
            let power = match self.graph.node(base).clone() {
                Node::Number(value) => self.power_of_number(&value, exponent)?,
                Node::Product { .. } => {
                    let meaning = self.read(base)?;
                    self.composites.insert(base, meaning);
                    Polynomial::term(Monomial::of(base, Kind::Product, exponent), Rational::ONE)
                }
                Node::Sum { .. } => {
                    let meaning = self.read(base)?;
                    self.power_of_sum(&meaning, exponent)?
                }
                _ => Polynomial::term(Monomial::of(base, Kind::Plain, exponent), Rational::ONE),
            };
            product = self.multiply(&product, &power)?;
        }
        Some(product)
    }

    /// A root of a positive number, as roots of its prime factors.
    fn power_of_number(&mut self, value: &Rational, exponent: Exponent) -> Option<Polynomial> {
        if let Some(times) = exponent.integer() {
            return value.pow(times.into()).map(Polynomial::constant);
        }
        let Some((numerator, denominator)) = value.to_small().filter(|(n, _)| *n > 0) else {
            let base = self.graph.number(value.clone());
            let root = self.graph.pow(base, exponent.to_rational());
            return Some(plain(root));
        };
        let mut product = Polynomial::one();
        for (number, sign) in [(numerator, 1), (denominator, -1)] {
            for (prime, times) in prime_powers(number) {
                let atom = self.graph.number(prime);
                let exponent = exponent.times(Exponent::whole(times * sign))?;
                let factor = Polynomial::term(Monomial::of(atom, Kind::Number, exponent), Rational::ONE);
                product = self.multiply(&product, &factor)?;
            }
        }
        Some(product)
    }

    /// A power of a sum as a power of its primitive part, which becomes an atom.
    fn power_of_sum(&mut self, base: &Polynomial, exponent: Exponent) -> Option<Polynomial> {
        let base = self.tidy(base)?;
        if base.len() < 2 {
            return self.power(&base, exponent);
        }
        if !exponent.is_integer() {
            let content = base.content();
            let outside = self.power_of_number(&content, exponent)?;
            let atom = self.atom_of_sum(base.scaled(&content.recip()?));
            let inside = Polynomial::term(Monomial::of(atom, Kind::Sum, exponent), Rational::ONE);
            return self.multiply(&outside, &inside);
        }
        let common = base.meet();
        let inverse = Polynomial::term(common.inverse(), Rational::ONE);
        let numerator = self.multiply(&base, &inverse)?;
        let numerator = self.reduce(&numerator)?;
        let (_, leading) = numerator.leading()?;
        let content = if leading.is_negative() { -numerator.content() } else { numerator.content() };
        let mut product = self.power_of_monomial(&common, &content, exponent)?;
        let mut rest = numerator.scaled(&content.recip()?);
        let known: Vec<_> =
            self.composites.iter().take(FACTORS_TRIED).map(|(a, p)| (*a, p.clone())).collect();
        for (atom, meaning) in known {
            while rest.len() > 1 && meaning.len() > 1 && meaning.len() <= rest.len() {
                let Some(quotient) = self.quotient(&rest, &meaning) else { break };
                let factor = Polynomial::term(Monomial::of(atom, Kind::Sum, exponent), Rational::ONE);
                product = self.multiply(&product, &factor)?;
                rest = quotient;
            }
        }
        let last = if let Some((monomial, coefficient)) = rest.single() {
            self.power_of_monomial(monomial, coefficient, exponent)?
        } else {
            let atom = self.atom_of_sum(rest);
            Polynomial::term(Monomial::of(atom, Kind::Sum, exponent), Rational::ONE)
        };
        self.multiply(&product, &last)
    }

    /// The atom that stands for a primitive sum.
    fn atom_of_sum(&mut self, sum: Polynomial) -> ExprId {
        let atom = self.plain_sum(&sum);
        self.composites.insert(atom, Rc::new(sum));
        atom
    }

    /// What a composite atom stands for.
    pub(super) fn meaning(&self, atom: ExprId) -> Option<Rc<Polynomial>> {
        self.composites.get(&atom).cloned()
    }

    /// Reduces trigonometric functions, then cancels denominators.
    pub(super) fn tidy(&mut self, polynomial: &Polynomial) -> Option<Polynomial> {
        if let Some((monomial, _)) = polynomial.single()
            && !monomial.0.iter().any(|factor| factor.kind == Kind::Sum && factor.exponent.is_negative())
        {
            return Some(polynomial.clone());
        }
        let reduced = self.reduce(polynomial)?;
        self.cancel(reduced)
    }
}

/// The atom that is the whole expression.
pub(super) fn plain(id: ExprId) -> Polynomial {
    Polynomial::term(Monomial::of(id, Kind::Plain, Exponent::ONE), Rational::ONE)
}

/// Prime factors with exponents; a cofactor without small factors counts as prime.
fn prime_powers(mut number: i64) -> Vec<(i64, i32)> {
    const TRIED: i64 = 1000;
    let mut powers = Vec::new();
    let mut divisor = 2;
    while divisor < TRIED && divisor * divisor <= number {
        let mut times = 0;
        while number % divisor == 0 {
            number /= divisor;
            times += 1;
        }
        if times > 0 {
            powers.push((divisor, times));
        }
        divisor += 1;
    }
    if number > 1 {
        powers.push((number, 1));
    }
    powers
}

//! Expressions read as polynomials over atoms: products are multiplied out, roots and
//! denominators become atoms with their base in normal form.

use super::monomial::{Exponent, Factor, Kind, Monomial};
use super::polynomial::Polynomial;
use crate::algebra::graph::Graph;
use crate::algebra::memory::{Asked, Style};
use crate::algebra::node::{Function, Node};
use crate::algebra::number::Rational;
use crate::id::ExprId;
use crate::id_map::IdMap;
use crate::limits;
use rustc_hash::FxHashMap;
use std::borrow::Cow;
use std::cell::Cell;
use std::collections::BTreeMap;
use std::rc::Rc;

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
    /// What the style was asked for.
    pub(super) asked: Cell<Asked>,
    known: IdMap<ExprId, Rc<Polynomial>>,
    /// What composite atoms stand for.
    pub(super) composites: BTreeMap<ExprId, Rc<Polynomial>>,
    depth: usize,
}

/// Expressions that appear while reading (`sin(acos x)`) are read in turn up to this depth.
const DEPTH: usize = 6;

impl<'g> Reader<'g> {
    pub(super) fn new(graph: &'g mut Graph, style: Style, work: usize, monomials: usize) -> Self {
        Self {
            graph,
            style,
            work,
            monomials,
            divisions: FxHashMap::default(),
            stale: false,
            asked: Cell::default(),
            known: IdMap::default(),
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
        limits::spend(work);
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
            Node::Pi | Node::Constant(_) | Node::Symbol(_) => Some(plain(id)),
            Node::Sum { constant, terms } => {
                let mut sum = Polynomial::constant(constant);
                for (term, coefficient) in terms.iter() {
                    let term = self.known.get(term)?.clone();
                    self.spend(term.len())?;
                    sum.add_scaled(&term, coefficient);
                    self.fits(&sum)?;
                }
                Some(sum)
            }
            Node::Product { coefficient, factors } => {
                let mut product = Polynomial::constant(coefficient);
                for (base, exponent) in factors.iter() {
                    let (meaning, exponent) = (self.known.get(base)?.clone(), Exponent::of(exponent)?);
                    let power = self.power_of((*base, &meaning), exponent)?;
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
            Node::Apply(..) | Node::Apply2(..) | Node::Symbol(_) | Node::Constant(_) | Node::Pi => {
                Some(plain(value))
            }
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
        for (a, b) in [(a, b), (b, a)] {
            if let Some(number) = a.as_number()
                && b.0.keys().all(|monomial| self.has_settled(monomial))
            {
                self.fits(b)?;
                return Some(b.scaled(number));
            }
        }
        let mut product = Polynomial::default();
        for (m, c) in a.0.iter() {
            for (n, d) in b.0.iter() {
                let (monomial, coefficient) = (m.times(n)?, c.clone() * d.clone());
                if self.has_settled(&monomial) {
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

    /// Whether all factors stay what they are.
    pub(super) fn has_settled(&self, monomial: &Monomial) -> bool {
        let factors: &[Factor] = &monomial.0;
        let mut place = 0;
        while place < factors.len() {
            let Factor { kind, exponent, .. } = factors[place];
            if !matches!(kind, Kind::Plain) && !self.is_settled(kind, exponent) {
                return false;
            }
            place += 1;
        }
        true
    }

    /// Replaces integer powers of composite atoms by what they stand for.
    pub(super) fn open(&mut self, monomial: &Monomial, coefficient: Rational) -> Option<Polynomial> {
        let (settled, unsettled) = monomial.split(|factor| self.is_settled(factor.kind, factor.exponent));
        let mut result = Polynomial::term(settled, coefficient);
        for factor in unsettled.0.iter() {
            let (whole, rest) = factor.exponent.floor();
            let rest = Polynomial::term(Monomial::of(factor.atom, factor.kind, rest), Rational::ONE);
            let power = match factor.kind {
                Kind::Plain => return None,
                Kind::Number => Polynomial::constant(self.graph.as_number(factor.atom)?.pow(whole.into())?),
                Kind::Product | Kind::Sum => {
                    let base = self.composites.get(&factor.atom)?.clone();
                    self.power(&base, Exponent::whole(whole))?.into_owned()
                }
            };
            result = self.multiply(&result, &power)?;
            result = self.multiply(&result, &rest)?;
        }
        Some(result)
    }

    /// Whether a positive power of a sum is multiplied out.
    pub(super) fn expands(&self) -> bool {
        self.asked.set(Asked { expand: true, ..self.asked.get() });
        self.style.expand
    }

    /// The atom that stands for a primitive sum.
    pub(super) fn atom_of_sum(&mut self, sum: Polynomial) -> ExprId {
        let atom = self.plain_sum(&sum);
        self.composites.insert(atom, Rc::new(sum));
        atom
    }

    /// What a composite atom stands for.
    pub(super) fn meaning(&self, atom: ExprId) -> Option<Rc<Polynomial>> {
        self.composites.get(&atom).cloned()
    }

    /// Reduces trigonometric functions, then cancels denominators.
    pub(super) fn tidy<'p>(&mut self, polynomial: &'p Polynomial) -> Option<Cow<'p, Polynomial>> {
        let is_tidy = match polynomial.single() {
            Some((monomial, _)) => {
                !monomial.0.iter().any(|factor| factor.kind == Kind::Sum && factor.exponent.is_negative())
            }
            None => !self.has_squares(polynomial) && !self.has_denominator(polynomial),
        };
        if is_tidy {
            return Some(Cow::Borrowed(polynomial));
        }
        let reduced = self.reduce(polynomial)?;
        self.cancel(reduced).map(Cow::Owned)
    }
}

/// The atom that is the whole expression.
pub(super) fn plain(id: ExprId) -> Polynomial {
    Polynomial::term(Monomial::of(id, Kind::Plain, Exponent::ONE), Rational::ONE)
}

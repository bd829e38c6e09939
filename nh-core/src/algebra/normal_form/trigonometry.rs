//! Addition theorems, and the one relation `cos² = 1 − sin²` (`cosh² = 1 + sinh²`) of each angle.

use super::monomial::{Exponent, Factor, Kind, Monomial};
use super::polynomial::Polynomial;
use super::reader::Reader;
use crate::algebra::memory::Asked;
use crate::algebra::node::{Function, Node};
use crate::algebra::number::Rational;
use crate::id::ExprId;
use num_integer::Integer;
use std::borrow::Cow;
use std::collections::BTreeSet;

/// Angles with more terms than this stay whole.
const TERMS: usize = 6;
/// Multiples of an angle beyond this stay whole.
const MULTIPLE: i64 = 12;
/// Common denominators beyond this are not sought.
const DIVISION: i64 = 24;

/// A cosine with its sine.
type Pair = (Polynomial, Polynomial);

/// The angle of a pair of atoms, and whether they are circular or hyperbolic.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Angle {
    cos: ExprId,
    sin: ExprId,
    circular: bool,
}

impl Angle {
    /// `σ` in `cos² = 1 + σ sin²`.
    fn sign(self) -> Rational {
        if self.circular { Rational::MINUS_ONE } else { Rational::ONE }
    }
}

impl Reader<'_> {
    /// A function of an argument in normal form.
    pub(super) fn read_function(&mut self, function: Function, argument: &Polynomial) -> Option<Polynomial> {
        let circular = match function {
            Function::Sin | Function::Cos => true,
            Function::Sinh | Function::Cosh | Function::Exp => false,
            _ => return self.read_opaque(function, argument),
        };
        self.asked.set(Asked { angles: true, ..self.asked.get() });
        if !self.style.angles || argument.len() > TERMS || argument.is_zero() {
            return self.read_opaque(function, argument);
        }
        let terms: Vec<_> = argument.0.iter().map(|(m, c)| (m.clone(), c.clone())).collect();
        if function == Function::Exp {
            let mut product = Polynomial::one();
            for (monomial, coefficient) in terms {
                let factor = self.exponential(&monomial, &coefficient)?;
                product = self.multiply(&product, &factor)?;
            }
            return Some(product);
        }
        let mut turned: Option<Pair> = None;
        for (monomial, coefficient) in terms {
            let pair = self.pair(&monomial, &coefficient, circular)?;
            turned = Some(match turned {
                None => pair,
                Some(turned) => self.rotate(&turned, &pair, circular)?,
            });
        }
        let (cos, sin) = turned?;
        Some(if matches!(function, Function::Sin | Function::Sinh) { sin } else { cos })
    }

    /// The division of a term of an angle, and the multiple that its coefficient then is.
    fn multiple(&mut self, term: ExprId, coefficient: &Rational) -> Option<(i64, i64)> {
        let (numerator, denominator) = coefficient.to_small()?;
        let before = self.divisions.get(&term).copied();
        let division = before.unwrap_or(1).lcm(&denominator);
        if division > DIVISION {
            return None;
        }
        if before != Some(division) {
            self.stale |= before.is_some();
            self.divisions.insert(term, division);
        }
        numerator.checked_mul(division / denominator).map(|times| (division, times))
    }

    fn exponential(&mut self, monomial: &Monomial, coefficient: &Rational) -> Option<Polynomial> {
        let term = self.monomial_expression(monomial, &Rational::ONE);
        let (part, times) = match self.multiple(term, coefficient) {
            Some((division, times)) => (Rational::new(1, division), times),
            None => (coefficient.clone(), 1),
        };
        let argument = self.graph.scale(part, term);
        let value = self.graph.apply(Function::Exp, argument);
        let value = self.read_value(value)?;
        self.power(&value, Exponent::whole(i16::try_from(times).ok()?)).map(Cow::into_owned)
    }

    /// Cosine and sine of one term of an angle.
    fn pair(&mut self, monomial: &Monomial, coefficient: &Rational, circular: bool) -> Option<Pair> {
        let term = self.monomial_expression(monomial, &Rational::ONE);
        let (part, times) = match self.multiple(term, coefficient) {
            // multiples of π have values of their own
            Some((division, times)) if times.abs() <= MULTIPLE && term != self.graph.pi() => {
                (Rational::new(1, division), times)
            }
            _ => (coefficient.clone(), 1),
        };
        let angle = self.graph.scale(part, term);
        let names = if circular { [Function::Cos, Function::Sin] } else { [Function::Cosh, Function::Sinh] };
        let [cos, sin] = names.map(|name| self.graph.apply(name, angle));
        let base = (self.read_value(cos)?, self.read_value(sin)?);
        let mut turned = base.clone();
        for _ in 1..times.abs() {
            turned = self.rotate(&turned, &base, circular)?;
        }
        if times < 0 {
            turned.1 = turned.1.scaled(&Rational::MINUS_ONE);
        }
        Some(turned)
    }

    fn rotate(&mut self, a: &Pair, b: &Pair, circular: bool) -> Option<Pair> {
        let (cc, ss) = (self.multiply(&a.0, &b.0)?, self.multiply(&a.1, &b.1)?);
        let (cs, sc) = (self.multiply(&a.0, &b.1)?, self.multiply(&a.1, &b.0)?);
        let (mut cos, mut sin) = (cc, cs);
        cos.add_scaled(&ss, &if circular { Rational::MINUS_ONE } else { Rational::ONE });
        sin.add_scaled(&sc, &Rational::ONE);
        Some((cos, sin))
    }

    /// Whether a sine or cosine occurs at least squared.
    pub(super) fn has_squares(&self, polynomial: &Polynomial) -> bool {
        use Function::{Cos, Cosh, Sin, Sinh};
        let is_square = |factor: &Factor| {
            matches!(factor.kind, Kind::Plain)
                && factor.exponent.is_at_least(2)
                && matches!(self.graph.node(factor.atom), Node::Apply(Sin | Cos | Sinh | Cosh, _))
        };
        polynomial.0.keys().any(|monomial| monomial.has(is_square))
    }

    /// The angles whose cosine or sine occurs at least squared.
    fn squared_angles(&mut self, polynomial: &Polynomial) -> Vec<Angle> {
        let mut arguments = BTreeSet::new();
        for factor in polynomial.0.keys().flat_map(|monomial| monomial.0.iter()) {
            if factor.kind == Kind::Plain && factor.exponent.is_at_least(2) {
                match *self.graph.node(factor.atom) {
                    Node::Apply(Function::Sin | Function::Cos, x) => _ = arguments.insert((true, x)),
                    Node::Apply(Function::Sinh | Function::Cosh, x) => _ = arguments.insert((false, x)),
                    _ => {}
                }
            }
        }
        let angle = |(circular, x)| {
            let (cos, sin) =
                if circular { (Function::Cos, Function::Sin) } else { (Function::Cosh, Function::Sinh) };
            let [cos, sin] = [cos, sin].map(|name| self.graph.intern(Node::Apply(name, x)));
            Angle { cos, sin, circular }
        };
        arguments.into_iter().map(angle).collect()
    }

    /// Applies `cos² = 1 − sin²`: the canonical form if the style asks for it, then whatever
    /// leaves fewer monomials.
    pub(super) fn reduce(&mut self, polynomial: &Polynomial) -> Option<Polynomial> {
        let mut result = polynomial.clone();
        if !self.has_squares(polynomial) {
            return Some(result);
        }
        let angles = self.squared_angles(polynomial);
        if self.style.canonical {
            for angle in &angles {
                result = self.eliminate(&result, *angle, true)?;
            }
        }
        for angle in &angles {
            for cosine in [true, false] {
                let other = self.eliminate(&result, *angle, cosine)?;
                if other.len() < result.len() {
                    result = other;
                }
            }
        }
        self.contract(result, &angles)
    }

    /// The polynomial with either side of every squared angle eliminated, for another attempt.
    pub(super) fn reduced_to(&mut self, polynomial: &Polynomial, cosine: bool) -> Option<Polynomial> {
        let mut result = polynomial.clone();
        for angle in self.squared_angles(polynomial) {
            result = self.eliminate(&result, angle, cosine)?;
        }
        Some(result)
    }

    /// Leaves at most first powers of the cosine (or else the sine) of an angle.
    fn eliminate(&mut self, polynomial: &Polynomial, angle: Angle, cosine: bool) -> Option<Polynomial> {
        let (gone, kept) = if cosine { (angle.cos, angle.sin) } else { (angle.sin, angle.cos) };
        let (sign, one) = (angle.sign(), if cosine { Rational::ONE } else { -angle.sign() });
        let square = Monomial::of(kept, Kind::Plain, Exponent::whole(2));
        let mut result = Polynomial::default();
        for (monomial, coefficient) in polynomial.0.iter() {
            let Some(power @ 2..) = monomial.exponent(gone).integer() else {
                result.add_term(monomial.clone(), coefficient.clone());
                continue;
            };
            let removed = Monomial::of(gone, Kind::Plain, Exponent::whole(power - power % 2));
            let mut product = Polynomial::term(monomial.over(&removed)?, coefficient.clone());
            for _ in 0..power / 2 {
                // times `σ kept² + 1` or `σ kept² − σ`
                self.spend(2 * product.len())?;
                let mut next = Polynomial::default();
                for (monomial, coefficient) in product.0 {
                    next.add_term(monomial.times(&square)?, coefficient.clone() * sign.clone());
                    next.add_term(monomial, coefficient * one.clone());
                }
                product = next;
            }
            result.add(product);
        }
        self.spend(polynomial.len())?;
        Some(result)
    }

    /// Adds multiples of `R (cos² − 1 − σ sin²)` as long as that leaves fewer monomials.
    fn contract(&mut self, mut polynomial: Polynomial, angles: &[Angle]) -> Option<Polynomial> {
        let two = Exponent::whole(2);
        let mut again = !angles.is_empty();
        while std::mem::take(&mut again) {
            for angle in angles {
                let squares = [angle.cos, angle.sin].map(|atom| Monomial::of(atom, Kind::Plain, two));
                let mut rests = BTreeSet::new();
                for monomial in polynomial.0.keys() {
                    for (atom, square) in [angle.cos, angle.sin].into_iter().zip(&squares) {
                        if monomial.exponent(atom) >= two {
                            rests.insert(monomial.over(square)?);
                        }
                    }
                }
                self.spend(rests.len())?;
                for rest in rests {
                    again |= contract_at(&mut polynomial, &rest, *angle, &squares)?;
                }
            }
        }
        Some(polynomial)
    }
}

/// One step of the contraction; whether it removed a monomial.
fn contract_at(
    polynomial: &mut Polynomial,
    rest: &Monomial,
    angle: Angle,
    [cos, sin]: &[Monomial; 2],
) -> Option<bool> {
    let places = [rest.clone(), rest.times(sin)?, rest.times(cos)?];
    let values = places.each_ref().map(|place| polynomial.0.get(place).cloned().unwrap_or(Rational::ZERO));
    let steps = [Rational::MINUS_ONE, -angle.sign(), Rational::ONE];
    let count = |values: &[Rational; 3]| values.iter().filter(|value| !value.is_zero()).count();
    let mut best = (count(&values), None);
    if best.0 < 2 {
        // instead of one there would be two
        return Some(false);
    }
    for (value, step) in values.iter().zip(&steps) {
        // each step is ±1, its own inverse
        let times = -(value.clone() * step.clone());
        let moved = std::array::from_fn(|i| values[i].clone() + times.clone() * steps[i].clone());
        if count(&moved) < best.0 {
            best = (count(&moved), Some(moved));
        }
    }
    let Some(moved) = best.1 else { return Some(false) };
    for (place, value) in places.into_iter().zip(moved) {
        polynomial.0.remove(&place);
        polynomial.add_term(place, value);
    }
    Some(true)
}

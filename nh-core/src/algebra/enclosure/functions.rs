//! Values of functions: exact on points of the circle and powers of units, enclosed elsewhere.

use super::super::ball::{Ball, Enclosed, NoBall};
use super::super::exact::{Form, Number, complex_product};
use super::super::field::Residue;
use super::super::node::{Function, Function2, Node};
use super::super::number::Rational;
use super::{Pass, Point, Stream, Value};
use crate::id::{ExprId, Id};
use num_integer::Integer;
use num_traits::ToPrimitive;

impl Pass<'_> {
    pub(super) fn function(&mut self, id: ExprId, function: Function, x: ExprId) -> Result<Value, NoBall> {
        let exact = match function {
            Function::Sin | Function::Cos => self.circle(function == Function::Cos, x)?,
            Function::Exp | Function::Sinh | Function::Cosh | Function::Tanh => {
                self.exponential(function, x)?
            }
            Function::Abs | Function::Sign => self.signed(function, x)?,
            Function::Ln | Function::Atan | Function::Asin | Function::Acos => {
                self.inverse(id, function, x)?
            }
        };
        match exact {
            Some(form) => self.of_form(form),
            None => Ok(Value { ball: of_function(function, &self.known[&x].ball)?, form: None }),
        }
    }

    fn signed(&self, function: Function, x: ExprId) -> Result<Option<Form>, NoBall> {
        let value = &self.known[&x];
        let Some(form) = value.form.clone() else { return Ok(None) };
        let sign = match (value.ball.is_positive(), value.ball.is_negative()) {
            (true, _) => 1,
            (_, true) => -1,
            _ if form.is_algebraic() && self.is_zero(&form)? => 0,
            _ => return Err(NoBall::TooWide),
        };
        let number = Form::rational(&sign.into(), self.bits);
        Ok(if function == Function::Sign { Some(number) } else { form.times(&number, self.bits)? })
    }

    /// Logarithms and arcs of algebraic numbers.
    fn inverse(&mut self, id: ExprId, function: Function, x: ExprId) -> Result<Option<Form>, NoBall> {
        let Some(form) = self.known[&x].form.clone().filter(Form::is_algebraic) else { return Ok(None) };
        let number = form.algebraic.clone();
        let bits = self.bits;
        let (zero, one) = (Form::rational(&Rational::ZERO, bits), Number::of(&Rational::ONE, bits));
        if function == Function::Ln {
            return match (number.ball.is_positive(), self.is_zero(&form)? || number.ball.is_negative()) {
                (_, true) => Err(NoBall::Undefined),
                (true, _) => Ok(Some(Form { logarithms: vec![(Rational::ONE, number)], ..zero })),
                _ => Err(NoBall::TooWide),
            };
        }
        if function == Function::Atan {
            return Ok(Some(Form { arcs: vec![(Rational::ONE, [one, number])], ..zero }));
        }
        let squared = number.power(2)?;
        let rest = Number::sum([(Rational::ONE, &one), (Rational::MINUS_ONE, &squared)].into_iter(), bits);
        let other = if self.is_zero(&Form::of(rest.clone()))? {
            Number::of(&Rational::ZERO, bits)
        } else {
            self.root(id, &rest, 2)?
        };
        let point = if function == Function::Asin { [other, number] } else { [number, other] };
        Ok(Some(Form { arcs: vec![(Rational::ONE, point)], ..zero }))
    }

    /// Sine or cosine, where the angle is a rational part of a turn, or random.
    fn circle(&mut self, is_cosine: bool, x: ExprId) -> Result<Option<Form>, NoBall> {
        if !self.is_random() {
            let form = self.known[&x].form.clone();
            let is_part =
                |form: &Form| form.has_no_number() && form.logarithms.is_empty() && form.arcs.is_empty();
            let Some(form) = form.filter(is_part) else { return Ok(None) };
            let part = self.part_of_a_turn(&form.turns)?;
            return Ok(Some(Form::of(part[usize::from(!is_cosine)].clone())));
        }
        let mut product = [Number::of(&Rational::ONE, self.bits), Number::of(&Rational::ZERO, self.bits)];
        for (term, coefficient) in self.graph.angle_terms(x) {
            if term.is_some_and(|term| self.is_multiple_of_pi(term)) {
                let part = self.part_of_a_turn(&coefficient)?;
                product = complex_product(&product, &part, self.bits)?;
                continue;
            }
            let times = self.multiple(&coefficient)?;
            let factor = self.point_of_the_circle(term, times.signum());
            for _ in 0..times.unsigned_abs() {
                product = complex_product(&product, &factor, self.bits)?;
            }
        }
        let [cosine, sine] = product;
        Ok(Some(Form::of(if is_cosine { cosine } else { sine })))
    }

    /// Whether the term of an angle is π, or π with its coefficient.
    fn is_multiple_of_pi(&self, term: ExprId) -> bool {
        let is_pi = |id: ExprId| matches!(self.graph.node(id), Node::Pi);
        match self.graph.node(term) {
            Node::Pi => true,
            Node::Product { factors, .. } => matches!(&**factors, [(base, e)] if e.is_one() && is_pi(*base)),
            _ => false,
        }
    }

    /// A rational point of the circle for a term of an angle, or its mirror image.
    fn point_of_the_circle(&self, term: Option<ExprId>, side: i64) -> [Number; 2] {
        let word = self.random(Stream::Circle, self.key(term));
        let n = word % (1 << 14) + 2;
        let quadrant = |bit: i64| if self.has_signs() && word >> bit & 1 == 1 { -1 } else { 1 };
        let square = n * n + 1;
        let cosine = Rational::new(quadrant(18) * (n * n - 1), square);
        let sine = Rational::new(side * quadrant(19) * 2 * n, square);
        [Number::of(&cosine, self.bits), Number::of(&sine, self.bits)]
    }

    /// Whether the random numbers of this point have both signs.
    pub(super) fn has_signs(&self) -> bool {
        matches!(self.point, Point::Random { seed, .. } if seed % 2 == 1)
    }

    /// cos(qπ) and sin(qπ) = cos(π/2 − qπ).
    fn part_of_a_turn(&mut self, turn: &Rational) -> Result<[Number; 2], NoBall> {
        let other = Rational::new(1, 2) - turn.clone();
        for part in [turn, &other] {
            let order = (part.clone() * Rational::new(1, 2)).denominator().to_u64();
            let order = order.filter(|order| *order < 1 << 16).ok_or(NoBall::TooLong)?;
            self.parts_of_a_turn = self.parts_of_a_turn.lcm(&order);
            if self.parts_of_a_turn >= 1 << 20 {
                return Err(NoBall::TooLong);
            }
        }
        Ok([Number::cosine_of_part(turn, self.bits)?, Number::cosine_of_part(&other, self.bits)?])
    }

    /// The exponential and its kin, where the exponent is made of logarithms, or random.
    fn exponential(&mut self, function: Function, x: ExprId) -> Result<Option<Form>, NoBall> {
        let form = self.known[&x].form.clone();
        let of_logarithms = form.filter(|form| {
            let has_more = !form.has_no_number() || !form.turns.is_zero() || !form.arcs.is_empty();
            !(has_more || self.is_random() && form.logarithms.is_empty())
        });
        let power = if of_logarithms.is_none() && self.is_random() {
            let mut product = Number::of(&Rational::ONE, self.bits);
            for (term, coefficient) in self.graph.angle_terms(x) {
                let times = self.multiple(&coefficient)?;
                product = product.times(&self.exponential_of(term).power(times)?)?;
            }
            product
        } else {
            let Some(form) = of_logarithms else { return Ok(None) };
            let mut product = Number::of(&Rational::ONE, self.bits);
            for (index, (q, base)) in form.logarithms.iter().enumerate() {
                let Some((n, d)) = q.to_small().filter(|(n, d)| n.abs() < 1 << 16 && *d < 1 << 8) else {
                    return Ok(None);
                };
                let degree = d * (1 + i64::try_from(index).unwrap_or(0) * (1 << 10));
                let root = if d == 1 { base.clone() } else { self.adjoined(x, degree, base, d)? };
                product = product.times(&root.power(n)?)?;
            }
            product
        };
        let inverse = power.power(-1)?;
        let half = Rational::new(1, 2);
        let odd = || Number::sum([(half.clone(), &power), (-half.clone(), &inverse)].into_iter(), self.bits);
        let even = || Number::sum([(half.clone(), &power), (half.clone(), &inverse)].into_iter(), self.bits);
        Ok(Some(Form::of(match function {
            Function::Sinh => odd(),
            Function::Cosh => even(),
            Function::Tanh => odd().times(&even().power(-1)?)?,
            _ => power,
        })))
    }

    /// A root that is told from others of the same expression by `key`.
    fn adjoined(&mut self, of: ExprId, key: i64, number: &Number, degree: i64) -> Result<Number, NoBall> {
        if self.roots.insert((of, key)) {
            self.degree = self.degree.saturating_mul(degree.unsigned_abs());
        }
        number.root(u32::try_from(degree).map_err(|_| NoBall::TooLong)?)
    }

    /// The random number that stands for the exponential of a term.
    pub(super) fn exponential_of(&self, term: Option<ExprId>) -> Number {
        let value = self.random(Stream::Exponential, self.key(term));
        Number::of(&value.into(), self.bits)
    }

    /// What distinguishes a term of an angle: its value without its coefficient, where that is rational.
    fn key(&self, term: Option<ExprId>) -> u64 {
        let Some(term) = term else { return 1 };
        let bare = self.graph.without_coefficient(term);
        let rational =
            self.known.get(&term).and_then(|value| value.form.as_ref()?.algebraic.rational.clone());
        let apart = self.graph.number_apart(term).recip();
        let value = rational.zip(apart).and_then(|(value, apart)| Residue::of(&(value * apart)));
        match value {
            Some(value) if !self.exponents.contains(&bare) => value.word(),
            _ => Residue::mixed(7, bare.index() as u64).word(),
        }
    }

    /// `coefficient · division`, an integer that is not large.
    fn multiple(&self, coefficient: &Rational) -> Result<i64, NoBall> {
        const LARGEST: i64 = 1000;
        let times = (coefficient.clone() * Rational::from(self.division)).to_i64();
        times.filter(|n| n.abs() <= LARGEST).ok_or(NoBall::TooLong)
    }

    pub(super) fn function2(&mut self, function: Function2, x: ExprId, y: ExprId) -> Result<Value, NoBall> {
        let (a, b) = (self.known[&x].clone(), self.known[&y].clone());
        if function == Function2::Atan2 {
            let numbers = [&b, &a].map(|value| value.form.clone().filter(Form::is_algebraic));
            let [Some(adjacent), Some(opposite)] = numbers else {
                return Ok(Value { ball: Ball::angle(&a.ball, &b.ball)?, form: None });
            };
            if self.is_zero(&adjacent)? && self.is_zero(&opposite)? {
                return Err(NoBall::Undefined);
            }
            let arcs = vec![(Rational::ONE, [adjacent.algebraic, opposite.algebraic])];
            return self.of_form(Form { arcs, ..Form::rational(&Rational::ZERO, self.bits) });
        }
        let difference = a.ball.minus(&b.ball);
        let first_is_larger = match (difference.is_positive(), difference.is_negative()) {
            (true, _) => true,
            (_, true) => false,
            _ if x == y => true,
            _ => return Err(NoBall::TooWide),
        };
        Ok(if first_is_larger == (function == Function2::Max) { a } else { b })
    }
}

/// A function of every number of a ball.
pub(in super::super) fn of_function(function: Function, x: &Ball) -> Enclosed {
    match function {
        Function::Sin => x.sine(),
        Function::Cos => x.cosine(),
        Function::Asin => x.arcsine(),
        Function::Acos => x.arccosine(),
        Function::Atan => x.arctangent(),
        Function::Exp => x.exp(),
        Function::Ln => x.ln(),
        Function::Abs => Ok(x.magnitude()),
        Function::Sign if x.is_positive() => Ok(Ball::of(&Rational::ONE, x.bits())),
        Function::Sign if x.is_negative() => Ok(Ball::of(&Rational::MINUS_ONE, x.bits())),
        Function::Sign => Err(NoBall::TooWide),
        // (1 − e^(−2x))/(1 + e^(−2x)), by the exponential that is below 1
        Function::Tanh if x.is_negative() => Ok(of_function(function, &x.negative())?.negative()),
        Function::Tanh => {
            let (one, down) = (Ball::of(&Rational::ONE, x.bits()), x.scaled(&(-2).into()).exp()?);
            one.minus(&down).over(&one.plus(&down))
        }
        Function::Sinh | Function::Cosh => {
            let (up, down) = (x.exp()?, x.negative().exp()?);
            let both = if function == Function::Sinh { up.minus(&down) } else { up.plus(&down) };
            Ok(both.scaled(&Rational::new(1, 2)))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hyperbolic_tangent_has_no_large_numbers_in_it() {
        let of = |n: i64, d: i64| of_function(Function::Tanh, &Ball::of(&Rational::new(n, d), 128)).unwrap();
        // 0.46211715726000975850
        let (half, digits) = (of(1, 2), Rational::new(462_117_157_260_009_758, 1_000_000_000_000_000_000));
        let (low, high) = half.ends();
        assert!(digits < high && low - digits < Rational::new(1, 1_000_000_000_000_000_000));
        for far in [100, 100_000, i64::MAX] {
            let value = of(far, 1);
            assert!((value.to_f64() - 1.0).abs() < 1e-15 && (of(-far, 1).to_f64() + 1.0).abs() < 1e-15);
        }
        // with few digits it still contains 0.32151…
        let (low, high) = of_function(Function::Tanh, &Ball::of(&Rational::new(1, 3), 8)).unwrap().ends();
        assert!(low < Rational::new(32_151, 100_000) && Rational::new(32_152, 100_000) < high);
    }
}

//! Sines, cosines and exponentials at points of the field: by one random point of the circle, or one random
//! unit, for each term of the argument's normal form.

use super::field::Residue;
use super::graph::Graph;
use super::modular::{FieldPass, NoValue, Stream, Value};
use super::node::{Function, Function2, Node};
use super::number::Rational;
use crate::id::{ExprId, SymbolId};
use num_integer::Integer;
use num_traits::ToPrimitive;

impl Graph {
    /// A common denominator of the coefficients inside sine, cosine and exp; those that are too long are left
    /// aside, and belong to the value that they multiply.
    pub(crate) fn angle_division(&self, roots: &[ExprId]) -> i64 {
        self.angle_division_among(&self.reachable(roots))
    }

    /// The same of all functions among some expressions.
    pub(super) fn angle_division_among(&self, expressions: &[ExprId]) -> i64 {
        use Function::{Cos, Cosh, Exp, Sin, Sinh, Tanh};
        let mut division: i64 = 1;
        for id in expressions {
            let Node::Apply(Sin | Cos | Exp | Sinh | Cosh | Tanh, x) = self.node(*id) else { continue };
            for (_, coefficient) in self.angle_terms(*x) {
                if coefficient.is_integer() {
                    continue;
                }
                let denominator = coefficient.denominator().to_i64();
                let lcm = denominator.and_then(|d| (division / division.gcd(&d)).checked_mul(d));
                division = lcm.filter(|lcm| *lcm < LARGEST_DIVISION).unwrap_or(division);
            }
        }
        division
    }

    /// The argument of a periodic function as terms with coefficients; the number among them
    /// stands as a multiple of itself being 1.
    pub(super) fn angle_terms(&self, x: ExprId) -> Vec<(Option<ExprId>, Rational)> {
        let scaled = |term: ExprId, coefficient: &Rational| {
            let factor = self.angle_factor(term).unwrap_or(Rational::ONE);
            (Some(term), coefficient.clone() * factor)
        };
        match self.node(x) {
            Node::Number(value) => vec![(None, value.clone())],
            Node::Sum { constant, terms } => {
                let mut list: Vec<_> = terms.iter().map(|(term, c)| scaled(*term, c)).collect();
                if !constant.is_zero() {
                    list.push((None, constant.clone()));
                }
                list
            }
            Node::Product { coefficient, .. } => vec![scaled(x, coefficient)],
            _ => vec![scaled(x, &Rational::ONE)],
        }
    }

    /// The terms of an angle that are no numbers, with their coefficients.
    pub(crate) fn terms_of_angle(&self, x: ExprId) -> Vec<(ExprId, Rational)> {
        let terms = self.angle_terms(x).into_iter();
        terms.filter_map(|(term, coefficient)| Some((term?, coefficient))).collect()
    }

    /// Whether a term is such a symbol, or has it for a factor.
    pub(super) fn has_factor(&self, term: ExprId, is_one: impl Fn(SymbolId) -> bool) -> bool {
        let is_one = |x: ExprId| self.as_symbol(x).is_some_and(&is_one);
        match self.node(term) {
            Node::Product { factors, .. } => factors.iter().any(|(base, _)| is_one(*base)),
            _ => is_one(term),
        }
    }

    /// Whether a term of a sum inside of a product has a factor that stands for something else, or one that is a sum
    /// itself where levels are left.
    pub(super) fn multiplies_out(
        &self,
        term: ExprId,
        levels: u32,
        is_image: impl Fn(SymbolId) -> bool,
    ) -> bool {
        let is_sum = |x: ExprId| matches!(self.node(x), Node::Sum { .. });
        let has_sum = matches!(self.node(term), Node::Product { factors, .. }
            if factors.iter().any(|(base, _)| is_sum(*base)));
        levels > 0 && has_sum || self.has_factor(term, is_image)
    }

    /// What stands in the arcs and logarithms that are terms of an argument: points above it are made of their values.
    pub(crate) fn inside_arcs(&self, x: ExprId) -> Vec<ExprId> {
        let mut found = Vec::new();
        for (term, _) in self.terms_of_angle(x) {
            for (part, _) in self.factors(term) {
                match self.node(part) {
                    Node::Apply(Function::Asin | Function::Acos | Function::Atan | Function::Ln, u) => {
                        found.push(*u);
                    }
                    Node::Apply2(Function2::Atan2, y, x) => found.extend([*y, *x]),
                    _ => {}
                }
            }
        }
        found
    }

    /// The constants among the factors of a term of an angle, which count as its coefficient. With a long
    /// denominator they do not: then an identity has to hold for any value.
    pub(super) fn angle_factor(&self, term: ExprId) -> Option<Rational> {
        let factor = self.constant_factor(term);
        (factor.is_one() || factor.denominator() <= LONGEST_DENOMINATOR.into()).then_some(factor)
    }
}

/// Denominators of constants in angles up to which these are numbers: common denominators stay short.
const LONGEST_DENOMINATOR: i64 = 1000;
/// Terms that a product of sums in an angle is multiplied out to at most.
pub(super) const BUDGET: u16 = 256;
/// Levels of sums inside of products inside of sums that are multiplied out: a chain of them doubles its work with each.
pub(super) const DEEPEST: u32 = 3;
/// Common denominators of coefficients in angles are shorter than this.
const LARGEST_DIVISION: i64 = 1 << 20;

impl FieldPass<'_> {
    /// The terms of an angle, products of sums multiplied out down to so many levels, as field values with coefficients;
    /// those that are one expression times a number with it.
    fn normal_terms(&self, x: ExprId, levels: u32) -> Vec<(Option<ExprId>, Residue, Rational)> {
        let mut list = Vec::new();
        for (term, coefficient) in self.graph.angle_terms(x) {
            match term {
                None => list.push((None, Residue::ONE, coefficient)),
                Some(term) => list.extend(self.expanded(term, &coefficient, levels)),
            }
        }
        list
    }

    /// Whether a term is a symbol that stands for something else, or has one for a factor.
    fn has_image(&self, term: ExprId) -> bool {
        self.graph.has_factor(term, |symbol| self.images.contains_key(&symbol))
    }

    /// The terms of what a symbol stands for, within the budget.
    fn terms_of_image(&self, x: ExprId, levels: u32) -> Option<Vec<(Option<ExprId>, Residue, Rational)>> {
        let image = self.images.get(&self.graph.as_symbol(x)?)?;
        Some(self.normal_terms(*image, levels)).filter(|terms| terms.len() <= usize::from(BUDGET))
    }

    /// The terms of a sum, or of what a symbol stands for, as field values with coefficients.
    fn summands(&self, x: ExprId, levels: u32) -> Option<Vec<(Residue, Rational)>> {
        if let Some(terms) = self.terms_of_image(x, levels) {
            return Some(terms.into_iter().map(|(_, value, coefficient)| (value, coefficient)).collect());
        }
        let Node::Sum { constant, terms } = self.graph.node(x) else { return None };
        let mut list: Vec<_> =
            (!constant.is_zero()).then(|| (Residue::ONE, constant.clone())).into_iter().collect();
        for (term, coefficient) in terms.iter() {
            if self.graph.multiplies_out(*term, levels, |symbol| self.images.contains_key(&symbol)) {
                let terms = self.expanded(*term, coefficient, levels.saturating_sub(1)).into_iter();
                list.extend(terms.map(|(_, value, coefficient)| (value, coefficient)));
            } else {
                let factor = self.graph.angle_factor(*term).unwrap_or(Rational::ONE);
                list.push((self.known[term] * over(&factor), coefficient.clone() * factor));
            }
        }
        Some(list)
    }

    /// Multiplies out the positive powers of sums in a product, within a budget.
    fn expanded(
        &self,
        term: ExprId,
        scale: &Rational,
        levels: u32,
    ) -> Vec<(Option<ExprId>, Residue, Rational)> {
        if let Some(terms) = self.terms_of_image(term, levels) {
            return terms.into_iter().map(|(alone, value, c)| (alone, value, c * scale.clone())).collect();
        }
        let whole = |coefficient: Rational, value: Residue| vec![(Some(term), value, coefficient)];
        let constant = self.graph.angle_factor(term);
        let unit = over(constant.as_ref().unwrap_or(&Rational::ONE));
        let Node::Product { coefficient, factors } = self.graph.node(term) else {
            return whole(scale.clone(), self.known[&term] * unit);
        };
        let unit = over(coefficient) * unit;
        let mut list = vec![(Residue::ONE, scale.clone())];
        let is_coefficient = |(base, exponent): &&(ExprId, Rational)| {
            constant.is_some() && exponent.is_integer() && self.graph.value_of(*base).is_some()
        };
        let factors: Vec<_> = factors.iter().filter(|factor| !is_coefficient(factor)).collect();
        for (base, exponent) in &factors {
            let times = times_multiplied_out(exponent);
            if let (Some(times), Some(terms)) = (times, times.and_then(|_| self.summands(*base, levels))) {
                for _ in 0..times {
                    if list.len() * (terms.len() + 1) > usize::from(BUDGET) {
                        return whole(scale.clone(), self.known[&term] * unit);
                    }
                    let times_terms = |(value, c): &(Residue, Rational)| {
                        let times = terms.iter().map(|(t, d)| (*value * *t, c.clone() * d.clone()));
                        times.collect::<Vec<_>>()
                    };
                    list = list.iter().flat_map(times_terms).collect();
                }
            } else if let Ok(power) = self.power(*base, exponent) {
                for (value, _) in &mut list {
                    *value = *value * power;
                }
            }
        }
        let alone = match factors.as_slice() {
            [(base, exponent)] if exponent.is_one() && !self.has_image(*base) => Some(*base),
            _ => None,
        };
        list.into_iter().map(|(value, c)| (alone, value, c)).collect()
    }

    /// `(cos x, sin x)`.
    pub(super) fn circle(&mut self, x: ExprId) -> Result<(Residue, Residue), NoValue> {
        if let Some(known) = self.circles.get(&x) {
            return Ok(*known);
        }
        let mut turned = (Residue::ONE, Residue::ZERO);
        let pi = self.pi();
        for (alone, value, coefficient) in self.normal_terms(x, DEEPEST) {
            if value == pi
                && let Some(twelfths) = (coefficient.clone() * Rational::from(12)).to_i64()
            {
                turned = rotate(turned, circle_power(twelfth_of_pi()?, twelfths));
                continue;
            }
            let symbol = alone.and_then(|alone| self.graph.as_symbol(alone));
            let chosen = symbol.and_then(|symbol| self.point.circle.get(&symbol));
            let arc = alone.filter(|_| self.relates_arcs && coefficient.is_integer());
            let (unit, times) = if let Some(unit) = chosen {
                (*unit, coefficient.to_i64().ok_or(NoValue::Here)?)
            } else if let Some(unit) = arc.and_then(|arc| self.unit_of_arc(arc)) {
                (unit?, coefficient.to_i64().ok_or(NoValue::Here)?)
            } else {
                let (value, times) = self.multiple(value, &coefficient)?;
                (self.unit_of(value)?, times)
            };
            turned = rotate(turned, circle_power(unit, times));
        }
        self.circles.insert(x, turned);
        Ok(turned)
    }

    /// The point of the circle above an arc; `None` of what is none.
    fn unit_of_arc(&self, arc: ExprId) -> Option<Result<(Residue, Residue), NoValue>> {
        let of = |x: &ExprId| self.known.get(x).copied();
        let leg = |square: Residue| square.sqrt().ok_or(NoValue::Here);
        let over = |x: Residue, y: Residue| {
            let scale = leg(x * x + y * y)?.inverse().ok_or(NoValue::Here)?;
            Ok((x * scale, y * scale))
        };
        match self.graph.node(arc) {
            Node::Apply(Function::Asin, x) => of(x).map(|x| Ok((leg(Residue::ONE - x * x)?, x))),
            Node::Apply(Function::Acos, x) => of(x).map(|x| Ok((x, leg(Residue::ONE - x * x)?))),
            Node::Apply(Function::Atan, x) => of(x).map(|x| over(Residue::ONE, x)),
            Node::Apply2(Function2::Atan2, y, x) => of(y).zip(of(x)).map(|(y, x)| over(x, y)),
            _ => None,
        }
    }

    /// The random point of the circle above `value / division`.
    pub(super) fn unit_of(&mut self, value: Residue) -> Result<(Residue, Residue), NoValue> {
        if let Some(unit) = self.units.get(&value.word()) {
            return Ok(*unit);
        }
        let u = self.random(Stream::Circle, value.word());
        let scale = (Residue::ONE + u * u).inverse().ok_or(NoValue::Here)?;
        let unit = ((Residue::ONE - u * u) * scale, (u + u) * scale);
        self.units.insert(value.word(), unit);
        Ok(unit)
    }

    pub(super) fn exponential(&self, x: ExprId) -> Value {
        let mut product = Residue::ONE;
        for (alone, value, coefficient) in self.normal_terms(x, DEEPEST) {
            if self.relates_arcs
                && let Some(Node::Apply(Function::Ln, inside)) = alone.map(|alone| self.graph.node(alone))
                && self.known.contains_key(inside)
                && coefficient.to_small().is_some()
            {
                product = product * self.power(*inside, &coefficient)?;
                continue;
            }
            let symbol = alone.and_then(|alone| self.graph.as_symbol(alone));
            let chosen = symbol.and_then(|symbol| self.point.exponentials.get(&symbol));
            if let Some(unit) = chosen {
                let times = coefficient * Rational::from(self.division);
                let times = times.to_i64().ok_or(NoValue::Here)?;
                product = product * unit.integer_power(times).ok_or(NoValue::Here)?;
                continue;
            }
            let (value, times) = self.multiple(value, &coefficient)?;
            let unit = self.random(Stream::Exponential, value.word());
            product = product * unit.integer_power(times).ok_or(NoValue::Here)?;
        }
        Ok(product)
    }

    /// An exponential, of whose value the logarithm is known then.
    pub(super) fn noted_exponential(&mut self, x: ExprId) -> Value {
        let value = self.exponential(x)?;
        self.logarithms.insert(value.up_to_sign().0.word(), self.known[&x]);
        Ok(value)
    }

    /// The logarithm of the magnitude: of a product it is a sum, and of an exponential its argument.
    pub(super) fn logarithm(&self, x: ExprId) -> Value {
        let of = |value: Residue| {
            let magnitude = value.up_to_sign().0;
            if magnitude == Residue::ONE.up_to_sign().0 {
                return Residue::ZERO;
            }
            let known = self.logarithms.get(&magnitude.word()).copied();
            known.unwrap_or_else(|| self.of_kernel(Function::Ln, magnitude))
        };
        let Node::Product { coefficient, factors } = self.graph.node(x) else {
            return Ok(of(self.known[&x]));
        };
        let magnitude = coefficient.abs();
        let mut sum = if magnitude.is_one() {
            Residue::ZERO
        } else {
            of(Residue::of(&magnitude).ok_or(NoValue::Here)?)
        };
        for (base, exponent) in factors.iter() {
            sum = sum + Residue::of(exponent).ok_or(NoValue::Here)? * of(self.known[base]);
        }
        Ok(sum)
    }

    /// `coefficient · value` as an integer multiple of `value / division`, or of a value of its own where the
    /// coefficient is too long for that.
    fn multiple(&self, value: Residue, coefficient: &Rational) -> Result<(Residue, i64), NoValue> {
        match (coefficient.clone() * Rational::from(self.division)).to_i64() {
            Some(times) => Ok((value, times)),
            None => Ok((value * Residue::of(coefficient).ok_or(NoValue::Here)?, self.division)),
        }
    }
}

/// How many times a sum is multiplied out that has this exponent, if it is.
pub(super) fn times_multiplied_out(exponent: &Rational) -> Option<i32> {
    exponent.to_i64().filter(|times| (1..=4).contains(times)).and_then(|times| i32::try_from(times).ok())
}

/// 1 over a number, or 1 where the field has none.
fn over(number: &Rational) -> Residue {
    Residue::of(number).and_then(Residue::inverse).unwrap_or(Residue::ONE)
}

/// `(cos π/12, sin π/12)`. Either choice of either root gives a point whose sixth power is (0, 1).
fn twelfth_of_pi() -> Result<(Residue, Residue), NoValue> {
    let root = |n| Residue::of_word(n).sqrt().ok_or(NoValue::Here);
    let (r2, r6) = (root(2)?, root(6)?);
    let quarter = Residue::of_word(4).inverse().ok_or(NoValue::Here)?;
    Ok(((r6 + r2) * quarter, (r6 - r2) * quarter))
}

fn rotate(a: (Residue, Residue), b: (Residue, Residue)) -> (Residue, Residue) {
    (a.0 * b.0 - a.1 * b.1, a.0 * b.1 + a.1 * b.0)
}

fn circle_power(unit: (Residue, Residue), times: i64) -> (Residue, Residue) {
    let mut base = if times < 0 { (unit.0, -unit.1) } else { unit };
    let mut exponent = times.unsigned_abs();
    let mut result = (Residue::ONE, Residue::ZERO);
    while exponent > 0 {
        if exponent & 1 == 1 {
            result = rotate(result, base);
        }
        base = rotate(base, base);
        exponent >>= 1;
    }
    result
}

//! Polynomials in one variable over the field, and rational functions from their values: whether one function
//! vanishes only where others do.

use crate::algebra::Residue;
use crate::limits;

/// A polynomial by its coefficients, the constant first, the last one not zero.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Polynomial(Vec<Residue>);

impl Polynomial {
    fn new(mut coefficients: Vec<Residue>) -> Self {
        while coefficients.last() == Some(&Residue::ZERO) {
            coefficients.pop();
        }
        Self(coefficients)
    }

    /// That which is its variable.
    pub(super) fn variable() -> Self {
        Self(vec![Residue::ZERO, Residue::ONE])
    }

    fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// The degree, 0 for zero.
    pub(super) fn degree(&self) -> usize {
        self.0.len().saturating_sub(1)
    }

    fn at(&self, x: Residue) -> Residue {
        self.0.iter().rev().fold(Residue::ZERO, |value, coefficient| value * x + *coefficient)
    }

    fn times(&self, other: &Self) -> Self {
        let mut product = vec![Residue::ZERO; (self.0.len() + other.0.len()).saturating_sub(1)];
        for (i, a) in self.0.iter().enumerate() {
            for (j, b) in other.0.iter().enumerate() {
                product[i + j] = product[i + j] + *a * *b;
            }
        }
        Self::new(product)
    }

    fn minus(&self, other: &Self) -> Self {
        let length = self.0.len().max(other.0.len());
        let entry = |list: &[Residue], k: usize| list.get(k).copied().unwrap_or(Residue::ZERO);
        Self::new((0..length).map(|k| entry(&self.0, k) - entry(&other.0, k)).collect())
    }

    /// Quotient and remainder.
    fn divided(&self, divisor: &Self) -> (Self, Self) {
        let Some(inverse) = divisor.0.last().and_then(|leading| leading.inverse()) else {
            return (Self(Vec::new()), self.clone());
        };
        let mut rest = self.0.clone();
        let mut quotient = vec![Residue::ZERO; rest.len().saturating_sub(divisor.degree())];
        for k in (0..quotient.len()).rev() {
            let factor = rest[k + divisor.degree()] * inverse;
            quotient[k] = factor;
            for (j, coefficient) in divisor.0.iter().enumerate() {
                rest[k + j] = rest[k + j] - factor * *coefficient;
            }
        }
        (Self::new(quotient), Self::new(rest))
    }

    fn common(&self, other: &Self) -> Self {
        let (mut a, mut b) = (self.clone(), other.clone());
        while !b.is_zero() {
            let rest = a.divided(&b).1;
            (a, b) = (b, rest);
        }
        a
    }

    /// Its zeros in the field of P elements, each once, by Rabin's splitting (M. O. Rabin, *Probabilistic algorithms in
    /// finite fields*, SIAM J. Comput. 9, 1980).
    pub(super) fn zeros(&self) -> Vec<Residue> {
        let mut found = Vec::new();
        if self.degree() == 0 {
            return found;
        }
        // x^P − x has all elements as zeros, each once
        let x = Self::variable();
        let split = self.common(&x.power_modulo(Residue::ORDER, self).minus(&x));
        let mut whole = vec![split];
        for trial in 0..64 {
            // (x + c)^((P − 1)/2) is 1 at half of them
            let shifted = Self(vec![Residue::mixed(577, trial), Residue::ONE]);
            let mut left = Vec::new();
            for polynomial in whole {
                if polynomial.degree() <= 1 {
                    found.extend(polynomial.zero_of_line());
                    continue;
                }
                let power = shifted.power_modulo(Residue::ORDER / 2, &polynomial);
                let some = polynomial.common(&power.minus(&Self(vec![Residue::ONE])));
                let others = polynomial.divided(&some).0;
                left.extend([some, others]);
            }
            whole = left;
        }
        found
    }

    /// The zero of a polynomial of degree 1.
    fn zero_of_line(&self) -> Option<Residue> {
        let [constant, slope] = self.0.as_slice() else { return None };
        Some(-*constant * slope.inverse()?)
    }

    fn power_modulo(&self, mut exponent: u64, modulus: &Self) -> Self {
        let (mut base, mut result) = (self.divided(modulus).1, Self(vec![Residue::ONE]));
        while exponent > 0 {
            limits::spend(1 + modulus.degree());
            if exponent & 1 == 1 {
                result = result.times(&base).divided(modulus).1;
            }
            base = base.times(&base).divided(modulus).1;
            exponent >>= 1;
        }
        result
    }

    /// Without the factors that it has in common with another one, however often.
    pub(super) fn without(self, other: &Self) -> Self {
        let mut left = self;
        loop {
            let common = left.common(other);
            if common.degree() == 0 {
                return left;
            }
            left = left.divided(&common).0;
        }
    }
}

/// How many values determine a quotient of polynomials of a degree, with some to check it by.
pub(super) const fn values_for(degree: usize) -> usize {
    2 * degree + 3
}

/// Where values are taken.
pub(super) fn place(index: usize) -> Residue {
    Residue::mixed(2_029, index as u64)
}

/// The numerator of the quotient of two polynomials that has these values at the first places; `None` where there is
/// none of so low a degree.
pub(super) fn numerator(values: &[Residue]) -> Option<Polynomial> {
    let points: Vec<Residue> = (0..values.len()).map(place).collect();
    numerator_at(&points, values)
}

/// The same of values at any points.
pub(super) fn numerator_at(points: &[Residue], values: &[Residue]) -> Option<Polynomial> {
    const CHECKS: usize = 2;
    let used = values.len().checked_sub(CHECKS)?;
    // 1. the polynomial with these values, by divided differences, and the one that vanishes at the points
    let mut whole = Polynomial(vec![Residue::ONE]);
    let mut interpolated = Polynomial(Vec::new());
    for (point, value) in points.iter().zip(values).take(used) {
        let scale = (*value - interpolated.at(*point)) * whole.at(*point).inverse()?;
        let step = whole.times(&Polynomial::new(vec![-scale]));
        interpolated = interpolated.minus(&step);
        whole = whole.times(&Polynomial(vec![-*point, Residue::ONE]));
    }
    // 2. the first remainder of Euclid's algorithm that is short: r = t · interpolated modulo the other
    let (mut r, mut next) = (whole, interpolated);
    let (mut t, mut t_next) = (Polynomial(Vec::new()), Polynomial(vec![Residue::ONE]));
    while 2 * next.degree() >= used && !next.is_zero() {
        let (quotient, rest) = r.divided(&next);
        let t_rest = t.minus(&quotient.times(&t_next));
        (r, next) = (next, rest);
        (t, t_next) = (t_next, t_rest);
    }
    // 3. it has the other values, too
    let agrees = |(point, value): (&Residue, &Residue)| next.at(*point) == *value * t_next.at(*point);
    points.iter().zip(values).all(agrees).then_some(next)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polynomial(coefficients: &[u64]) -> Polynomial {
        Polynomial::new(coefficients.iter().map(|c| Residue::of_word(*c)).collect())
    }

    #[test]
    fn zeros_are_found_each_once() {
        // (x − 3)² (x − 5) (x − 7) (x² + 1), and −1 is no square
        let line = |zero: u64| Polynomial::new(vec![-Residue::of_word(zero), Residue::ONE]);
        let product = line(3).times(&line(3)).times(&line(5)).times(&line(7));
        let product = product.times(&polynomial(&[1, 0, 1])).times(&polynomial(&[11]));
        let mut words: Vec<u64> = product.zeros().into_iter().map(Residue::word).collect();
        words.sort_unstable();
        assert_eq!(words, [3, 5, 7]);
        assert!(polynomial(&[4]).zeros().is_empty());
        assert!(polynomial(&[1, 0, 1]).zeros().is_empty());
    }

    #[test]
    fn numerators_are_found_from_values() {
        // (x² + 3) (x + 5) / ((x + 7) (x² + 11))
        let (square, line) = (polynomial(&[3, 0, 1]), polynomial(&[5, 1]));
        let above = square.times(&line);
        let below = polynomial(&[7, 1]).times(&polynomial(&[11, 0, 1]));
        let value = |index: usize| {
            let x = place(index);
            above.at(x) * below.at(x).inverse().expect("no pole")
        };
        let values: Vec<Residue> = (0..values_for(3)).map(value).collect();
        let found = numerator(&values).expect("it is of degree 3");
        assert_eq!(found.degree(), 3);
        assert_eq!(found.clone().without(&square).degree(), 1);
        assert_eq!(found.clone().without(&line).without(&square).degree(), 0);
        assert_eq!(found.without(&below).degree(), 3);
        assert!(numerator(&values[..values_for(2)]).is_none());
    }
}

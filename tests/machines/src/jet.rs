//! Numbers with their first and second partial derivatives.

use f256::f256;
use nonholonomic_core::algebra::Rational;

/// A number of 71 digits with its partial derivatives up to second order by some variables.
#[derive(Clone, Debug)]
pub struct Jet {
    /// The value.
    pub value: f256,
    /// ∂_i.
    pub first: Vec<f256>,
    /// ∂_i∂_j, row i of j ≤ i.
    second: Vec<f256>,
}

fn place(i: usize, j: usize) -> usize {
    let (low, high) = (i.min(j), i.max(j));
    high * (high + 1) / 2 + low
}

impl Jet {
    /// A number that depends on none of the variables.
    #[must_use]
    pub fn constant(value: f256, variables: usize) -> Self {
        let (first, second) = (vec![f256::ZERO; variables], vec![f256::ZERO; place(variables, 0)]);
        Self { value, first, second }
    }

    /// One of the variables.
    #[must_use]
    pub fn variable(value: f256, index: usize, variables: usize) -> Self {
        let mut jet = Self::constant(value, variables);
        jet.first[index] = f256::ONE;
        jet
    }

    /// ∂_i∂_j.
    #[must_use]
    pub fn second(&self, i: usize, j: usize) -> f256 {
        self.second[place(i, j)]
    }

    /// Adds `factor · other`.
    pub(crate) fn add_scaled(&mut self, factor: f256, other: &Self) {
        let entries =
            self.first.iter_mut().chain(&mut self.second).zip(other.first.iter().chain(&other.second));
        for (entry, other) in entries {
            if !other.eq_zero() {
                *entry += factor * *other;
            }
        }
        self.value += factor * other.value;
    }

    /// The product.
    #[must_use]
    pub fn times(&self, other: &Self) -> Self {
        let mut product = Self::constant(f256::ZERO, self.first.len());
        product.add_scaled(self.value, other);
        let zeroth = product.value;
        product.add_scaled(other.value, self);
        product.value = zeroth;
        product.add_products(f256::ONE, self, other);
        product.add_products(f256::ONE, other, self);
        product
    }

    /// Adds `factor ∂_i a ∂_j b` for j ≤ i.
    fn add_products(&mut self, factor: f256, a: &Self, b: &Self) {
        for (i, x) in a.first.iter().enumerate().filter(|(_, x)| !x.eq_zero()) {
            let x = factor * *x;
            for (j, y) in b.first[..=i].iter().enumerate().filter(|(_, y)| !y.eq_zero()) {
                self.second[place(i, j)] += x * *y;
            }
        }
    }

    /// f(x), given f, f′ and f″ there.
    fn through(&self, [value, slope, curvature]: [f256; 3]) -> Self {
        let mut image = Self::constant(f256::ZERO, self.first.len());
        image.add_scaled(slope, self);
        image.value = value;
        image.add_products(curvature, self, self);
        image
    }

    /// The reciprocal.
    #[must_use]
    pub fn recip(&self) -> Self {
        let r = self.value.recip();
        let slope = -(r * r);
        self.through([r, slope, f256::TWO * r * r * r])
    }

    /// The square root.
    #[must_use]
    pub fn sqrt(&self) -> Self {
        let root = self.value.sqrt();
        let slope = (f256::TWO * root).recip();
        self.through([root, slope, -(slope / (f256::TWO * self.value))])
    }

    /// A power.
    #[must_use]
    pub fn power(&self, exponent: &Rational) -> Self {
        match exponent.to_small() {
            Some((1, 1)) => self.clone(),
            Some((2, 1)) => self.times(self),
            Some((-1, 1)) => self.recip(),
            Some((1, 2)) => self.sqrt(),
            Some((n, 1)) if n < 0 => self.power(&Rational::from(-n)).recip(),
            Some((n, 1)) => self.times(&self.power(&Rational::from(n - 1))),
            Some((n, 2)) => self.sqrt().power(&Rational::from(n)),
            _ => {
                // x^e = exp(e ln x)
                let mut logarithm = self.logarithm();
                let exponent = crate::numbers::exact(exponent);
                let whole = logarithm.clone();
                logarithm.add_scaled(exponent - f256::ONE, &whole);
                logarithm.exponential()
            }
        }
    }

    /// eˣ.
    #[must_use]
    pub fn exponential(&self) -> Self {
        self.through([self.value.exp(); 3])
    }

    /// ln x.
    #[must_use]
    pub fn logarithm(&self) -> Self {
        let r = self.value.recip();
        self.through([self.value.ln(), r, -(r * r)])
    }

    /// sin x and cos x.
    #[must_use]
    pub fn sin_cos(&self) -> [Self; 2] {
        let (sin, cos) = self.value.sin_cos();
        [self.through([sin, cos, -sin]), self.through([cos, -sin, -cos])]
    }

    /// The arc tangent.
    #[must_use]
    pub fn atan(&self) -> Self {
        let r = (f256::ONE + self.value * self.value).recip();
        self.through([self.value.atan(), r, -(f256::TWO * self.value * r * r)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_of_a_composition() {
        // f = sin(x y) / x at (2, 3): derivatives by hand
        let [x, y] = [2u32, 3].map(f256::from);
        let (jx, jy) = (Jet::variable(x, 0, 2), Jet::variable(y, 1, 2));
        let [sin, _] = jx.times(&jy).sin_cos();
        let f = sin.times(&jx.recip());
        let (s, c) = (x * y).sin_cos();
        let near = |a: f256, b: f256| assert!(crate::numbers::rounded((a - b).abs()) < 1e-66, "{a} {b}");
        near(f.value, s / x);
        near(f.first[0], y * c / x - s / (x * x));
        near(f.first[1], c);
        near(f.second(0, 1), -(y * s));
        near(f.second(1, 1), -(x * s));
        near(f.second(0, 0), -(y * y * s / x) - f256::TWO * y * c / (x * x) + f256::TWO * s / (x * x * x));
    }
}

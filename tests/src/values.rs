//! Named numbers, and numbers that move.

use std::ops::{Add, Div, Index, Mul, Neg, Sub};

/// Numbers with names, in a fixed order: parameters, or the state of a reference system.
#[derive(Clone, Debug, Default)]
pub struct Named<T>(Vec<(String, T)>);

/// Parameters by their names in the reference data.
pub type Values = Named<f64>;

/// A state of the reference data: every quantity with its time derivative.
pub type Reading = Named<Moving>;

impl<T> Named<T> {
    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The numbers in order.
    pub fn iter(&self) -> impl Iterator<Item = &T> {
        self.0.iter().map(|(_, value)| value)
    }

    /// The same names with other numbers.
    #[must_use]
    pub fn renewed(&self, numbers: impl IntoIterator<Item = T>) -> Self {
        self.0.iter().zip(numbers).map(|((name, _), number)| (name.clone(), number)).collect()
    }
}

impl<T> FromIterator<(String, T)> for Named<T> {
    fn from_iter<I: IntoIterator<Item = (String, T)>>(items: I) -> Self {
        Self(items.into_iter().collect())
    }
}

impl<T> Index<&str> for Named<T> {
    type Output = T;

    fn index(&self, name: &str) -> &T {
        match self.0.iter().find(|(known, _)| known == name) {
            Some((_, value)) => value,
            None => panic!("the reference data have no `{name}`"),
        }
    }
}

/// A number with its time derivative. Arithmetic follows the rules of differentiation, so that a
/// map from reference coordinates to those of a declaration, written once, maps rates as well.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moving {
    /// The number.
    pub value: f64,
    /// Its time derivative.
    pub rate: f64,
}

impl Moving {
    /// Sine and cosine.
    #[must_use]
    pub fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.value.sin_cos();
        (Self { value: sin, rate: cos * self.rate }, Self { value: cos, rate: -sin * self.rate })
    }

    /// The square root.
    #[must_use]
    pub fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        Self { value: root, rate: self.rate / (2.0 * root) }
    }

    /// The angle whose tangent is `self / other`, in the quadrant of the two.
    #[must_use]
    pub fn atan2(self, other: Self) -> Self {
        let square = self.value * self.value + other.value * other.value;
        Self {
            value: self.value.atan2(other.value),
            rate: (other.value * self.rate - self.value * other.rate) / square,
        }
    }
}

impl Add for Moving {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, rate: self.rate + other.rate }
    }
}

impl Sub for Moving {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self { value: self.value - other.value, rate: self.rate - other.rate }
    }
}

impl Neg for Moving {
    type Output = Self;

    fn neg(self) -> Self {
        Self { value: -self.value, rate: -self.rate }
    }
}

impl Mul for Moving {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Self { value: self.value * other.value, rate: self.rate * other.value + self.value * other.rate }
    }
}

impl Mul<f64> for Moving {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self { value: self.value * factor, rate: self.rate * factor }
    }
}

impl Div for Moving {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        Self { value, rate: (self.rate - value * other.rate) / other.value }
    }
}

#[cfg(test)]
mod tests {
    use super::Moving;

    #[test]
    fn rates_follow_the_rules_of_differentiation() {
        let path = |t: f64| (1.3 + 0.7 * t, 0.4 - 1.1 * t);
        let map = |a: Moving, b: Moving| {
            let (sin, cos) = (a * b).sin_cos();
            (sin / (a + b * b) - -cos * 2.0).atan2((a * a + b * b).sqrt())
        };
        let at = |t: f64| {
            let (a, b) = path(t);
            map(Moving { value: a, rate: 0.7 }, Moving { value: b, rate: -1.1 })
        };
        let step = 1e-5;
        let difference = (at(step).value - at(-step).value) / (2.0 * step);
        assert!((at(0.0).rate - difference).abs() < 1e-9);
    }
}

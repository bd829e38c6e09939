//! Dimensions: exponents of the base units, and units by their names.

use std::fmt;

use crate::algebra::Rational;

/// The base units, in the order in which they are written.
const BASE: [&str; 7] = ["kg", "m", "s", "A", "K", "mol", "cd"];

/// Units that have a name: exponents of kg, m, s, A, K, mol, cd.
const NAMED: [(&str, [i64; 7]); 20] = [
    ("kg", [1, 0, 0, 0, 0, 0, 0]),
    ("m", [0, 1, 0, 0, 0, 0, 0]),
    ("s", [0, 0, 1, 0, 0, 0, 0]),
    ("A", [0, 0, 0, 1, 0, 0, 0]),
    ("K", [0, 0, 0, 0, 1, 0, 0]),
    ("mol", [0, 0, 0, 0, 0, 1, 0]),
    ("cd", [0, 0, 0, 0, 0, 0, 1]),
    ("rad", [0; 7]),
    ("Hz", [0, 0, -1, 0, 0, 0, 0]),
    ("N", [1, 1, -2, 0, 0, 0, 0]),
    ("J", [1, 2, -2, 0, 0, 0, 0]),
    ("W", [1, 2, -3, 0, 0, 0, 0]),
    ("Pa", [1, -1, -2, 0, 0, 0, 0]),
    ("C", [0, 0, 1, 1, 0, 0, 0]),
    ("V", [1, 2, -3, -1, 0, 0, 0]),
    ("F", [-1, -2, 4, 2, 0, 0, 0]),
    ("ohm", [1, 2, -3, -2, 0, 0, 0]),
    ("Wb", [1, 2, -2, -1, 0, 0, 0]),
    ("T", [1, 0, -2, -1, 0, 0, 0]),
    ("H", [1, 2, -2, -2, 0, 0, 0]),
];

/// The units that can be written.
pub const UNITS: [&str; 20] = [
    "kg", "m", "s", "A", "K", "mol", "cd", "rad", "Hz", "N", "J", "W", "Pa", "C", "V", "F", "ohm", "Wb", "T",
    "H",
];

/// Units that dimensions are shown in beside the base units, the likeliest first.
const SHOWN: [&str; 11] = ["N", "J", "W", "V", "Pa", "ohm", "F", "Wb", "T", "H", "C"];

/// Units that are a number times a product of ours, with that number and product.
const OTHERS: [(&str, &str); 26] = [
    ("deg", "π/180 rad"),
    ("degree", "π/180 rad"),
    ("degrees", "π/180 rad"),
    ("rpm", "π/30 rad s^-1"),
    ("rev", "2π rad"),
    ("g", "1e-3 kg"),
    ("t", "1e3 kg"),
    ("tonne", "1e3 kg"),
    ("min", "60 s"),
    ("h", "3600 s"),
    ("hour", "3600 s"),
    ("L", "1e-3 m^3"),
    ("l", "1e-3 m^3"),
    ("bar", "1e5 Pa"),
    ("atm", "101325 Pa"),
    ("psi", "6894.757 Pa"),
    ("inch", "0.0254 m"),
    ("ft", "0.3048 m"),
    ("mile", "1609.344 m"),
    ("lb", "0.45359237 kg"),
    ("lbf", "4.448222 N"),
    ("kgf", "9.80665 N"),
    ("cal", "4.184 J"),
    ("eV", "1.602176634e-19 J"),
    ("Wh", "3600 J"),
    ("kWh", "3.6e6 J"),
];

/// Prefixes of multiples.
const PREFIXES: [(&str, &str); 13] = [
    ("k", "1e3"),
    ("M", "1e6"),
    ("G", "1e9"),
    ("T", "1e12"),
    ("h", "100"),
    ("da", "10"),
    ("d", "0.1"),
    ("c", "0.01"),
    ("m", "1e-3"),
    ("u", "1e-6"),
    ("µ", "1e-6"),
    ("n", "1e-9"),
    ("p", "1e-12"),
];

/// A dimension: the exponents of the base units.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Dimension([Rational; 7]);

/// Why a word is no unit here.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Refused {
    /// A multiple of a coherent unit: what one of it is.
    Multiple(String),
    /// Nobody knows it.
    Unknown,
}

impl Default for Dimension {
    fn default() -> Self {
        Self::none()
    }
}

impl Dimension {
    /// That of a pure number.
    #[must_use]
    pub fn none() -> Self {
        Self(std::array::from_fn(|_| Rational::ZERO))
    }

    /// That of a unit by its name.
    ///
    /// # Errors
    /// Why the word is none.
    pub fn named(name: &str) -> Result<Self, Refused> {
        let known = |name: &str| NAMED.iter().find(|(known, _)| *known == name);
        if let Some((_, exponents)) = known(name) {
            return Ok(Self(exponents.map(Rational::from)));
        }
        if let Some((_, is)) = OTHERS.iter().find(|(other, _)| *other == name) {
            return Err(Refused::Multiple((*is).to_owned()));
        }
        let multiple = PREFIXES.iter().find_map(|(prefix, factor)| {
            let unit = name.strip_prefix(prefix)?;
            match unit {
                "g" => Some(format!("{factor} · 1e-3 kg")),
                _ => known(unit).map(|_| format!("{factor} {unit}")),
            }
        });
        Err(multiple.map_or(Refused::Unknown, Refused::Multiple))
    }

    /// Whether it is that of a pure number.
    #[must_use]
    pub fn is_none(&self) -> bool {
        self.0.iter().all(Rational::is_zero)
    }

    /// The dimension of a product with a power of another quantity.
    #[must_use]
    pub fn times(&self, other: &Self, exponent: &Rational) -> Self {
        Self(std::array::from_fn(|k| self.0[k].clone() + other.0[k].clone() * exponent.clone()))
    }

    /// The dimension of a power.
    #[must_use]
    pub fn power(&self, exponent: &Rational) -> Self {
        Self::none().times(self, exponent)
    }

    /// Its factors in base units.
    fn in_base_units(&self) -> Vec<(&'static str, Rational)> {
        let factors = BASE.iter().copied().zip(self.0.iter().cloned());
        factors.filter(|(_, exponent)| !exponent.is_zero()).collect()
    }

    /// Its factors with a named unit in front, where what is left has neither mass nor current.
    fn with(&self, name: &'static str) -> Option<Vec<(&'static str, Rational)>> {
        let unit = Self::named(name).ok()?;
        let rest = self.times(&unit, &Rational::MINUS_ONE);
        if !rest.0[0].is_zero() || !rest.0[3].is_zero() {
            return None;
        }
        let mut factors = vec![(name, Rational::ONE)];
        factors.extend(rest.in_base_units());
        Some(factors)
    }
}

/// What a text costs its reader: the number of factors, and the size of their exponents.
fn cost(factors: &[(&str, Rational)]) -> (usize, Rational) {
    let sizes = factors.iter().fold(Rational::ZERO, |sum, (_, exponent)| sum + exponent.abs());
    (factors.len(), sizes)
}

impl fmt::Display for Dimension {
    /// `kg m² s⁻²` in the shortest way: `J`. A pure number is `1`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut shortest = self.in_base_units();
        for factors in SHOWN.iter().filter_map(|name| self.with(name)) {
            if cost(&factors) < cost(&shortest) {
                shortest = factors;
            }
        }
        if shortest.is_empty() {
            return f.write_str("1");
        }
        for (k, (name, exponent)) in shortest.iter().enumerate() {
            let space = if k == 0 { "" } else { " " };
            let name = if *name == "ohm" { "Ω" } else { name };
            write!(f, "{space}{name}{}", raised(exponent))?;
        }
        Ok(())
    }
}

/// An exponent behind its base: `⁻²`, `^(1/2)`, nothing for 1.
#[must_use]
pub fn raised(exponent: &Rational) -> String {
    if exponent.is_one() {
        return String::new();
    }
    if !exponent.is_integer() {
        return format!("^({exponent})");
    }
    let digits = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let digit = |c: char| c.to_digit(10).map_or('⁻', |digit| digits[digit as usize]);
    exponent.to_string().chars().map(digit).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn product(factors: &[(&str, i64)]) -> Dimension {
        factors.iter().fold(Dimension::none(), |product, (name, exponent)| {
            product.times(&Dimension::named(name).unwrap(), &Rational::from(*exponent))
        })
    }

    #[test]
    fn the_shortest_text() {
        for (factors, text) in [
            (&[("kg", 1), ("m", 1), ("s", -2)][..], "N"),
            (&[("N", 1), ("m", 1)], "J"),
            (&[("kg", 1), ("s", -2)], "N m⁻¹"),
            (&[("m", 1), ("s", -2)], "m s⁻²"),
            (&[("kg", 1), ("m", 2)], "kg m²"),
            (&[("N", 1), ("s", 1)], "N s"),
            (&[("V", 1), ("A", -1)], "Ω"),
            (&[("N", 1), ("m", 1), ("A", -1)], "Wb"),
            (&[("rad", 3)], "1"),
            (&[("s", -1)], "s⁻¹"),
        ] {
            assert_eq!(product(factors).to_string(), text);
        }
        let root = Dimension::named("m").unwrap().power(&Rational::new(1, 2));
        assert_eq!(root.to_string(), "m^(1/2)");
    }

    #[test]
    fn known_units_have_dimensions() {
        for name in UNITS {
            assert!(Dimension::named(name).is_ok(), "{name}");
        }
        assert_eq!(product(&[("W", 1), ("s", 1)]), product(&[("J", 1)]));
        assert_eq!(product(&[("C", 1), ("V", 1)]), product(&[("J", 1)]));
        assert_eq!(product(&[("F", 1), ("V", 1)]), product(&[("C", 1)]));
        assert_eq!(product(&[("T", 1), ("m", 2)]), product(&[("Wb", 1)]));
        assert_eq!(product(&[("H", 1), ("A", 1)]), product(&[("Wb", 1)]));
    }

    #[test]
    fn multiples_are_refused_with_what_they_are() {
        let multiple = |name| match Dimension::named(name) {
            Err(Refused::Multiple(is)) => is,
            other => panic!("{name}: {other:?}"),
        };
        assert_eq!(multiple("mm"), "1e-3 m");
        assert_eq!(multiple("g"), "1e-3 kg");
        assert_eq!(multiple("rpm"), "π/30 rad s^-1");
        assert_eq!(multiple("kN"), "1e3 N");
        assert_eq!(Dimension::named("parsec"), Err(Refused::Unknown));
    }
}

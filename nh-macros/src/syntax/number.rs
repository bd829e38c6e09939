//! Number literals: exact, decimal, without a type.

use super::ast::Number;
use super::limits;
use crate::report::{Diagnostic, Extent};

/// Suffixes that name a Rust type.
const TYPES: [&str; 16] = [
    "f16", "f32", "f64", "f128", "i8", "i16", "i32", "i64", "i128", "isize", "u8", "u16", "u32", "u64",
    "u128", "usize",
];

/// Reads the text of a literal, which may begin with a point.
pub(crate) fn number(text: &str, extent: Extent) -> Result<Number, Diagnostic> {
    if !text.starts_with(|c: char| c.is_ascii_digit() || c == '.') {
        return Err(Diagnostic::new(extent, format!("expected an expression, found {text}"))
            .way_out("expressions are made of numbers and names; text has no place in them"));
    }
    if text.len() > 2 && ["0x", "0o", "0b"].contains(&&text[..2]) {
        return Err(Diagnostic::new(extent, format!("`{text}` is not a decimal number"))
            .way_out("numbers are written in decimal"));
    }
    let parts = Parts::of(text);
    if !parts.suffix.is_empty() {
        return Err(suffix(&parts, extent));
    }
    exact(text, &parts, extent)
}

/// The value of a literal without a suffix.
fn exact(text: &str, parts: &Parts<'_>, extent: Extent) -> Result<Number, Diagnostic> {
    let mut digits = String::new();
    let mut exponent: i64 = 0;
    let mut after_point = false;
    for c in parts.mantissa.chars() {
        match c {
            '.' => after_point = true,
            '_' => {}
            digit => {
                exponent -= i64::from(after_point);
                if !(digits.is_empty() && digit == '0') {
                    digits.push(digit);
                }
            }
        }
    }
    if digits.len() > limits::DIGITS {
        let count = digits.len();
        return Err(Diagnostic::new(extent, format!("a number of {count} digits"))
            .way_out(format!("write at most {} digits", limits::DIGITS)));
    }
    let power: String = parts.power.chars().filter(|c| !"_+".contains(*c)).collect();
    // a power that does not fit is as far out of range as this one
    let power: i64 = if power.is_empty() { 0 } else { power.parse().unwrap_or(i64::from(i32::MAX)) };
    exponent = exponent.saturating_add(power);
    if digits.is_empty() {
        return Ok(Number { text: text.to_owned(), digits: "0".to_owned(), exponent: 0 });
    }
    match i32::try_from(exponent) {
        Ok(exponent) if (-limits::EXPONENT..=limits::EXPONENT).contains(&exponent) => {
            Ok(Number { text: text.to_owned(), digits, exponent })
        }
        _ => Err(Diagnostic::new(extent, "a power of ten far beyond any floating-point number")
            .way_out(format!("keep it between -{0} and {0}", limits::EXPONENT))),
    }
}

/// What to say about letters at the end of a number.
fn suffix(parts: &Parts<'_>, extent: Extent) -> Diagnostic {
    let number = parts.number;
    let suffix = parts.suffix;
    if TYPES.contains(&suffix.trim_start_matches('_')) {
        Diagnostic::new(extent, format!("`{number}{suffix}`: numbers are exact and have no type"))
            .way_out(format!("write `{}`", number.trim_end_matches('_')))
    } else {
        Diagnostic::new(extent, format!("`{number}{suffix}` is a single number to Rust"))
            .way_out(format!("for a product write `{number} * {}`", suffix.trim_matches('·')))
    }
}

/// The parts of a literal.
struct Parts<'a> {
    /// Digits with at most one point.
    mantissa: &'a str,
    /// The digits behind `e`, perhaps with a sign.
    power: &'a str,
    /// All but the suffix.
    number: &'a str,
    /// What follows the number.
    suffix: &'a str,
}

impl<'a> Parts<'a> {
    fn of(text: &'a str) -> Self {
        let mut point = false;
        let end = text
            .find(|c: char| {
                let second_point = c == '.' && point;
                point |= c == '.';
                second_point || !(c.is_ascii_digit() || c == '_' || c == '.')
            })
            .unwrap_or(text.len());
        let (mantissa, tail) = text.split_at(end);
        let mut power = "";
        let mut suffix = tail;
        if let Some(behind) = tail.strip_prefix(['e', 'E']) {
            let sign = usize::from(behind.starts_with(['+', '-']));
            let end = behind[sign..]
                .find(|c: char| !(c.is_ascii_digit() || c == '_'))
                .map_or(behind.len(), |end| end + sign);
            if behind[sign..end].contains(|c: char| c.is_ascii_digit()) {
                (power, suffix) = behind.split_at(end);
            }
        }
        let number = &text[..text.len() - suffix.len()];
        Self { mantissa, power, number, suffix }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proc_macro2::Span;

    fn read(text: &str) -> Result<(String, i32), String> {
        number(text, Extent::at(Span::call_site())).map(|n| (n.digits, n.exponent)).map_err(|e| e.to_string())
    }

    #[test]
    fn numbers_are_exact() {
        for (text, digits, exponent) in [
            ("0", "0", 0),
            ("0.000", "0", 0),
            ("0e5000", "0", 0),
            ("12", "12", 0),
            ("1_000", "1000", 0),
            ("0.5", "5", -1),
            (".5", "5", -1),
            (".05e1", "5", -1),
            ("2.", "2", 0),
            ("1e-3", "1", -3),
            ("1E+3", "1", 3),
            ("1.5e1_0", "15", 9),
            ("007", "7", 0),
        ] {
            assert_eq!(read(text), Ok((digits.to_owned(), exponent)), "{text}");
        }
    }

    #[test]
    fn what_is_no_number_is_refused() {
        for (text, message) in [
            ("1.0f64", "`1.0f64`: numbers are exact and have no type\nhelp: write `1.0`"),
            ("3_usize", "`3_usize`: numbers are exact and have no type\nhelp: write `3`"),
            ("2x", "`2x` is a single number to Rust\nhelp: for a product write `2 * x`"),
            ("2e3m", "`2e3m` is a single number to Rust\nhelp: for a product write `2e3 * m`"),
            ("0x1F", "`0x1F` is not a decimal number\nhelp: numbers are written in decimal"),
            (
                "\"a\"",
                "expected an expression, found \"a\"\nhelp: expressions are made of numbers and \
                 names; text has no place in them",
            ),
            (
                "1e1001",
                "a power of ten far beyond any floating-point number\nhelp: keep it between -1000 \
                 and 1000",
            ),
            (
                "1e-99999999999999999999",
                "a power of ten far beyond any floating-point number\nhelp: keep it between -1000 \
                 and 1000",
            ),
        ] {
            assert_eq!(read(text), Err(message.to_owned()), "{text}");
        }
        // at the ends of the integers
        for power in ["2147483647", "-2147483648", "9223372036854775807", "-9223372036854775808"] {
            for digits in ["1", ".5", "0.5", "1_0.25"] {
                let message = read(&format!("{digits}e{power}")).expect_err(power);
                assert!(message.starts_with("a power of ten far beyond"), "{message}");
            }
        }
        assert_eq!(
            read(&"9".repeat(1001)),
            Err("a number of 1001 digits\nhelp: write at most 1000 digits".to_owned())
        );
    }
}

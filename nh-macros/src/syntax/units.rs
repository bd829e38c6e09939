//! Lines of `units`: names, and the product of units that theirs is.

use proc_macro2::{Delimiter, TokenTree};

use super::ast::{Name, UnitFactor, UnitLine};
use super::items::END;
use super::stream::Stream;
use crate::report::Diagnostic;

/// How a line reads.
const READS: &str =
    "a line of `units` reads `x, y = m;`, with units as in `N m`, `kg*m^2`, `m/s^2`, `m^(1/2)` or `1`";

/// Largest numerator and denominator of an exponent.
const EXPONENT: u32 = 99;

impl Stream {
    /// `x, q[2], lagrangian = kg m^2 s^-2`
    pub(crate) fn unit_line(&mut self) -> Result<UnitLine, Diagnostic> {
        self.docs()?;
        let mut places = Vec::new();
        loop {
            if let Some((of, extent)) = self.der()? {
                let of = of.name.text;
                return Err(Diagnostic::new(extent, "the unit of a rate is not declared: it follows")
                    .way_out(format!("leave it out: it is the unit of `{of}` over that of `t`")));
            }
            places.push(self.place("a declared name").map_err(|error| error.or_way_out(READS))?);
            if !self.eat(",") {
                break;
            }
        }
        self.equals(READS)?;
        let start = self.position();
        let factors = self.unit()?;
        let extent = self.since(start);
        self.end(END).map_err(|error| error.or_way_out(READS))?;
        Ok(UnitLine { places, factors, extent })
    }

    /// A product of units, over one unit or over a product in parentheses.
    fn unit(&mut self) -> Result<Vec<UnitFactor>, Diagnostic> {
        let mut factors = self.unit_product()?;
        if self.eat("/") {
            let below = match self.eat_group(Delimiter::Parenthesis) {
                Some(group) => {
                    let mut inner = self.nested(&group);
                    let below = inner.unit_product()?;
                    inner.end("`)`").map_err(|error| error.or_way_out(READS))?;
                    below
                }
                None => vec![self.unit_factor()?],
            };
            factors.extend(
                below.into_iter().map(|factor| UnitFactor { numerator: -factor.numerator, ..factor }),
            );
            if !self.is_empty() {
                let error = Diagnostic::new(self.here(), "a unit has one `/`, in front of its last factor");
                return Err(
                    error.way_out("write parentheses, as in `kg/(m s)`, or powers, as in `kg m^-1 s^-1`")
                );
            }
        }
        Ok(factors)
    }

    /// `1`, or units one after the other.
    fn unit_product(&mut self) -> Result<Vec<UnitFactor>, Diagnostic> {
        if let Some(TokenTree::Literal(literal)) = self.peek() {
            let extent = self.here();
            if literal.to_string() != "1" {
                let error = Diagnostic::new(extent, format!("the number `{literal}` in a unit"))
                    .evidence("equations are in coherent units: a unit is a product of powers of units");
                return Err(error.way_out("write the unit without it, and give values in that unit"));
            }
            self.advance();
            return Ok(Vec::new());
        }
        let mut factors = vec![self.unit_factor()?];
        while self.eat("*") || matches!(self.peek(), Some(TokenTree::Ident(_))) {
            factors.push(self.unit_factor()?);
        }
        Ok(factors)
    }

    /// `s`, `s^-2`, `m^(1/2)`
    fn unit_factor(&mut self) -> Result<UnitFactor, Diagnostic> {
        let Some(ident) = self.eat_ident() else {
            return Err(self.expected("a unit").way_out(READS));
        };
        let name = Name::new(ident);
        let (numerator, denominator) = if self.eat("^") { self.unit_exponent()? } else { (1, 1) };
        Ok(UnitFactor { name, numerator, denominator })
    }

    /// `2`, `-2`, `(1/2)`, `(-1/2)`
    fn unit_exponent(&mut self) -> Result<(i64, i64), Diagnostic> {
        if let Some(group) = self.eat_group(Delimiter::Parenthesis) {
            let mut inner = self.nested(&group);
            let numerator = inner.unit_integer()?;
            let denominator = if inner.eat("/") { inner.unit_integer()? } else { 1 };
            inner.end("`)`").map_err(|error| error.or_way_out(READS))?;
            if denominator <= 0 {
                return Err(Diagnostic::new(inner.whole(), "a denominator is positive").way_out(READS));
            }
            return Ok((numerator, denominator));
        }
        Ok((self.unit_integer()?, 1))
    }

    fn unit_integer(&mut self) -> Result<i64, Diagnostic> {
        let sign = if self.eat("-") { -1 } else { 1 };
        let at = self.here();
        let value = self.integer("an exponent").map_err(|error| error.or_way_out(READS))?;
        if value > EXPONENT {
            return Err(Diagnostic::new(at, "this exponent is too large").way_out(READS));
        }
        Ok(sign * i64::from(value))
    }
}

//! Indices and bounds: integers that are known while the declaration is read.

use nonholonomic_core::id::ExprId;

use super::reports::{Outcome, Reported};
use super::resolver::Resolver;
use super::scope::Meaning;
use crate::report::{Diagnostic, Extent};
use crate::syntax::ast::{Expr, ExprKind, Factor, Name, Number, Sign};

impl Resolver {
    /// The value of an index or of the bound of a range.
    pub(super) fn index(&mut self, expr: &Expr) -> Outcome<i64> {
        self.reports.visit(expr)?;
        match &expr.kind {
            ExprKind::Number(number) => match integer(number) {
                Some(value) => Ok(value),
                None => Err(self.no_index(expr, format!("`{}` is no integer, or too large", number.text))),
            },
            ExprKind::Name(name) => self.named_index(expr, name),
            ExprKind::Negate(inner) => {
                let value = self.index(inner)?;
                self.fits(expr, value.checked_neg())
            }
            ExprKind::Add(terms) => {
                let mut sum = 0_i64;
                for (sign, term) in terms {
                    let value = self.index(term)?;
                    let next = match sign {
                        Sign::Plus => sum.checked_add(value),
                        Sign::Minus => sum.checked_sub(value),
                    };
                    sum = self.fits(expr, next)?;
                }
                Ok(sum)
            }
            ExprKind::Multiply(factors) if factors.iter().all(|(kind, _)| *kind == Factor::Times) => {
                let mut product = 1_i64;
                for (_, factor) in factors {
                    let next = product.checked_mul(self.index(factor)?);
                    product = self.fits(expr, next)?;
                }
                Ok(product)
            }
            _ => Err(self.no_index(expr, "this is something else".to_owned())),
        }
    }

    fn named_index(&mut self, expr: &Expr, name: &Name) -> Outcome<i64> {
        match self.scope.get(&name.text).cloned() {
            Some(Meaning::Index(value)) => Ok(value),
            Some(Meaning::Shared(place)) => {
                let value = self.shared_value(place, name)?;
                self.integer_of(expr, name, value.as_number())
            }
            Some(Meaning::Function(place)) => Err(self.bare_function(place, expr, name)),
            Some(Meaning::Broken) => Err(Reported),
            Some(meaning @ (Meaning::Value(_) | Meaning::Argument(_) | Meaning::Constant(_))) => {
                let entry = match &meaning {
                    Meaning::Constant(constant) => constant.values.as_number(),
                    Meaning::Value(value) | Meaning::Argument(value) => value.as_number(),
                    _ => None,
                };
                self.integer_of(expr, name, entry)
            }
            Some(Meaning::Named(named)) => {
                Err(self.no_index(expr, format!("`{}` is {}", name.text, named.role.noun())))
            }
            Some(Meaning::Time | Meaning::Pi) => {
                Err(self.no_index(expr, format!("`{}` is no integer", name.text)))
            }
            None => {
                let error = self.scope.unknown(name);
                Err(self.reports.report_unknown(expr, &name.text, error))
            }
        }
    }

    /// The integer that a named number is.
    fn integer_of(&mut self, expr: &Expr, name: &Name, entry: Option<ExprId>) -> Outcome<i64> {
        match entry.and_then(|entry| self.graph.value_of(entry)?.to_i64()) {
            Some(number) => Ok(number),
            None => Err(self.no_index(expr, format!("`{}` is not an integer", name.text))),
        }
    }

    fn fits(&mut self, expr: &Expr, value: Option<i64>) -> Outcome<i64> {
        value.ok_or_else(|| self.report(expr, Diagnostic::new(expr.extent, "this index is too large")))
    }

    fn no_index(&mut self, expr: &Expr, evidence: String) -> Reported {
        let error = Diagnostic::new(expr.extent, "an index or bound must be an integer known here")
            .evidence(evidence)
            .way_out("write it with integers and loop variables: `i`, `i + 1`, `3 - i`");
        self.report(expr, error)
    }

    /// An index that must not be negative, as on the left-hand side of a definition.
    pub(super) fn new_index(&mut self, expr: &Expr, at: Extent) -> Outcome<usize> {
        let value = self.index(expr)?;
        let limit = crate::syntax::limits::FAMILY as usize;
        match usize::try_from(value).ok().filter(|value| *value < limit) {
            Some(value) => Ok(value),
            None => Err(self.report(
                expr,
                Diagnostic::new(at, format!("the index {value} is out of range"))
                    .way_out(format!("indices count from 0, and there are at most {limit} entries")),
            )),
        }
    }
}

/// The integer that a literal stands for.
fn integer(number: &Number) -> Option<i64> {
    let exponent = u32::try_from(number.exponent).ok()?;
    number.digits.parse::<i64>().ok()?.checked_mul(10_i64.checked_pow(exponent)?)
}

//! Products of numbers, vectors and matrices.

use nonholonomic_core::algebra::Rational;
use nonholonomic_core::id::ExprId;
use nonholonomic_core::model::Located;

use super::array::{Array, Shape};
use super::reports::Outcome;
use super::resolver::Resolver;
use crate::report::Diagnostic;
use crate::syntax::ast::{Expr, Factor};

/// Entries of a diagonal that an error writes out.
const FEW: usize = 4;

impl Resolver {
    /// `a * b / c`: the numbers among the factors scale the product of the others.
    pub(super) fn product(&mut self, expr: &Expr, factors: &[(Factor, Expr)]) -> Outcome<Array> {
        let values: Vec<_> = factors.iter().map(|(_, factor)| self.value(factor)).collect();
        let values = values.into_iter().collect::<Outcome<Vec<_>>>()?;
        let mut numbers: Vec<(ExprId, Rational)> = Vec::new();
        let mut places: Vec<&Expr> = Vec::new();
        let mut arrays: Vec<(&Expr, Array)> = Vec::new();
        for ((kind, factor), value) in factors.iter().zip(values) {
            if value.as_number().is_some() {
                places.push(factor);
            }
            match (kind, value.as_number()) {
                (Factor::Times, Some(number)) => numbers.push((number, Rational::ONE)),
                (Factor::Over, Some(number)) if self.graph.is_literal_zero(number) => {
                    let error = Diagnostic::new(factor.extent, "a division by zero")
                        .evidence("this denominator is 0 at all times")
                        .way_out("write one that is not");
                    return Err(self.report(factor, error));
                }
                (Factor::Over, Some(number)) => numbers.push((number, Rational::MINUS_ONE)),
                (Factor::Times, None) => arrays.push((factor, value)),
                (Factor::Over, None) => {
                    let error = Diagnostic::new(factor.extent, format!("a division by {}", value.shape))
                        .way_out("divide by numbers only");
                    return Err(self.report(factor, error));
                }
            }
        }
        let scale = self.product_of(expr, &numbers)?;
        if self.graph.is_literal_zero(scale) {
            self.drop_factors(&numbers, &places);
        }
        // from the right, so that matrices act on the vector behind them
        let Some((mut right, mut product)) = arrays.pop() else { return Ok(Array::number(scale)) };
        while let Some((left, factor)) = arrays.pop() {
            product = self.pair(expr, (left, &factor), (right, &product))?;
            right = left;
        }
        if numbers.is_empty() {
            return Ok(product);
        }
        self.entrywise(product, |this, entry| this.times(expr, scale, entry))
    }

    /// Keeps the factors of a product that is 0 for the checks: `0 / 0` in disguise is no 0.
    fn drop_factors(&mut self, numbers: &[(ExprId, Rational)], places: &[&Expr]) {
        for ((base, exponent), place) in numbers.iter().zip(places) {
            let value = self.graph.pow(*base, exponent.clone());
            if self.graph.as_number(value).is_none() && self.graph.as_symbol(*base).is_none() {
                let origin = self.origin(place.extent);
                self.dropped.push(Located { value, origin });
            }
        }
    }

    /// The product of two arrays, none of them a number.
    fn pair(&mut self, expr: &Expr, left: (&Expr, &Array), right: (&Expr, &Array)) -> Outcome<Array> {
        let ((at, a), (_, b)) = (left, right);
        match (a.shape, b.shape) {
            (Shape::Matrix(_, columns), Shape::Vector(n)) if columns == n => {
                let rows = a.entries.chunks(columns.max(1));
                let entries: Outcome<Vec<_>> =
                    rows.map(|row| self.inner_product(expr, row, &b.entries)).collect();
                Ok(Array::vector(entries?))
            }
            (Shape::Matrix(rows, inner), Shape::Matrix(n, columns)) if inner == n => {
                let mut entries = Vec::with_capacity(rows * columns);
                let right: Vec<_> = (0..columns).map(|j| b.column(j)).collect();
                for row in a.entries.chunks(inner.max(1)) {
                    for column in &right {
                        entries.push(self.inner_product(expr, row, column)?);
                    }
                }
                let product = Array { shape: Shape::Matrix(rows, columns), entries };
                self.rotations.multiplied(a, b, &product);
                Ok(product)
            }
            (Shape::Matrix(_, columns), Shape::Vector(n) | Shape::Matrix(n, _)) => {
                let error =
                    Diagnostic::new(at.extent.to(right.0.extent), "the shapes of this product do not match")
                        .evidence(format!(
                            "{columns} columns meet {n} entries: {} times {}",
                            a.shape, b.shape
                        ));
                Err(self.report(at, error))
            }
            (Shape::Vector(n), Shape::Vector(_)) => {
                let entries: Vec<String> = (0..n.min(FEW)).map(|i| format!("I[{i}]")).collect();
                let others = if n > FEW { ", …" } else { "" };
                let error = Diagnostic::new(at.extent.to(right.0.extent), "the product of two vectors")
                    .way_out(format!(
                        "write `dot(u, v)` or `cross(u, v)`; a diagonal inertia is `diag({}{others}) * w`",
                        entries.join(", ")
                    ));
                Err(self.report(at, error))
            }
            _ => {
                let error =
                    Diagnostic::new(at.extent.to(right.0.extent), format!("{} times {}", a.shape, b.shape))
                        .way_out("write the matrix first: `A * v`");
                Err(self.report(at, error))
            }
        }
    }
}

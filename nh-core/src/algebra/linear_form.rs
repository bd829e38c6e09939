//! Expressions that are linear in some symbols, taken apart.

use super::graph::Graph;
use super::substitute::Substitution;
use super::verdict::Verdict;
use crate::id::{ExprId, SymbolId};
use crate::limits;

/// `Σ coefficients[i] · variables[i] + rest`; neither depends on the variables.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LinearForm {
    /// A coefficient for each variable.
    pub coefficients: Vec<ExprId>,
    /// The value where all variables vanish.
    pub rest: ExprId,
}

/// Why an expression is not a linear form.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NotLinear {
    /// The derivative with respect to one variable still depends on another (or the same).
    Curved(SymbolId, SymbolId),
    /// Whether it is linear could not be decided, and why.
    Unknown(String),
}

impl Graph {
    /// Takes `expression` apart as a form that is linear, not necessarily homogeneous, in the
    /// variables.
    ///
    /// # Errors
    /// Where it is not linear.
    pub fn linear_form(
        &mut self,
        expression: ExprId,
        variables: &[SymbolId],
    ) -> Result<LinearForm, NotLinear> {
        let mut coefficients = Vec::with_capacity(variables.len());
        // sorted
        let occurring = self.symbols_in(&[expression]);
        let zero = self.zero();
        limits::spend(variables.len());
        for &variable in variables {
            if occurring.binary_search(&variable).is_err() {
                coefficients.push(zero);
                continue;
            }
            let coefficient = self.partial(expression, variable);
            coefficients.push(self.freed_from(coefficient, variable, variables)?);
        }
        let rest = self.at_zero(expression, variables);
        Ok(LinearForm { coefficients, rest })
    }

    /// A derivative rewritten so that the variables do not occur in it.
    fn freed_from(
        &mut self,
        coefficient: ExprId,
        by: SymbolId,
        variables: &[SymbolId],
    ) -> Result<ExprId, NotLinear> {
        if !self.depends_on(coefficient, variables) {
            return Ok(coefficient);
        }
        let simple = self.simplify(coefficient);
        if !self.depends_on(simple, variables) {
            return Ok(simple);
        }
        for &variable in variables {
            let second = self.partial(simple, variable);
            match self.zero_test(second) {
                Verdict::Zero => {}
                Verdict::NonZero(_) => return Err(NotLinear::Curved(by, variable)),
                Verdict::Unknown(why) => return Err(NotLinear::Unknown(why)),
            }
        }
        let freed = self.at_zero(simple, variables);
        if self.is_undefined(freed) {
            return Err(NotLinear::Unknown("it has no value where the velocities vanish".into()));
        }
        Ok(freed)
    }

    /// The value where the variables vanish.
    pub fn at_zero(&mut self, expression: ExprId, variables: &[SymbolId]) -> ExprId {
        let zero = self.zero();
        Substitution::new(variables.iter().map(|variable| (*variable, zero))).apply(self, expression)
    }

    /// Whether a division by the number 0 occurs.
    #[must_use]
    pub fn is_undefined(&self, expression: ExprId) -> bool {
        self.reachable(&[expression]).into_iter().any(|id| self.divides_by_zero(id))
    }

    fn divides_by_zero(&self, id: ExprId) -> bool {
        match self.node(id) {
            super::Node::Product { factors, .. } => {
                factors.iter().any(|(base, exponent)| exponent.is_negative() && self.is_literal_zero(*base))
            }
            super::Node::Apply(super::Function::Ln, x) => self.is_literal_zero(*x),
            _ => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn takes_apart_what_is_linear() {
        let mut g = Graph::new();
        let (x, v, w) = (g.new_symbol("x"), g.new_symbol("v"), g.new_symbol("w"));
        let (ex, ev, ew) = (g.symbol(x), g.symbol(v), g.symbol(w));
        // (v + w)^2 - v^2 - w^2 - 2 v w + x v + 3
        let sum = g.add(ev, ew);
        let squares = [g.square(sum), g.square(ev), g.square(ew), g.mul(ev, ew), g.mul(ex, ev), g.number(3)];
        let e = g.linear_combination(&[
            (1.into(), squares[0]),
            ((-1).into(), squares[1]),
            ((-1).into(), squares[2]),
            ((-2).into(), squares[3]),
            (1.into(), squares[4]),
            (1.into(), squares[5]),
        ]);
        let form = g.linear_form(e, &[v, w]).unwrap();
        assert_eq!(form.coefficients[0], ex);
        assert!(g.zero_test(form.coefficients[1]).is_zero());
        assert_eq!(form.rest, squares[5]);
        assert_eq!(g.linear_form(squares[3], &[v, w]), Err(NotLinear::Curved(v, w)));
    }
}

//! How large the terms are that a result is the sum of: what is left of an equation is rounding beside them.

use super::step::{Program, Step, Value};
use crate::algebra::Function;
use crate::id::Table;
use std::collections::BTreeMap;

impl Program {
    /// The program with further outputs: for each of the given ones what it is with the absolute values of all terms, those of
    /// factors and numerators among them.
    #[must_use]
    pub fn with_sizes_of(mut self, outputs: &[Value]) -> Self {
        let has_terms = self.with_terms(outputs);
        let mut sizes = Sizes { program: &mut self, known: BTreeMap::new() };
        for value in has_terms {
            sizes.add(value);
        }
        let found: Vec<Value> = outputs.iter().map(|output| sizes.of(*output)).collect();
        self.outputs.extend(found);
        self
    }

    /// What has terms among some values, their terms, and the factors and numerators of all these.
    fn with_terms(&self, values: &[Value]) -> Vec<Value> {
        let mut has_terms: Table<Value, bool> = Table::new();
        for step in &self.steps {
            let has = match step {
                Step::Add(..) | Step::Sub(..) | Step::MulAdd { .. } => true,
                Step::Mul(a, b) => has_terms[*a] || has_terms[*b],
                Step::Neg(a) | Step::Div(a, _) => has_terms[*a],
                _ => false,
            };
            has_terms.push(has);
        }
        let mut wanted: Table<Value, bool> = self.steps.iter().map(|_| false).collect();
        for value in values {
            wanted[*value] = has_terms[*value];
        }
        for value in self.steps.ids().rev() {
            if !wanted[value] {
                continue;
            }
            let numerators = match self.steps[value] {
                Step::Div(a, _) => vec![a],
                ref step => step.operands(),
            };
            for operand in numerators {
                wanted[operand] |= has_terms[operand];
            }
        }
        self.steps.ids().filter(|value| wanted[*value]).collect()
    }
}

/// The sizes that are known, as steps of the program.
struct Sizes<'p> {
    program: &'p mut Program,
    known: BTreeMap<Value, Value>,
}

impl Sizes<'_> {
    /// The size of what has terms, from the sizes of its operands.
    fn add(&mut self, value: Value) {
        let size = match self.program.steps[value].clone() {
            Step::Add(a, b) | Step::Sub(a, b) => Step::Add(self.of(a), self.of(b)),
            Step::Mul(a, b) => Step::Mul(self.of(a), self.of(b)),
            Step::MulAdd { a, b, c, .. } => {
                let [a, b, c] = [a, b, c].map(|operand| self.of(operand));
                Step::MulAdd { a, b, c, minus_product: false, minus_c: false }
            }
            Step::Div(a, b) => Step::Div(self.of(a), self.absolute(b)),
            Step::Neg(a) => {
                let size = self.of(a);
                self.known.insert(value, size);
                return;
            }
            other => other,
        };
        let size = self.program.steps.push(size);
        self.known.insert(value, size);
    }

    fn of(&mut self, value: Value) -> Value {
        if let Some(size) = self.known.get(&value) {
            return *size;
        }
        let size = self.absolute(value);
        self.known.insert(value, size);
        size
    }

    fn absolute(&mut self, of: Value) -> Value {
        self.program.steps.push(Step::Apply(Function::Abs, of))
    }
}

#[cfg(test)]
mod tests {
    use crate::algebra::Graph;
    use crate::mechanics::Procedure;
    use crate::program::{interpret, schedule};

    #[test]
    fn terms_are_added_up_without_their_signs() {
        let mut graph = Graph::new();
        let symbols = ["a", "b", "c"].map(|name| graph.new_symbol(name));
        let [a, b, c] = symbols.map(|symbol| graph.symbol(symbol));
        let formulas = [
            graph.formula(a * b - 2 * c),
            graph.formula(a - b - c),
            graph.formula(a * (b - c)),
            a,
            graph.formula(-a),
        ];
        let program = schedule(&graph, &Procedure::of(formulas.to_vec()));
        let outputs = program.outputs.clone();
        let program = program.with_sizes_of(&outputs);
        let value = |symbol| match symbols.iter().position(|known| *known == symbol) {
            Some(0) => 3.0,
            Some(1) => -5.0,
            _ => -7.0,
        };
        let found: Vec<f64> = interpret(&program, value);
        assert_eq!(found, [-1.0, 15.0, 6.0, 3.0, -3.0, 29.0, 15.0, 36.0, 3.0, 3.0]);
    }
}

//! Programs as text, a line for each step that computes something.

use super::step::{Program, Step, Value};
use crate::algebra::Graph;
use crate::id::Id;
use std::fmt::Write;

impl Program {
    /// The steps with the names of the graph's symbols: numbers and symbols stand where they are used.
    #[must_use]
    pub fn text(&self, graph: &Graph) -> String {
        let name = |value: &Value| -> String {
            match &self.steps[*value] {
                Step::Constant(number) => number.to_string(),
                Step::Pi => "pi".into(),
                Step::Load(symbol) => graph.symbols()[*symbol].clone(),
                _ => match self.names.get(value) {
                    Some(symbol) => graph.symbols()[*symbol].clone(),
                    None => format!("s{}", value.index()),
                },
            }
        };
        let list = |values: &[Value]| values.iter().map(name).collect::<Vec<_>>().join(", ");
        let mut text = String::new();
        for (value, step) in self.steps.iter_ids().filter(|(_, step)| !step.is_leaf()) {
            let right = match step {
                Step::Constant(_) | Step::Pi | Step::Load(_) => continue,
                Step::Add(a, b) => format!("{} + {}", name(a), name(b)),
                Step::Sub(a, b) => format!("{} - {}", name(a), name(b)),
                Step::Mul(a, b) => format!("{} * {}", name(a), name(b)),
                Step::MulAdd { a, b, c, minus_product, minus_c } => {
                    let signs = [*minus_product, *minus_c].map(|minus| if minus { "-" } else { "" });
                    format!("mul_add({}{}, {}, {}{})", signs[0], name(a), name(b), signs[1], name(c))
                }
                Step::Div(a, b) => format!("{} / {}", name(a), name(b)),
                Step::Neg(a) => format!("-{}", name(a)),
                Step::Recip(a) => format!("1 / {}", name(a)),
                Step::Sqrt(a) => format!("sqrt({})", name(a)),
                Step::Cbrt(a) => format!("cbrt({})", name(a)),
                Step::PowReal(a, exponent) => format!("{}^({exponent})", name(a)),
                Step::SinCos(a) => format!("sin_cos({})", name(a)),
                Step::SinOf(a) => format!("{}.sin", name(a)),
                Step::CosOf(a) => format!("{}.cos", name(a)),
                Step::Apply(function, a) => format!("{}({})", function.name(), name(a)),
                Step::Apply2(function, a, b) => format!("{}({}, {})", function.name(), name(a), name(b)),
                Step::Call { method, arguments } => format!("self.{method}({})", list(arguments)),
                Step::Solve { matrix, right } => {
                    let rows: Vec<String> = matrix.iter().map(|row| format!("[{}]", list(row))).collect();
                    format!("solve([{}], [{}])", rows.join(", "), list(right))
                }
                Step::Component(a, index) => format!("{}[{index}]", name(a)),
            };
            // writing to a string does not fail
            let _ = writeln!(text, "{} = {right}", name(&value));
        }
        let _ = writeln!(text, "-> {}", list(&self.outputs));
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::Procedure;
    use crate::program::schedule;

    #[test]
    fn steps_are_written_with_the_names_of_the_symbols() {
        let mut g = Graph::new();
        let [x, m] = ["x", "m"].map(|name| {
            let symbol = g.new_symbol(name);
            g.symbol(symbol)
        });
        let (sine, cosine) = (g.sin(x), g.cos(x));
        let quotient = g.formula(sine / m);
        let program = schedule(&g, &Procedure::of(vec![quotient, cosine]));
        let text = program.text(&g);
        assert!(
            text.contains("sin_cos(x)")
                && text.contains("/ m")
                && text.lines().last().unwrap().starts_with("-> s"),
            "{text}"
        );
    }
}

//! Programs as text, a line for each step that computes something.

use super::step::{Program, Step, Value};
use crate::algebra::Graph;
use crate::id::Id;
use std::collections::BTreeMap;
use std::fmt::Write;

impl Program {
    /// The steps with the names of the graph's symbols: numbers and symbols stand where they are used.
    #[must_use]
    pub fn text(&self, graph: &Graph) -> String {
        let names = self.names_in_text(graph);
        let name = |value: &Value| names[value].clone();
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

    /// What each value is called: by its symbol or its place, numbered where that was a name before.
    fn names_in_text(&self, graph: &Graph) -> BTreeMap<Value, String> {
        let mut taken: BTreeMap<String, usize> = BTreeMap::new();
        let mut names = BTreeMap::new();
        let (leaves, others): (Vec<_>, Vec<_>) = self.steps.iter_ids().partition(|(_, step)| step.is_leaf());
        for (value, step) in leaves {
            let name = match step {
                Step::Load(symbol) => graph.symbols()[*symbol].clone(),
                Step::Constant(number) => number.to_string(),
                _ => "pi".into(),
            };
            taken.insert(name.clone(), 1);
            names.insert(value, name);
        }
        for (value, _) in others {
            let symbol = self.names.get(&value).map(|symbol| graph.symbols()[*symbol].clone());
            let stem = symbol.unwrap_or_else(|| format!("s{}", value.index()));
            let mut name = stem.clone();
            while taken.contains_key(&name) {
                let count = taken.entry(stem.clone()).or_insert(1);
                *count += 1;
                name = format!("{stem}_{count}");
            }
            taken.insert(name.clone(), 1);
            names.insert(value, name);
        }
        names
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

    #[test]
    fn no_name_is_given_twice() {
        let mut g = Graph::new();
        let [x, y, moved] = ["x", "y", "moved"].map(|name| {
            let symbol = g.new_symbol(name);
            g.symbol(symbol)
        });
        let mut procedure = Procedure::default();
        let [first, second] = [x, y].map(|variable| {
            let square = g.formula(variable * variable + moved);
            procedure.define(&mut g, "moved", square)
        });
        procedure.outputs = vec![g.formula(first * second + first), g.formula(first * second + second)];
        let text = schedule(&g, &procedure).text(&g);
        let mut names: Vec<&str> = text.lines().filter_map(|line| Some(line.split_once(" = ")?.0)).collect();
        let count = names.len();
        names.sort_unstable();
        names.dedup();
        assert!(names.len() == count && names.contains(&"moved_2") && !names.contains(&"moved"), "{text}");
    }
}

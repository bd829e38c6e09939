//! The Hamiltonian side as lines of text.

use super::shown;
use crate::algebra::Graph;
use crate::findings::{BracketEntries, Jacobi};
use crate::id::SymbolId;

/// Momenta, h, and the brackets that do not vanish.
pub(crate) fn hamiltonian_lines(graph: &Graph, found: &BracketEntries) -> Vec<String> {
    let name = |symbol: SymbolId| graph.symbols()[symbol].as_str();
    let mut lines = Vec::new();
    for (symbol, momentum) in &found.momenta {
        lines.push(format!("{} = {}", name(*symbol), shown(graph, *momentum)));
    }
    lines.push(format!("{} = {}", graph.free_name("h"), shown(graph, found.hamiltonian)));
    for (first, second, value) in &found.brackets {
        lines.push(format!("{{{}, {}}} = {}", name(*first), name(*second), shown(graph, *value)));
    }
    lines.extend(found.jacobi.map(|jacobi| match jacobi {
        Jacobi::Holds => "the bracket satisfies the Jacobi identity: it is one of Poisson".to_owned(),
        Jacobi::Violated(functions, defect) => {
            let [a, b, c] = functions.map(name);
            format!(
                "the bracket violates the Jacobi identity: {{{a}, {{{b}, {c}}}}} and its cyclic permutations add up to \
                 {}",
                shown(graph, defect)
            )
        }
    }));
    for (symbol, rest) in &found.rests {
        lines.push(format!("R_L({}) = {}", name(*symbol), shown(graph, *rest)));
    }
    lines
}

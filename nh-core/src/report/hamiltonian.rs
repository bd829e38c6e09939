//! The Hamiltonian side as lines of text.

use super::shown;
use crate::algebra::Graph;
use crate::id::{ExprId, SymbolId};
use crate::mechanics::HamiltonianSide;
use crate::model::Model;

/// Momenta, h, and the brackets that do not vanish.
pub(crate) fn hamiltonian_lines(model: &mut Model, side: &HamiltonianSide) -> Vec<String> {
    let coordinates: Vec<SymbolId> = model.coordinates.iter().map(|coordinate| coordinate.symbol).collect();
    let graph = &mut model.graph;
    let mut lines = Vec::new();
    for (symbol, momentum) in side.momenta.iter().zip(&side.legendre.outputs) {
        lines.push(format!("{} = {}", graph.symbols()[*symbol], shown(graph, *momentum)));
    }
    let simplified = |graph: &mut Graph, value: ExprId| {
        let value = graph.simplify(value);
        shown(graph, value)
    };
    let energy = side.hamiltonian.written_out(graph)[0];
    lines.push(format!("h = {}", simplified(graph, energy)));
    let names: Vec<SymbolId> = coordinates.iter().chain(&side.momenta).copied().collect();
    let entries = side.bracket.written_out(graph);
    for (row, first) in names.iter().enumerate() {
        for (column, second) in names.iter().enumerate().skip(row + 1) {
            let entry = entries[row * names.len() + column];
            if !graph.zero_test(entry).is_zero() {
                let value = simplified(graph, entry);
                lines.push(format!(
                    "{{{}, {}}} = {value}",
                    graph.symbols()[*first],
                    graph.symbols()[*second]
                ));
            }
        }
    }
    let rests = side.drift.written_out(graph);
    for (name, rest) in names.iter().zip(rests) {
        if !graph.zero_test(rest).is_zero() {
            let value = simplified(graph, rest);
            lines.push(format!("R_L({}) = {value}", graph.symbols()[*name]));
        }
    }
    lines
}

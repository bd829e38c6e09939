//! The Hamiltonian side as lines of text.

use super::shown;
use crate::algebra::{Derivation, Graph, Verdict};
use crate::geometry::Manifold;
use crate::id::{ExprId, SymbolId};
use crate::mechanics::HamiltonianSide;
use crate::model::Model;

/// Momenta, h, and the brackets that do not vanish.
pub(crate) fn hamiltonian_lines(model: &mut Model, side: &HamiltonianSide, base: &Manifold) -> Vec<String> {
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
    let name = graph.free_name("h");
    lines.push(format!("{name} = {}", simplified(graph, energy)));
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
    lines.extend(jacobi(graph, &names, &entries, base));
    let rests = side.drift.written_out(graph);
    for (name, rest) in names.iter().zip(rests) {
        if !graph.zero_test(rest).is_zero() {
            let value = simplified(graph, rest);
            lines.push(format!("R_L({}) = {value}", graph.symbols()[*name]));
        }
    }
    lines
}

/// Brackets with more operations than this are not put to the Jacobi identity.
const JUDGED_UP_TO: u64 = 2_000;

/// Whether the bracket is one of Poisson: where it is not, three functions that show it.
fn jacobi(graph: &mut Graph, names: &[SymbolId], entries: &[ExprId], base: &Manifold) -> Option<String> {
    if graph.operation_count(entries) > JUDGED_UP_TO {
        return None;
    }
    let size = names.len();
    // z ↦ {z_i, z}
    let mut fields: Vec<Derivation> = entries
        .chunks(size.max(1))
        .map(|row| Derivation::new(names.iter().copied().zip(row.iter().copied())))
        .collect();
    for i in 0..size {
        for j in i + 1..size {
            for k in j + 1..size {
                let cyclic = [(i, j, k), (j, k, i), (k, i, j)]
                    .map(|(a, b, c)| fields[a].apply(graph, entries[b * size + c]));
                let defect = graph.sum(&cyclic);
                match base.zero_test(graph, defect) {
                    Verdict::Zero => {}
                    Verdict::NonZero(_) => {
                        let defect = graph.simplify(defect);
                        let [a, b, c] = [i, j, k].map(|index| &graph.symbols()[names[index]]);
                        return Some(format!(
                            "the bracket violates the Jacobi identity: {{{a}, {{{b}, {c}}}}} and its cyclic \
                             permutations add up to {}",
                            shown(graph, defect)
                        ));
                    }
                    Verdict::Unknown(_) => return None,
                }
            }
        }
    }
    Some("the bracket satisfies the Jacobi identity: it is one of Poisson".into())
}

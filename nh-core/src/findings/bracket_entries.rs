//! The Hamiltonian side with its brackets written out, and whether they obey the Jacobi identity.

use crate::algebra::{Derivation, Graph, Verdict};
use crate::geometry::Manifold;
use crate::id::{ExprId, SymbolId};
use crate::mechanics::HamiltonianSide;
use crate::model::Model;

/// Brackets with more operations than this are not put to the Jacobi identity.
const JUDGED_UP_TO: u64 = 2_000;

/// h, the brackets of coordinates and momenta, and what no bracket gives.
#[derive(Clone, Debug)]
pub(crate) struct BracketEntries {
    /// Each momentum in the velocities.
    pub(crate) momenta: Vec<(SymbolId, ExprId)>,
    /// h.
    pub(crate) hamiltonian: ExprId,
    /// {z_i, z_j} for i < j that do not vanish.
    pub(crate) brackets: Vec<(SymbolId, SymbolId, ExprId)>,
    /// Whether they obey the Jacobi identity; `None` where it was not decided.
    pub(crate) jacobi: Option<Jacobi>,
    /// R_L(z_i) that do not vanish.
    pub(crate) rests: Vec<(SymbolId, ExprId)>,
}

/// Whether a bracket is one of Poisson.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Jacobi {
    /// It is.
    Holds,
    /// {a, {b, c}} and its cyclic permutations add up to something else than 0.
    Violated([SymbolId; 3], ExprId),
}

impl BracketEntries {
    /// Writes them out.
    pub(crate) fn of(model: &mut Model, side: &HamiltonianSide, base: &Manifold) -> Self {
        let coordinates: Vec<SymbolId> =
            model.coordinates.iter().map(|coordinate| coordinate.symbol).collect();
        let graph = &mut model.graph;
        let momenta = side.momenta.iter().copied().zip(side.legendre.outputs.iter().copied()).collect();
        let energy = side.hamiltonian.written_out(graph)[0];
        let hamiltonian = graph.simplify(energy);
        let names: Vec<SymbolId> = coordinates.iter().chain(&side.momenta).copied().collect();
        let entries = side.bracket.written_out(graph);
        let mut brackets = Vec::new();
        for (row, first) in names.iter().enumerate() {
            for (column, second) in names.iter().enumerate().skip(row + 1) {
                let entry = entries[row * names.len() + column];
                if !graph.zero_test(entry).is_zero() {
                    brackets.push((*first, *second, graph.simplify(entry)));
                }
            }
        }
        let jacobi = jacobi(graph, &names, &entries, base);
        let mut rests = Vec::new();
        for (name, rest) in names.iter().zip(side.drift.written_out(graph)) {
            if !graph.zero_test(rest).is_zero() {
                rests.push((*name, graph.simplify(rest)));
            }
        }
        Self { momenta, hamiltonian, brackets, jacobi, rests }
    }
}

/// Whether the bracket is one of Poisson: where it is not, three functions that show it.
fn jacobi(graph: &mut Graph, names: &[SymbolId], entries: &[ExprId], base: &Manifold) -> Option<Jacobi> {
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
                        return Some(Jacobi::Violated([i, j, k].map(|index| names[index]), defect));
                    }
                    Verdict::Unknown(_) => return None,
                }
            }
        }
    }
    Some(Jacobi::Holds)
}

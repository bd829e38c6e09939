//! Hamel symbols: brackets derived from an injective anchor or from a coframe.

use super::anchor::Anchor;
use super::structure::StructureFunctions;
use crate::algebra::{Derivation, Graph, Matrix};
use crate::id::{ExprId, Id, SectionId, SymbolId};

/// `[ρ_α, ρ_β]` as vector fields on M: `ρ^j_α ∂_jρ^i_β − ρ^j_β ∂_jρ^i_α`, the left side of
/// mathematics (2).
pub fn commutator(graph: &mut Graph, anchor: &Anchor, alpha: SectionId, beta: SectionId) -> Vec<ExprId> {
    let (mut along_alpha, mut along_beta) = (anchor.along(alpha), anchor.along(beta));
    anchor
        .entries
        .iter()
        .map(|row| {
            let forth = along_alpha.apply(graph, row[beta.index()]);
            let back = along_beta.apply(graph, row[alpha.index()]);
            graph.sub(forth, back)
        })
        .collect()
}

/// The structure functions that mathematics (2) determines where the anchor has full column rank:
/// `ρ C_{αβ} = [ρ_α, ρ_β]`, solved on coordinates whose rows of ρ are independent.
///
/// Where there are more coordinates than sections, the remaining rows are left to the check of (2).
/// `None` if the anchor is not injective at generic points.
///
/// # Errors
/// The reason, where the rank cannot be decided.
pub fn from_injective_anchor(
    graph: &mut Graph,
    anchor: &Anchor,
    rank: usize,
) -> Result<Option<StructureFunctions>, String> {
    let independent = graph.independent_rows(&anchor.entries)?;
    if independent.len() < rank || anchor.entries.is_empty() {
        return Ok((rank == 0).then(|| StructureFunctions::commuting(0)));
    }
    let square: Matrix = independent.iter().map(|row| anchor.entries[*row].clone()).collect();
    let pairs: Vec<(SectionId, SectionId)> = (0..rank)
        .flat_map(|a| (a + 1..rank).map(move |b| (SectionId::from_index(a), SectionId::from_index(b))))
        .collect();
    let mut structure = StructureFunctions::commuting(rank);
    // the pairs that do not commute, and their commutators
    let mut unknown = Vec::new();
    let mut right: Matrix = vec![Vec::new(); rank];
    for (alpha, beta) in pairs {
        let components = commutator(graph, anchor, alpha, beta);
        let components: Vec<ExprId> =
            independent.iter().map(|coordinate| graph.simplify(components[*coordinate])).collect();
        if components.iter().any(|component| !graph.is_literal_zero(*component)) {
            unknown.push((alpha, beta));
            for (row, component) in right.iter_mut().zip(components) {
                row.push(component);
            }
        }
    }
    if unknown.is_empty() {
        return Ok(Some(structure));
    }
    let solution = graph.solve_linear(&square, &right).ok_or_else(|| {
        format!("the anchor is injective, but its {rank} rows could not be solved for the {rank} sections")
    })?;
    for (column, (alpha, beta)) in unknown.into_iter().enumerate() {
        let components = solution.values.iter().map(|row| row[column]).collect::<Vec<_>>();
        let components = components.into_iter().map(|c| graph.simplify(c)).collect();
        structure.set(graph, alpha, beta, components);
    }
    Ok(Some(structure))
}

/// The Hamel symbols of a coframe w^k = α^k_j ẋ^j with dual frame β = α⁻¹, mathematics (4), CNS
/// section 3: `γ^k_{ml} = β^i_m β^j_l (∂_jα^k_i − ∂_iα^k_j)`. No division but that of β occurs.
pub fn from_coframe(
    graph: &mut Graph,
    coframe: &[Vec<ExprId>],
    frame: &[Vec<ExprId>],
    coordinates: &[SymbolId],
) -> StructureFunctions {
    let n = coordinates.len();
    let curls: Vec<Matrix> = coframe.iter().map(|row| curl(graph, row, coordinates)).collect();
    let mut structure = StructureFunctions::commuting(n);
    for m in 0..n {
        for l in m + 1..n {
            let components = curls
                .iter()
                .map(|curl| {
                    let mut summands = Vec::new();
                    for i in 0..n {
                        for j in 0..n {
                            if !graph.is_literal_zero(curl[i][j]) {
                                let frames = graph.mul(frame[i][m], frame[j][l]);
                                summands.push(graph.mul(frames, curl[i][j]));
                            }
                        }
                    }
                    let sum = graph.sum(&summands);
                    graph.simplify(sum)
                })
                .collect();
            structure.set(graph, SectionId::from_index(m), SectionId::from_index(l), components);
        }
    }
    structure
}

/// `∂_jα_i − ∂_iα_j`.
fn curl(graph: &mut Graph, row: &[ExprId], coordinates: &[SymbolId]) -> Matrix {
    let mut partials: Vec<Vec<ExprId>> = Vec::new();
    for symbol in coordinates {
        let mut derivation = Derivation::partial(graph, *symbol);
        partials.push(derivation.apply_all(graph, row));
    }
    (0..row.len())
        .map(|i| (0..row.len()).map(|j| graph.sub(partials[j][i], partials[i][j])).collect())
        .collect()
}

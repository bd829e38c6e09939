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
            graph.formula(forth - back)
        })
        .collect()
}

/// The brackets of some pairs that mathematics (2) determines, `ρ C_{αβ} = [ρ_α, ρ_β]`, where the anchor is
/// injective on the sections that it moves: solved on coordinates whose rows of ρ are independent.
///
/// Components along sections that it does not see, ρ(e_γ) = 0, are 0. Where there are more coordinates than
/// sections, the remaining rows are left to the check of (2). Returns whether the anchor is injective there, at
/// generic points; if it is not, nothing is set.
///
/// # Errors
/// The reason, where the rank cannot be decided.
pub fn from_anchor(
    graph: &mut Graph,
    anchor: &Anchor,
    seen: &[SectionId],
    pairs: &[(SectionId, SectionId)],
    structure: &mut StructureFunctions,
) -> Result<bool, String> {
    let columns: Matrix =
        anchor.entries.iter().map(|row| seen.iter().map(|section| row[section.index()]).collect()).collect();
    let independent = if seen.is_empty() { Vec::new() } else { graph.independent_rows(&columns)? };
    if independent.len() < seen.len() {
        return Ok(false);
    }
    let square: Matrix = independent.iter().map(|row| columns[*row].clone()).collect();
    // the pairs that do not commute, and their commutators
    let mut unknown = Vec::new();
    let mut right: Matrix = vec![Vec::new(); seen.len()];
    for (alpha, beta) in pairs.iter().copied().filter(|(a, b)| seen.contains(a) && seen.contains(b)) {
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
        return Ok(true);
    }
    let rank = seen.len();
    let solution = graph.solve_linear(&square, &right).ok_or_else(|| {
        format!("the anchor is injective, but its {rank} rows could not be solved for the {rank} sections")
    })?;
    for (column, (alpha, beta)) in unknown.into_iter().enumerate() {
        let mut components = vec![graph.zero(); anchor.rank];
        for (section, row) in seen.iter().zip(&solution.values) {
            components[section.index()] = graph.simplify(row[column]);
        }
        structure.set(graph, alpha, beta, components);
    }
    Ok(true)
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
                                summands.push(graph.formula(frame[i][m] * frame[j][l] * curl[i][j]));
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
        .map(|i| (0..row.len()).map(|j| graph.formula(partials[j][i] - partials[i][j])).collect())
        .collect()
}

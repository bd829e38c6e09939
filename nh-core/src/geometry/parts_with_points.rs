//! Which parts of a manifold have points: those whose equations do not contradict what is required besides.

use super::manifold::Manifold;
use crate::algebra::{Demand, Graph};
use crate::id::{ExprId, SymbolId};

/// Of more roots both signs are not tried.
const ROOTS: usize = 4;

impl Manifold {
    /// Forgets parts that have no points: those whose equations, with what is required otherwise, contradict each other.
    pub(crate) fn keep_parts_with_points(&mut self, graph: &mut Graph, demands: &[(ExprId, Demand)]) {
        if self.others.is_empty() && self.open.is_empty() {
            return;
        }
        self.open.retain(|part| has_points(graph, demands, (&part.images, &part.functions, &[])));
        let parts: Vec<Self> = self.parts().map(Self::alone).collect();
        let mut with_points = Vec::with_capacity(parts.len());
        for part in parts {
            with_points.extend(part.with_points(graph, demands));
        }
        self.become_parts(with_points);
    }

    /// This part if it has points, or the one where roots have other signs: a root of what is no square is written with one
    /// of them, and stands for both, as a length does that is solved for.
    fn with_points(self, graph: &mut Graph, demands: &[(ExprId, Demand)]) -> Option<Self> {
        let roots: Vec<ExprId> = self
            .radicands
            .iter()
            .copied()
            .filter(|radicand| !graph.is_square_everywhere(*radicand))
            .collect();
        let mut signs = vec![self.clone()];
        for radicand in roots.iter().take(ROOTS) {
            let others: Vec<Self> =
                signs.iter().map(|part| part.with_the_other_root(graph, *radicand)).collect();
            signs.extend(others);
        }
        let found =
            signs.into_iter().find(|part| has_points(graph, demands, (&part.images, &[], &part.radicands)));
        found.or_else(|| (roots.len() > ROOTS).then_some(self))
    }

    /// The part where a root has the other sign.
    pub(super) fn with_the_other_root(&self, graph: &mut Graph, radicand: ExprId) -> Self {
        let mut other = self.alone();
        let (symbols, images): (Vec<SymbolId>, Vec<ExprId>) = other.images.iter().copied().unzip();
        let images = graph.with_the_other_root(&images, radicand);
        other.radicands = graph.with_the_other_root(&other.radicands, radicand);
        other.images = symbols.into_iter().zip(images).collect();
        other
    }

    /// Forgets the other parts, if there are any of these.
    pub(crate) fn keep_parts(&mut self, is_kept: impl FnMut(&Self) -> bool) {
        let mut parts: Vec<Self> = self.parts().map(Self::alone).collect();
        parts.retain(is_kept);
        self.become_parts(parts);
    }

    /// Takes these parts in the place of those that it has, if there are any; open ones stay.
    fn become_parts(&mut self, mut parts: Vec<Self>) {
        let open = std::mem::take(&mut self.open);
        if let Some(first) = (!parts.is_empty()).then(|| parts.remove(0)) {
            *self = Self { others: parts, ..first };
        }
        self.open = open;
    }
}

/// Whether equations, functions that vanish and what roots are taken of do not contradict demands.
fn has_points(
    graph: &mut Graph,
    demands: &[(ExprId, Demand)],
    (images, functions, radicands): (&[(SymbolId, ExprId)], &[ExprId], &[ExprId]),
) -> bool {
    let mut all = demands.to_vec();
    for (symbol, image) in images {
        let symbol = graph.symbol(*symbol);
        all.push((graph.formula(symbol - image), Demand::Zero));
    }
    all.extend(functions.iter().map(|function| (*function, Demand::Zero)));
    all.extend(radicands.iter().map(|radicand| (*radicand, Demand::NotNegative)));
    graph.contradiction(&all).is_none()
}

//! What kind of algebroid a declaration is: properties that do not depend on the frame or the chart, but for
//! what is said of the declared frame itself.

use super::assumptions::on_the_base;
use crate::algebra::Facts;
use crate::geometry::{Algebroid, Drops, Manifold, Rank, RankSetting};
use crate::id::{ExprId, SymbolId};
use crate::model::{Kinematics, Model};

/// The kind of an algebroid E → M.
#[derive(Clone, Debug)]
pub struct Kind {
    /// The dimension of M: the coordinates less the independent identities between them.
    pub dimension: usize,
    /// The rank of ρ; `None` where not even the generic one is known.
    pub anchor: Option<Rank>,
    /// Whether all brackets of the basis vanish.
    pub commutes: bool,
    /// Whether the structure functions of the basis, or of the one that was declared before its frame, are
    /// constant: then sections of that basis are a Lie algebra that acts on M.
    pub is_action: bool,
}

impl Kind {
    /// Reads it off the algebroid in the basis that was declared before any frame: ranks of the anchor are the
    /// same in every basis.
    pub fn of(model: &mut Model, algebroid: &Algebroid, base: &Manifold, facts: &Facts) -> Self {
        let anchor = if matches!(model.kinematics, Kinematics::Tangent) {
            Some(Rank { generic: model.coordinates.len(), drops: Drops::Nowhere })
        } else {
            let parameters: Vec<SymbolId> = model.parameters.iter().map(|p| p.symbol).collect();
            let holding = &on_the_base(model);
            let setting =
                RankSetting { manifold: base, residuals: &[], holding, facts, parameters: &parameters };
            setting.rank(&mut model.graph, &algebroid.anchor.entries).ok()
        };
        let (commutes, is_action) = (commutes(model, algebroid), has_constant_structure(model, algebroid));
        Self { dimension: dimension(model, base), anchor, commutes, is_action }
    }

    /// The same in the basis that a frame has made.
    #[must_use]
    pub fn in_basis(self, model: &Model, algebroid: &Algebroid) -> Self {
        let is_action = self.is_action || has_constant_structure(model, algebroid);
        Self { commutes: commutes(model, algebroid), is_action, ..self }
    }
}

/// Whether no structure function depends on the base.
fn has_constant_structure(model: &Model, algebroid: &Algebroid) -> bool {
    let entries: Vec<ExprId> =
        algebroid.structure.nonzero(&model.graph).flat_map(|(.., components)| components.to_vec()).collect();
    let coordinates: Vec<SymbolId> = model.coordinates.iter().map(|coordinate| coordinate.symbol).collect();
    entries.iter().all(|entry| !model.graph.depends_on(*entry, &coordinates))
}

fn commutes(model: &Model, algebroid: &Algebroid) -> bool {
    let mut brackets = algebroid.structure.nonzero(&model.graph);
    brackets.all(|(.., components)| components.iter().all(|c| model.graph.zero_test(*c).is_zero()))
}

fn dimension(model: &mut Model, base: &Manifold) -> usize {
    let coordinates: Vec<SymbolId> = model.coordinates.iter().map(|coordinate| coordinate.symbol).collect();
    let graph = &mut model.graph;
    let identities: Vec<ExprId> = model.identities.iter().map(|identity| identity.value).collect();
    let slopes: Vec<Vec<ExprId>> = identities
        .iter()
        .map(|identity| coordinates.iter().map(|symbol| graph.partial(*identity, *symbol)).collect())
        .collect();
    let slopes = base.restrict_matrix(graph, &slopes);
    coordinates.len() - graph.generic_rank(&slopes).unwrap_or(0).min(coordinates.len())
}

//! The velocities that a declaration might name, where the state keeps all of them unasked.

use super::parameters;
use crate::compile::{Derived, Proved};
use crate::geometry::PivotSetting;
use crate::geometry::suggested_velocities::{Suggested, Wanted, suggested};
use crate::id::{SectionId, SymbolId};
use crate::model::{Model, TrackedItem};

/// A choice that `independent` would accept, where the projected formulation is nobody's wish.
///
/// Nothing is suggested where position constraints could not be solved: nothing is known then of the manifold where a
/// pivot would have to be other than 0. Nor on levels of momenta, where the choice is another one, beside a volume, which is
/// claimed in the variables of the state, or for steps that are made of all velocities.
pub(super) fn suggestion(proved: &mut Proved, derived: &Derived<'_>) -> Option<Suggested> {
    let Derived::Projected { .. } = derived else { return None };
    let parameters = parameters(proved);
    let Proved { model, base, constraints, positions, facts, levels, .. } = proved;
    let is_volume_given = model.volume.as_ref().is_some_and(|claim| claim.density.is_some());
    let is_asked_for = model.formulation.is_some();
    let is_asked_for =
        is_asked_for || model.requests.iter().any(|(request, _)| request.keeps_all_velocities());
    if is_asked_for || is_volume_given || !levels.is_empty() || !positions.unsolved.is_empty() {
        return None;
    }
    let annihilator = &constraints.linear.as_ref()?.annihilator;
    let kept = kept(model);
    let on_base = positions.manifold.restrict_matrix(&mut model.graph, annihilator);
    let off_positions = base.restrict_matrix(&mut model.graph, annihilator);
    let setting = PivotSetting { annihilator, on_base: &on_base, parameters: &parameters, facts };
    let wanted = Wanted { off_positions: &off_positions, time: model.time, kept: &kept };
    suggested(&mut model.graph, &setting, &wanted)
}

/// The velocities that the declaration wants in the state: those that it tracks, and those of a linearisation.
fn kept(model: &Model) -> Vec<SectionId> {
    let tracked = model.tracked.iter().flatten().filter_map(|(item, _)| match item {
        TrackedItem::Variable(symbol) => Some(*symbol),
        TrackedItem::Output(_) => None,
    });
    let linearised = model.linearization.iter().flat_map(|kept| &kept.variables).map(|(symbol, _)| *symbol);
    let named: Vec<SymbolId> = tracked.chain(linearised).collect();
    model.sections.ids().filter(|id| named.contains(&model.sections[*id].symbol)).collect()
}

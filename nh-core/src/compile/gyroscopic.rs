//! The gyroscopic force of a Chaplygin system, as far as it is asked for.

use super::Proved;
use super::phase_space::asked;
use crate::geometry::ConstraintDistribution;
use crate::id::{CoordId, ExprId, SymbolId};
use crate::mechanics::{Chaplygin, Procedure, Splitting};
use crate::model::Request;
use crate::system::Gyroscopic;
use crate::violation::{Law, Violation};

/// The splitting of D, where the constraints are linear and do not depend on the time.
pub(crate) fn splitting(proved: &mut Proved, distribution: &ConstraintDistribution) -> Option<Splitting> {
    let graph = &mut proved.model.graph;
    let offset = distribution.offset.iter().all(|entry| graph.zero_test(*entry).is_zero());
    let entries: Vec<ExprId> = distribution.basis.iter().flatten().copied().collect();
    if !offset || graph.symbols_in(&entries).contains(&proved.system.time) {
        return None;
    }
    Splitting::of(graph, &proved.system, distribution, &proved.symmetries.cyclic)
}

/// L̄, K and ⟨J, K⟩ of a Chaplygin system.
pub(crate) fn chaplygin(
    proved: &mut Proved,
    distribution: &ConstraintDistribution,
    splitting: &Splitting,
) -> Option<Chaplygin> {
    if !splitting.is_chaplygin() {
        return None;
    }
    let rate = |id: &CoordId| proved.model.coordinates[*id].rate;
    let rates: Vec<SymbolId> = splitting.coordinates.iter().map(rate).collect();
    Chaplygin::of(&mut proved.model.graph, &proved.system, distribution, splitting, &rates)
}

/// ⟨J, K⟩ as a function, if the declaration asks for it.
///
/// # Errors
/// A system that is no Chaplygin system.
pub(super) fn derive(
    proved: &mut Proved,
    distribution: Option<&ConstraintDistribution>,
) -> Result<Option<Gyroscopic>, Vec<Violation>> {
    let Some(origin) = asked(&proved.model, Request::Gyroscopic) else { return Ok(None) };
    let blame = |evidence: String| {
        vec![Violation {
            law: Law::Symmetry,
            origin,
            what: "this is no Chaplygin system, whose constraints act as a gyroscopic force".into(),
            evidence,
            way_out: "declare it on the algebroid of its symmetry group, or leave `gyroscopic` out".into(),
        }]
    };
    let Some(distribution) = distribution else {
        return Err(blame("there is no basis of D valid everywhere".into()));
    };
    if let Some(level) = proved.levels.first() {
        return Err(blame(format!("`routh` puts the momentum of `{}` on a level", level.name)));
    }
    let Some(splitting) = splitting(proved, distribution) else {
        return Err(blame(
            "its constraints are not linear and autonomous, or the kernel of the anchor is 0 and no coordinate \
             is cyclic"
                .into(),
        ));
    };
    let Some(found) = chaplygin(proved, distribution, &splitting) else {
        let Splitting { horizontal, coordinates, .. } = &splitting;
        let (shared, m) = (splitting.shared(), coordinates.len());
        return Err(blame(if shared > 0 {
            format!("D meets the kernel of the anchor in rank {shared}: there are momentum equations")
        } else {
            format!("the anchor maps D to rank {horizontal} of {m}")
        }));
    };
    let symbol = |id: &CoordId| proved.model.coordinates[*id].symbol;
    let coordinates = splitting.coordinates.iter().map(symbol).collect();
    Ok(Some(Gyroscopic { coordinates, force: Procedure::of(found.force) }))
}

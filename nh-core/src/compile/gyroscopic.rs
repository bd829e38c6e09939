//! The gyroscopic force of a Chaplygin system, as far as it is asked for.

use super::on_request::asked;
use super::proved::Proved;
use super::vertical_splitting::Reduced;
use crate::algebra::Substitution;
use crate::geometry::ConstraintDistribution;
use crate::id::{CoordId, SymbolId};
use crate::mechanics::{Procedure, Splitting};
use crate::model::Request;
use crate::violation::{Law, Violation};

/// ⟨J, K⟩ as a function, if the declaration asks for it.
///
/// # Errors
/// A system that is no Chaplygin system.
pub(super) fn derive(
    proved: &mut Proved,
    distribution: Option<&ConstraintDistribution>,
) -> Result<(Vec<SymbolId>, Option<Procedure>), Vec<Violation>> {
    let Some(origin) = asked(&proved.model, Request::Gyroscopic) else { return Ok(Default::default()) };
    let refused = |evidence: String, way_out: &str| {
        vec![Violation {
            law: Law::Symmetry,
            origin,
            what: "this is no Chaplygin system, whose constraints act as a gyroscopic force".into(),
            evidence,
            way_out: format!("{way_out}, or leave `gyroscopic` out"),
        }]
    };
    let blame = |evidence| refused(evidence, "declare it on the algebroid of its symmetry group");
    if let Some(level) = proved.levels.first() {
        return Err(blame(format!("`routh` puts the momentum of `{}` on a level", level.name)));
    }
    let reduced = Reduced::of(proved, distribution).map_err(&blame)?;
    let Some(found) = reduced.chaplygin(proved) else {
        let Splitting { horizontal, coordinates, by_group, .. } = &reduced.splitting;
        let (shared, m) = (reduced.splitting.shared(), coordinates.len());
        let group = reduced.group_in_words(proved);
        return Err(match (by_group, shared > 0) {
            (true, true) => refused(
                format!(
                    "D meets the directions of the group in rank {shared}: there are momentum equations; the group: {group}"
                ),
                "name the sections of a group that D does not meet in `symmetries { … }`",
            ),
            (true, false) => refused(
                format!("modulo the group, D has rank {horizontal} of {m}; the group: {group}"),
                "name the sections of a larger group in `symmetries { … }`",
            ),
            (false, true) => blame(format!(
                "D meets the kernel of the anchor in rank {shared}: there are momentum equations"
            )),
            (false, false) => blame(format!("the anchor maps D to rank {horizontal} of {m}")),
        });
    };
    let mut restriction = match distribution {
        Some(distribution) => {
            distribution.restriction(&proved.model.graph, &proved.system.algebroid.velocities)
        }
        None => Substitution::new([]),
    };
    let mut force = Vec::new();
    for component in found.force {
        let component = reduced.at_declared_velocities(proved, component);
        let graph = &mut proved.model.graph;
        let component = restriction.apply(graph, component);
        force.push(graph.simplify(component));
    }
    let symbol = |id: &CoordId| proved.model.coordinates[*id].symbol;
    let coordinates = reduced.splitting.coordinates.iter().map(symbol).collect();
    Ok((coordinates, Some(Procedure::of(force))))
}

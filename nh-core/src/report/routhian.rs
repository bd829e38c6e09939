//! Routh reduction: the levels, and the Routhian.

use super::shown;
use crate::compile::{Derived, Proved};
use crate::id::SymbolId;

/// A line for each level, and the Routhian R = L − v^ρ μ_ρ on the levels, mathematics (22) (CM section 5).
pub(super) fn lines(proved: &mut Proved, derived: &Derived<'_>) -> Vec<String> {
    let levels = proved.levels.clone();
    let mut lines: Vec<String> = levels
        .iter()
        .map(|level| {
            let graph = &mut proved.model.graph;
            let momentum = graph.formula(level.residual + level.value);
            let momentum = graph.simplify(momentum);
            format!(
                "the momentum of {}: {} = {}",
                level.name,
                shown(graph, momentum),
                shown(graph, level.value)
            )
        })
        .collect();
    if !levels.is_empty() {
        lines.extend(routhian(proved, derived));
    }
    lines
}

/// R, where each section is that of the velocity that leaves the state.
fn routhian(proved: &mut Proved, derived: &Derived<'_>) -> Option<String> {
    let Derived::Adapted { distribution, kept, .. } = derived else { return None };
    let velocities = &proved.system.algebroid.velocities;
    let graph = &mut proved.model.graph;
    let mut routhian = kept.restriction(graph, velocities).apply(graph, proved.system.lagrangian);
    for level in &proved.levels {
        let is_own = |symbol: &SymbolId| {
            let position = distribution.independent.iter().position(|known| known == symbol);
            position.is_some_and(|position| distribution.section(position) == level.section)
        };
        let (_, velocity) = kept.eliminated.iter().find(|(symbol, _)| is_own(symbol))?;
        routhian = graph.formula(routhian - velocity * level.value);
    }
    let routhian = graph.simplify(routhian);
    Some(format!("the Routhian: {}", shown(graph, routhian)))
}

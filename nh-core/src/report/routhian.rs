//! Routh reduction: the levels, and the Routhian.

use super::shown;
use crate::algebra::Graph;
use crate::findings::{Findings, LevelMomentum};

/// A line for each level, and the Routhian.
pub(super) fn lines(graph: &Graph, findings: &Findings) -> Vec<String> {
    let line = |LevelMomentum { name, momentum, value }: &LevelMomentum| {
        format!("the momentum of {name}: {} = {}", shown(graph, *momentum), shown(graph, *value))
    };
    let routhian = findings.routhian.map(|routhian| format!("the Routhian: {}", shown(graph, routhian)));
    findings.levels.iter().map(line).chain(routhian).collect()
}

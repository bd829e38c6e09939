//! Impacts: their rows, and what they do to the velocities.

use super::{SHOWN, shown};
use crate::compile::Proved;

/// A line for each row, with its rate Ψ y + b, and one for the coefficient of restitution, mathematics (50).
pub(super) fn lines(proved: &Proved) -> Vec<String> {
    let graph = &proved.model.graph;
    let mut lines = Vec::new();
    for impact in &proved.impacts {
        for row in &impact.rows {
            let rate = graph.text_within(row.form, SHOWN);
            lines.push(match row.position {
                Some(gap) if row.is_unilateral => {
                    format!("{}: {} >= 0, changing at the rate {rate}", row.name, shown(graph, gap))
                }
                Some(gap) => format!("{}: {} = 0, at the rate {rate}", row.name, shown(graph, gap)),
                None => format!("{}: {rate} = 0 afterwards", row.name),
            });
        }
        let restitution = impact.restitution.map(|e| shown(graph, e));
        lines.extend(restitution.map(|e| format!("{} has the coefficient of restitution {e}", impact.label)));
    }
    lines
}

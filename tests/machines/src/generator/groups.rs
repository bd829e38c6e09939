//! Lie algebras with metrics that are not diagonal, and frames with brackets.

use super::{Draft, Random, names};

/// An Euler–Poincaré–Suslov system, or quasi-velocities over a base.
pub(super) fn machine(draft: &mut Draft, random: &mut Random) -> &'static str {
    let (sections, algebra): (usize, &str) = match random.below(6) {
        0 => (3, "so(3)"),
        1 => (3, "se(2)"),
        2 => (3, "sl(2)"),
        3 => (3, "heisenberg(1)"),
        4 => (6, "so(4)"),
        _ => (6, "se(3)"),
    };
    let w = names("w", sections);
    draft.basis.clone_from(&w);
    draft.brackets.push(format!("brackets {algebra} {{ {} }}", w.join(", ")));
    // a sum of squares: definite whatever the parameters are
    for (row, rate) in w.iter().enumerate() {
        let inertia = draft.parameter("A");
        let mut form = rate.clone();
        for other in &w[row + 1..] {
            if random.happens(if sections > 3 { 15 } else { 35 }) {
                form = format!("{form} + {}*{other}", draft.parameter("s"));
            }
        }
        draft.lagrangian.push(format!("{inertia}/2*({form})^2"));
    }
    let constraints = random.below(sections.min(4));
    for index in 0..constraints {
        let mut form = w[sections - 1 - index].clone();
        for other in &w[..sections - constraints] {
            if random.happens(40) {
                form = format!("{form} + {}*{other}", draft.parameter("n"));
            }
        }
        let drift = draft.maybe(random, 15, "c").unwrap_or_else(|| "0".into());
        draft.constraints.push(format!("{form} = {drift};"));
    }
    draft.push(random, "w0", "w0");
    "algebra"
}

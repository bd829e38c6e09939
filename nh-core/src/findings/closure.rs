//! Whether D is closed under the bracket: whether the constraints are holonomic.

use crate::compile::{Derived, Proved};

/// How D lies to the brackets of its sections.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Closure {
    /// The brackets of its sections are in D.
    Closed,
    /// One is not.
    NotClosed,
    /// That was not decided.
    Undecided,
}

impl Closure {
    /// Whether D is closed; `None` where there are no constraints or D has no sections that are known.
    pub(super) fn of(proved: &mut Proved, derived: &Derived<'_>) -> Option<Self> {
        let Proved { model, system, constraints, .. } = proved;
        if model.constraints.is_empty() && model.distribution.is_none() {
            return None;
        }
        let generic;
        let distribution = match derived {
            Derived::Adapted { distribution, .. } => *distribution,
            Derived::Projected { .. } => {
                generic = constraints.generic_distribution(&mut model.graph, &system.algebroid.velocities)?;
                &generic
            }
        };
        let base = constraints.base();
        Some(match distribution.is_holonomic(&mut model.graph, &system.algebroid, &system.clock, base) {
            Some(true) => Self::Closed,
            Some(false) => Self::NotClosed,
            None => Self::Undecided,
        })
    }
}

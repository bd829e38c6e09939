//! Whether D is closed under the bracket: whether the constraints are holonomic.

use crate::compile::{Derived, Proved};
use crate::geometry::Involution;

/// Whether D is closed under the bracket.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Closure {
    /// How it lies to the brackets of its sections.
    Decided(Involution),
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
        let found = distribution.involution(&mut model.graph, &system.algebroid, &system.clock, base);
        Some(found.map_or(Self::Undecided, Self::Decided))
    }
}

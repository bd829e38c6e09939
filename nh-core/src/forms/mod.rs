//! Forms of the equations of motion: different arithmetic for the same C v̇ = f.
//!
//! A form is a file here and a line in [`Registry::standard`]. What it derives is compared with what the others
//! derive, and the best of them is proved against the declaration before it may be emitted (`choose`); where it is
//! refused, what is left is compared anew. So a form cannot make the equations wrong, need not be right for every
//! declaration, and is not known to be right where it lost.

mod along_chain;
mod along_free_directions;
mod by_momenta;
mod by_parts;
mod by_velocities;
mod expanded;
mod from_the_tips;
mod in_body_axes;
mod on_wheels;

use crate::algebra::{Graph, Matrix};
use crate::count::Count;
use crate::geometry::ConstraintDistribution;
use crate::id::ExprId;
use crate::mechanics::{
    Definiteness, LagrangianSystem, OtherAxes, Procedure, ReducedEquations, SaddleEquations,
};
use crate::model::Body;
use std::fmt;

/// What a form is derived from.
#[derive(Clone, Copy, Debug)]
pub struct Setting<'s> {
    /// L, ρ, C and Υ.
    pub system: &'s LagrangianSystem,
    /// The bodies that are declared, with their kinetic energies in quasi-velocities.
    pub bodies: &'s [Body],
    /// D, on the levels of momenta that are declared.
    pub distribution: &'s ConstraintDistribution,
    /// The same with the dependent velocities one after the other; `None` in a basis that is orthonormal.
    pub chained: Option<&'s ConstraintDistribution>,
    /// The constraints as they were written; `None` where levels of momenta determine velocities besides.
    pub residuals: Option<&'s [ExprId]>,
    /// The operations of L, as [`Graph::operation_count`].
    pub size: Count,
    /// Whether derivatives of the motion are asked for.
    pub is_differentiated: bool,
}

/// One way to write the equations of motion on D, mathematics (8).
pub trait Form: Sync {
    /// Its name in the ledger.
    fn name(&self) -> &'static str;
    /// Where it exists.
    fn condition(&self) -> &'static str;
    /// The formulas that it writes.
    fn formulas(&self) -> &'static str;
    /// Whether it multiplies out what the Lagrangian is written in, so that it is for short ones.
    fn expands(&self) -> bool {
        false
    }
    /// Where it exists, other forms expand Lagrangians of so many operations at most.
    fn others_expand_up_to(&self, _setting: &Setting) -> Count {
        Count::TOO_MANY
    }
    /// The place among forms of equal cost, and among those that the report may show: the least is first.
    fn rank(&self) -> u8;
    /// The equations; `None` where the form does not exist, or is known not to be worth while.
    fn derive(&self, graph: &mut Graph, setting: &Setting) -> Option<ReducedEquations>;
    /// ẋ and v̇ where C is definite, of a form that has no C and f of its own, and along which axes it eliminates
    /// velocities, if not their own.
    fn solve(&self, _graph: &mut Graph, _setting: &Setting) -> Option<(Procedure, Vec<OtherAxes>)> {
        None
    }
}

/// Judges mass matrices.
pub type Judge<'j> = &'j dyn Fn(&Graph, &Matrix) -> Definiteness;

/// One way to solve the equations with multipliers, mathematics (9), for ẏ.
pub trait Solution: Sync {
    /// Its name in the ledger.
    fn name(&self) -> &'static str;
    /// Where it exists.
    fn condition(&self) -> &'static str;
    /// The formulas that it writes.
    fn formulas(&self) -> &'static str;
    /// ẏ, of intermediate results of the procedure; `None` where the solution does not exist.
    fn solve(
        &self,
        graph: &mut Graph,
        equations: &SaddleEquations,
        judge: Judge,
        procedure: &mut Procedure,
    ) -> Option<Vec<ExprId>>;
}

/// What is done to the functions beside the motion before they are proved, each by its name.
pub type Finish = fn(&mut Graph, &str, &mut Procedure);

/// The forms that compete, in the order in which they are derived.
#[derive(Clone)]
pub struct Registry {
    forms: Vec<&'static dyn Form>,
    solutions: Vec<&'static dyn Solution>,
    finish: Option<Finish>,
}

impl Registry {
    /// All forms.
    #[must_use]
    pub fn standard() -> Self {
        Self {
            forms: vec![
                &along_chain::AlongChain,
                &on_wheels::OnWheels,
                &from_the_tips::FromTheTips,
                &in_body_axes::JointByJoint,
                &in_body_axes::ByCompositeBodies,
                &by_parts::ByParts,
                &by_velocities::ByVelocities,
                Self::plain(),
                &by_momenta::ByMomenta,
            ],
            solutions: vec![&along_free_directions::AlongFreeDirections],
            finish: None,
        }
    }

    /// Some forms alone, and the plain one where none of them is admitted.
    #[must_use]
    pub fn of(forms: Vec<&'static dyn Form>) -> Self {
        Self { forms, solutions: Vec::new(), finish: None }
    }

    /// The same with these ways to solve the equations with multipliers, beside (10).
    #[must_use]
    pub fn solving(self, solutions: Vec<&'static dyn Solution>) -> Self {
        Self { solutions, ..self }
    }

    /// The same, with something done to the functions beside the motion before they are proved.
    #[must_use]
    pub fn finishing(self, finish: Finish) -> Self {
        Self { finish: Some(finish), ..self }
    }

    pub(crate) fn finish(&self) -> Option<Finish> {
        self.finish
    }

    /// (8) as it stands, which is emitted where no form of the registry is admitted.
    #[must_use]
    pub fn plain() -> &'static dyn Form {
        &expanded::Expanded
    }

    /// The ways to solve the equations with multipliers that compete with (10).
    #[must_use]
    pub fn solutions(&self) -> &[&'static dyn Solution] {
        &self.solutions
    }

    /// The forms, in the order in which they are derived.
    #[must_use]
    pub fn forms(&self) -> &[&'static dyn Form] {
        &self.forms
    }
}

impl fmt::Debug for Registry {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let solutions = self.solutions.iter().map(|solution| solution.name());
        f.debug_list().entries(self.forms.iter().map(|form| form.name()).chain(solutions)).finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forms_say_what_they_are() {
        let registry = Registry::standard();
        let mut names: Vec<&str> = registry.forms().iter().map(|form| form.name()).collect();
        let mut ranks: Vec<u8> = registry.forms().iter().map(|form| form.rank()).collect();
        names.sort_unstable();
        names.dedup();
        ranks.sort_unstable();
        ranks.dedup();
        assert_eq!((names.len(), ranks.len()), (registry.forms().len(), registry.forms().len()));
        for form in registry.forms() {
            assert!(!form.condition().is_empty() && form.formulas().contains('('), "{}", form.name());
        }
        for solution in registry.solutions() {
            assert!(!names.contains(&solution.name()), "{}", solution.name());
            assert!(!solution.condition().is_empty() && solution.formulas().contains('('));
        }
    }
}

//! Sizes beyond which forms are left aside, each with its reason, in the unit of
//! [`Graph::operation_count`](crate::algebra::Graph::operation_count). None of them is a condition of a proof.

use crate::count::Count;

/// Lagrangians with more operations than this are not expanded: the equations are derived in
/// velocity forms alone.
pub(crate) const EXPANDED: u64 = 120;
/// The same where nothing is constrained, so that nothing is put into what is expanded: three links on the ground are
/// shorter expanded than from the tips.
const EXPANDED_ON_ALL: u64 = 150;
/// The same where constraints are chained: the recursion from wheel to wheel, or from the tips, is shorter than what
/// expansion comes to as soon as there are several bodies.
pub(crate) const EXPANDED_IN_CHAINS: u64 = 60;
/// The coefficients of longer velocities on D are not named one by one: expressions of that size are those of
/// chains, which are shorter from wheel to wheel.
pub(crate) const NAMED: u64 = 60;
/// Forms whose equations take so much more work than the shortest, before they are solved, are not
/// solved: they have never been the cheapest.
const LONGER: u64 = 40;

/// What the ledger says of those.
pub(crate) const BESIDE: &str = " before it is solved, beside ";

/// Whether equations of a length are left aside beside those of the shortest.
pub(crate) fn is_much_longer(length: Count, shortest: Count) -> bool {
    length > shortest + LONGER && length * 2 > shortest * 3
}

/// How many operations a Lagrangian may have that is expanded.
pub(crate) fn expanded(is_constrained: bool) -> u64 {
    if is_constrained { EXPANDED } else { EXPANDED_ON_ALL }
}

/// Functions of more operations than this are not differentiated as expressions: the derivatives of one step by
/// another are fewer than those of what is written out.
pub(crate) const DIFFERENTIATED_AS_EXPRESSIONS: u64 = 400;
/// Functions of more operations than this are differentiated in one way alone: several are as many programs to compare.
pub(crate) const DIFFERENTIATED_ONCE: u64 = 2000;
/// From so many steps on a program is taken for functions that give some of its results, and no other is sought:
/// those found apart are at most 1 % shorter, and take as long to find. Below, they are up to 5 % shorter.
pub(crate) const TAKEN_FROM: usize = 250;

//! With multipliers, where constraints leave one or two directions free: along these.

use super::{Judge, Solution};
use crate::algebra::Graph;
use crate::id::ExprId;
use crate::mechanics::{Procedure, SaddleEquations};

pub(super) struct AlongFreeDirections;

impl Solution for AlongFreeDirections {
    fn name(&self) -> &'static str {
        "along free directions"
    }
    fn condition(&self) -> &'static str {
        "where one or two constraints leave one direction free of the velocities that they couple, or two of four"
    }
    fn formulas(&self) -> &'static str {
        "mathematics (9), (10″)"
    }
    fn solve(
        &self,
        graph: &mut Graph,
        equations: &SaddleEquations,
        judge: Judge,
        procedure: &mut Procedure,
    ) -> Option<Vec<ExprId>> {
        equations.solve_along_free_directions(graph, judge, procedure)
    }
}

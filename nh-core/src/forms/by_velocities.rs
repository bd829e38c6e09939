//! By the velocities that the Lagrangian is written in, Kane's form where these are velocities of points.

use super::{Form, Setting};
use crate::algebra::Graph;
use crate::mechanics::{ReducedEquations, equations_by_velocity_forms};

pub(super) struct ByVelocities;

impl Form for ByVelocities {
    fn name(&self) -> &'static str {
        "by velocities"
    }
    fn condition(&self) -> &'static str {
        "always"
    }
    fn formulas(&self) -> &'static str {
        "mathematics (8), by dθ of section 5"
    }
    fn expands(&self) -> bool {
        true
    }
    fn rank(&self) -> u8 {
        1
    }
    fn derive(&self, graph: &mut Graph, setting: &Setting) -> Option<ReducedEquations> {
        Some(equations_by_velocity_forms(graph, setting.system, setting.distribution))
    }
}

//! Bodies in space in their own axes, by the relative poses of those that joints connect.

use super::{Form, Setting};
use crate::algebra::Graph;
use crate::mechanics::{Elimination, OtherAxes, Procedure, ReducedEquations, accelerations_of_joints};

const CONDITION: &str = "where C is definite, bodies in space are declared by `kinetic` with products of rotations \
                         about axes and of attitudes that turn as velocities of the state, and no level determines a \
                         velocity";

/// By articulated inertias: velocities leave at their joints, the last of a chain first.
pub(super) struct JointByJoint;

/// By the mass matrix of all velocities, from the inertias of all that a joint carries.
pub(super) struct ByCompositeBodies;

fn solve(
    graph: &mut Graph,
    setting: &Setting,
    elimination: Elimination,
) -> Option<(Procedure, Vec<OtherAxes>)> {
    setting.chained?;
    accelerations_of_joints(graph, (setting.system, setting.bodies), setting.distribution, elimination)
}

impl Form for JointByJoint {
    fn name(&self) -> &'static str {
        "joint by joint"
    }
    fn condition(&self) -> &'static str {
        CONDITION
    }
    fn formulas(&self) -> &'static str {
        "mathematics (42), (43)"
    }
    fn rank(&self) -> u8 {
        7
    }
    fn derive(&self, _: &mut Graph, _: &Setting) -> Option<ReducedEquations> {
        None
    }
    fn solve(&self, graph: &mut Graph, setting: &Setting) -> Option<(Procedure, Vec<OtherAxes>)> {
        solve(graph, setting, Elimination::Everywhere)
    }
}

impl Form for ByCompositeBodies {
    fn name(&self) -> &'static str {
        "by composite bodies"
    }
    fn condition(&self) -> &'static str {
        CONDITION
    }
    fn formulas(&self) -> &'static str {
        "mathematics (42), (43)"
    }
    fn rank(&self) -> u8 {
        8
    }
    fn derive(&self, _: &mut Graph, _: &Setting) -> Option<ReducedEquations> {
        None
    }
    fn solve(&self, graph: &mut Graph, setting: &Setting) -> Option<(Procedure, Vec<OtherAxes>)> {
        solve(graph, setting, Elimination::Nowhere)
    }
}

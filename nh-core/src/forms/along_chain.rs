//! By the velocities that the Lagrangian is written in, with the dependent ones solved for one after the other:
//! a chain of bodies stays a chain.

use super::{Form, Setting};
use crate::algebra::Graph;
use crate::mechanics::{ReducedEquations, equations_by_velocity_forms};

pub(super) struct AlongChain;

impl Form for AlongChain {
    fn name(&self) -> &'static str {
        "along the chain"
    }
    fn condition(&self) -> &'static str {
        "unless the basis of D is orthonormal"
    }
    fn formulas(&self) -> &'static str {
        "mathematics (8), by dθ of section 5"
    }
    fn rank(&self) -> u8 {
        2
    }
    fn derive(&self, graph: &mut Graph, setting: &Setting) -> Option<ReducedEquations> {
        Some(equations_by_velocity_forms(graph, setting.system, setting.chained?))
    }
}

//! By the velocities that the Lagrangian is written in, with their partial velocities as intermediate results.

use super::{Form, Setting};
use crate::algebra::{Accuracy, Graph};
use crate::choose::sizes;
use crate::mechanics::{ReducedEquations, equations_by_partial_velocities};

pub(super) struct ByParts;

impl Form for ByParts {
    fn name(&self) -> &'static str {
        "by partial velocities"
    }
    fn condition(&self) -> &'static str {
        "where partial velocities are sums or quotients, and no level determines a velocity"
    }
    fn formulas(&self) -> &'static str {
        "mathematics (8), by dθ of section 5"
    }
    fn rank(&self) -> u8 {
        5
    }
    fn derive(&self, graph: &mut Graph, setting: &Setting) -> Option<ReducedEquations> {
        setting.chained?;
        // careful code carries the errors of divisions along, and every quotient put in place has its own
        let is_short = setting.size <= sizes::EXPANDED
            && graph.operation_count(&setting.distribution.velocity) <= sizes::NAMED;
        match graph.accuracy() {
            Accuracy::Fast | Accuracy::Balanced if is_short => {
                equations_by_partial_velocities(graph, setting.system, setting.distribution)
            }
            _ => None,
        }
    }
}

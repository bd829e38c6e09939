//! By articulated inertias: bodies leave Gauss's function one after the other, the last of a chain first.

use super::{Form, Setting};
use crate::algebra::Graph;
use crate::choose::sizes;
use crate::count::Count;
use crate::mechanics::{OtherAxes, Procedure, ReducedEquations, accelerations_from_the_tips};

pub(super) struct FromTheTips;

impl Form for FromTheTips {
    fn name(&self) -> &'static str {
        "from the tips"
    }
    fn condition(&self) -> &'static str {
        "where C is definite, velocities of bodies are sums of those of neighbours, and no level determines a velocity"
    }
    fn formulas(&self) -> &'static str {
        "mathematics (39)"
    }
    fn others_expand_up_to(&self, setting: &Setting) -> Count {
        if setting.distribution.dependent.is_empty() {
            return Count::TOO_MANY;
        }
        Count::new(sizes::EXPANDED_IN_CHAINS)
    }
    fn rank(&self) -> u8 {
        6
    }
    fn derive(&self, _: &mut Graph, _: &Setting) -> Option<ReducedEquations> {
        None
    }
    fn solve(&self, graph: &mut Graph, setting: &Setting) -> Option<(Procedure, Vec<OtherAxes>)> {
        setting.chained?;
        let (system, distribution) = (setting.system, setting.distribution);
        let found = accelerations_from_the_tips(graph, system, distribution, setting.is_differentiated)?;
        Some((found, Vec::new()))
    }
}

//! (8) with the momenta that brackets turn as intermediate results.

use super::{Form, Setting};
use crate::algebra::Graph;
use crate::mechanics::{ReducedEquations, equations_by_momenta};

pub(super) struct ByMomenta;

impl Form for ByMomenta {
    fn name(&self) -> &'static str {
        "by momenta"
    }
    fn condition(&self) -> &'static str {
        "where a bracket contains a momentum of several terms"
    }
    fn formulas(&self) -> &'static str {
        "mathematics (6), (8); CLMM (3.5), (3.7)"
    }
    fn expands(&self) -> bool {
        true
    }
    fn rank(&self) -> u8 {
        3
    }
    fn derive(&self, graph: &mut Graph, setting: &Setting) -> Option<ReducedEquations> {
        setting.chained?;
        equations_by_momenta(graph, setting.system, setting.distribution)
    }
}

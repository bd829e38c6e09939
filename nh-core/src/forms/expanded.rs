//! (8) as it stands: the Euler–Lagrange side restricted to D, contracted with its sections, and simplified.

use super::{Form, Setting};
use crate::algebra::Graph;
use crate::mechanics::{ReducedEquations, reduced_equations};

pub(super) struct Expanded;

impl Form for Expanded {
    fn name(&self) -> &'static str {
        "expanded"
    }
    fn condition(&self) -> &'static str {
        "always"
    }
    fn formulas(&self) -> &'static str {
        "mathematics (6), (8); CLMM (3.5), (3.7)"
    }
    fn expands(&self) -> bool {
        true
    }
    fn rank(&self) -> u8 {
        0
    }
    fn derive(&self, graph: &mut Graph, setting: &Setting) -> Option<ReducedEquations> {
        Some(reduced_equations(graph, setting.system, setting.distribution))
    }
}

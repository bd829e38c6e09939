//! With the velocities of points on wheels in the axes of these.

use super::{Form, Setting};
use crate::algebra::Graph;
use crate::choose::sizes;
use crate::count::Count;
use crate::mechanics::{ReducedEquations, equations_in_wheel_frames};

pub(super) struct OnWheels;

impl Form for OnWheels {
    fn name(&self) -> &'static str {
        "on wheels"
    }
    fn condition(&self) -> &'static str {
        "where constraints keep points from moving across an axis"
    }
    fn formulas(&self) -> &'static str {
        "mathematics (8), by dθ of section 5 for turned pairs of forms"
    }
    fn others_expand_up_to(&self, _: &Setting) -> Count {
        Count::new(sizes::EXPANDED_IN_CHAINS)
    }
    fn rank(&self) -> u8 {
        4
    }
    fn derive(&self, graph: &mut Graph, setting: &Setting) -> Option<ReducedEquations> {
        setting.chained?;
        equations_in_wheel_frames(graph, setting.system, setting.distribution, setting.residuals?)
    }
}

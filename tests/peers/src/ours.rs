//! This project's runtime.

use nonholonomic::Method;
use nonholonomic::prelude::*;

use crate::problem::Problem;

/// Runs a method of the runtime to the end.
pub fn run<const N: usize, P: Problem<N>, M: Method<P>>(
    system: &P,
    start: [f64; N],
    method: M,
) -> Option<[f64; N]> {
    let mut sim = Integrator::new(*system, method, 0.0, P::State::from_array(start));
    sim.advance_to(P::END).ok()?;
    Some(sim.state().to_array())
}

//! That difference quotients serve `Rodas5P`, whose order rests on the Jacobian, as well as the Jacobian itself.

use nonholonomic::prelude::*;
use nonholonomic::{D, Method};

use crate::problems::{E5, Hires, Numbers, Oregonator, Problem, Robertson, VanDerPol};

/// The starts that are compared. They differ by some rounding errors, since the error at the end of one run may be a
/// matter of luck: that of E5 at 1e-6 lies between 3e-6 and 2e-4, with the Jacobian as without.
const STARTS: i32 = 9;

/// The steps that were tried from all starts, and the middle one of the errors at the end.
fn tried<const N: usize, P: Problem<N>>(problem: P, method: impl Method<P> + Copy) -> (u64, f64)
where
    Numbers<N>: State<Scalar = f64, Dim = D<N>>,
{
    let mut steps = 0;
    let mut errors: Vec<f64> = (0..STARTS)
        .map(|k| {
            let start = P::START.map(|x| x * (1.0 + 1e-14 * f64::from(k - STARTS / 2)));
            let mut sim = Integrator::new(problem, method, 0.0, Numbers(start)).max_steps(100_000);
            sim.advance_to(P::END).unwrap_or_else(|error| panic!("{}: {error}", P::NAME));
            steps += sim.statistics().steps + sim.statistics().rejected;
            let relative = |(x, exact): (&f64, f64)| (x - exact).abs() / (exact.abs() + P::NEGLIGIBLE);
            sim.state().0.iter().zip(P::SOLUTION).map(relative).fold(0.0, f64::max)
        })
        .collect();
    errors.sort_by(f64::total_cmp);
    (steps, errors[errors.len() / 2])
}

fn check<const N: usize, P: Problem<N>>(problem: P)
where
    Numbers<N>: State<Scalar = f64, Dim = D<N>>,
{
    for k in [2, 3, 4, 5, 6, 7, 9] {
        let rtol = 10.0_f64.powi(-k);
        let method = Rodas5P::new().rtol(rtol).atol(P::atol(rtol));
        let (expected, usual) = tried(problem, method.with_jacobian());
        let (found, error) = tried(problem, method);
        assert!(found <= expected + expected / 20 + 2, "{} at {rtol:e}: {found} for {expected}", P::NAME);
        assert!(error <= 3.0 * usual.max(rtol), "{} at {rtol:e}: {error:e} for {usual:e}", P::NAME);
    }
}

#[test]
fn quotients_serve_rodas5p_as_well_as_the_jacobian() {
    check(VanDerPol);
    check(Robertson);
    check(Oregonator);
    check(Hires);
    check(E5);
}

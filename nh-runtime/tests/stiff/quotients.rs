//! That difference quotients serve `Rodas5P`, whose order rests on the Jacobian, as well as the Jacobian itself; and every
//! method where that is infinite.

use nonholonomic::prelude::*;
use nonholonomic::{D, Jacobian, Method};

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

/// A tank that is filled, empty at first, out of which it flows by Torricelli's law into another: x' = 1 − √x, y' = √x − y.
#[derive(Clone, Copy)]
struct Tanks;

impl Dynamics for Tanks {
    type State = Numbers<2>;
    type Input = ();
    fn derivative(&self, _t: f64, &Numbers([x, y]): &Numbers<2>, (): &()) -> Numbers<2> {
        Numbers([1.0 - x.sqrt(), x.sqrt() - y])
    }
}

impl Jacobian for Tanks {
    type InputDim = D<0>;
    fn state_jacobian(&self, _t: f64, &Numbers([x, _]): &Numbers<2>, (): &()) -> [[f64; 2]; 2] {
        [[-0.5 / x.sqrt(), 0.0], [0.5 / x.sqrt(), -1.0]]
    }
    fn input_jacobian(&self, _t: f64, _x: &Numbers<2>, (): &()) -> [[f64; 0]; 2] {
        [[]; 2]
    }
}

/// The first tank alone, beside a decay: its equation has an infinite entry of its own, and no other.
#[derive(Clone, Copy)]
struct Tank;

impl Dynamics for Tank {
    type State = Numbers<2>;
    type Input = ();
    fn derivative(&self, _t: f64, &Numbers([x, y]): &Numbers<2>, (): &()) -> Numbers<2> {
        Numbers([1.0 - x.sqrt(), -y])
    }
}

impl Jacobian for Tank {
    type InputDim = D<0>;
    fn state_jacobian(&self, _t: f64, &Numbers([x, _]): &Numbers<2>, (): &()) -> [[f64; 2]; 2] {
        [[-0.5 / x.sqrt(), 0.0], [0.0, -1.0]]
    }
    fn input_jacobian(&self, _t: f64, _x: &Numbers<2>, (): &()) -> [[f64; 0]; 2] {
        [[]; 2]
    }
}

/// The level after a unit of time, which explicit methods know: 1 − √x has the logarithm −t/2 − √x.
const LEVEL: f64 = 0.487_609_5;

/// Divided by infinity, nothing is left of an equation, and a motion would stand still.
#[test]
fn an_infinite_jacobian_solves_nothing() {
    fn level<S: Dynamics<State = Numbers<2>, Input = ()>>(
        system: S,
        method: impl Method<S>,
    ) -> Result<f64, IntegrationError> {
        let mut sim = Integrator::new(system, method, 0.0, Numbers([0.0, 0.3]));
        sim.advance_to(1.0)?;
        let Numbers([x, _]) = *sim.state();
        Ok(x)
    }
    macro_rules! each {
        ($check:expr, $($method:expr),*) => {
            $($check(stringify!($method), level(Tank, $method));
            $check(stringify!($method), level(Tanks, $method));)*
        };
    }
    let arrives = |name: &str, found: Result<f64, IntegrationError>| {
        assert!(found.as_ref().is_ok_and(|x| (x - LEVEL).abs() < 1e-3), "{name}: {found:?}");
    };
    each!(
        arrives,
        ImplicitMidpoint::new(0.01).with_jacobian(),
        ImplicitMidpoint::new(0.01),
        Radau5::new().with_jacobian(),
        Radau5::new(),
        Rodas5P::new().with_jacobian(),
        Rodas5P::new()
    );
    let does_not_stand_still = |name: &str, found: Result<f64, IntegrationError>| {
        let is_told = matches!(found, Err(IntegrationError::NoConvergence { .. }));
        assert!(is_told || found.as_ref().is_ok_and(|x| (x - LEVEL).abs() < 1e-3), "{name}: {found:?}");
    };
    each!(
        does_not_stand_still,
        GaussLegendre4::new(0.01).with_jacobian(),
        GaussLegendre4::new(0.01),
        GaussLegendre6::new(0.01).with_jacobian(),
        ImplicitMidpoint::new(0.01).with_jacobian().fourth_order()
    );
}

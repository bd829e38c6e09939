//! What accuracy costs on stiff problems of the literature, next to the code RADAU5. The table is printed by
//! `cargo test --release -p nonholonomic --test stiff -- --nocapture`.

mod noticed;
mod pollution;
mod problems;
mod quotients;
mod radau5;
mod switching;

use nonholonomic::prelude::*;
use nonholonomic::{D, Dynamics, Method};
use pollution::Pollution;
use problems::{Brusselator, E5, Hires, Numbers, Oregonator, Problem, Robertson, VanDerPol};
use radau5::RADAU5;

/// An error, and the evaluations, Jacobians and factorizations (a real and a complex one together) that it takes.
type Run = (f64, [f64; 3]);

/// The largest relative error at the end, and what the run has cost.
fn run<const N: usize, P: Problem<N>>(problem: P, rtol: f64) -> Run
where
    Numbers<N>: State<Scalar = f64, Dim = D<N>>,
{
    run_by(problem, Radau5::new().rtol(rtol).atol(P::atol(rtol)).with_jacobian(), rtol)
}

/// The same with difference quotients.
fn run_by_quotients<const N: usize, P: Problem<N>>(problem: P, rtol: f64) -> Run
where
    Numbers<N>: State<Scalar = f64, Dim = D<N>>,
{
    run_by(problem, Radau5::new().rtol(rtol).atol(P::atol(rtol)), rtol)
}

fn run_by<const N: usize, P: Problem<N>>(problem: P, method: impl Method<P>, rtol: f64) -> Run
where
    Numbers<N>: State<Scalar = f64, Dim = D<N>>,
{
    let mut sim = Integrator::new(problem, method, 0.0, Numbers(P::START)).max_steps(10_000);
    sim.advance_to(P::END).unwrap_or_else(|error| panic!("{} at {rtol:e}: {error}", P::NAME));
    let relative = |(x, exact): (&f64, f64)| (x - exact).abs() / (exact.abs() + P::NEGLIGIBLE);
    let error = sim.state().0.iter().zip(P::SOLUTION).map(relative).fold(0.0, f64::max);
    let Statistics { evaluations, jacobians, factorizations, .. } = sim.statistics();
    #[allow(clippy::cast_precision_loss)] // thousands
    (error, [evaluations as f64, jacobians as f64, factorizations as f64 / 2.0])
}

/// The errors that are compared.
const RANGE: (f64, f64) = (1e-8, 1e-3);

/// The costs at the middle of the range: by the line of least squares through their logarithms over those of the
/// errors, since single errors are a matter of luck.
fn costs(runs: &[Run]) -> [f64; 3] {
    let within: Vec<_> = runs.iter().filter(|(error, _)| (RANGE.0..=RANGE.1).contains(error)).collect();
    assert!(within.len() > 5, "too few runs: {runs:?}");
    let count = f64::from(u32::try_from(within.len()).unwrap());
    core::array::from_fn(|i| {
        let points = || within.iter().map(|(error, costs)| (error.log10(), costs[i].log10()));
        let mean = points().fold((0.0, 0.0), |(x, y), (px, py)| (x + px / count, y + py / count));
        let products = |(x, y): (f64, f64)| ((x - mean.0) * (y - mean.1), (x - mean.0).powi(2));
        let sums = points().map(products).fold((0.0, 0.0), |a, b| (a.0 + b.0, a.1 + b.1));
        let middle = (RANGE.0 * RANGE.1).log10() / 2.0;
        10.0_f64.powf(mean.1 + (middle - mean.0) * sums.0 / sums.1)
    })
}

/// Ours and those of RADAU5, each of whose Jacobians takes so many evaluations beside those that it counts.
fn compared<const N: usize, P: Problem<N>>(problem: P, ours: fn(P, f64) -> Run, beside: u32) -> [f64; 3]
where
    Numbers<N>: State<Scalar = f64, Dim = D<N>>,
{
    let ours: Vec<Run> = (4..=14).map(|k| ours(problem, 10.0_f64.powf(-0.5 * f64::from(k)))).collect();
    let (_, theirs) = RADAU5.iter().find(|(name, _)| *name == P::NAME).unwrap();
    let all = |[counted, jacobians, factorizations]: [u32; 3]| {
        [counted + beside * jacobians, jacobians, factorizations].map(f64::from)
    };
    let theirs: Vec<Run> = theirs.iter().map(|(error, costs)| (*error, all(*costs))).collect();
    let (ours, theirs) = (costs(&ours), costs(&theirs));
    let ratios = core::array::from_fn(|i| ours[i] / theirs[i]);
    println!("| {} | {} |", P::NAME, row(&ours, &theirs, &ratios));
    ratios
}

fn row(ours: &[f64; 3], theirs: &[f64; 3], ratios: &[f64; 3]) -> String {
    let cell = |i: usize| format!("{:.0} | {:.0} | {:.2}", ours[i], theirs[i], ratios[i]);
    [cell(0), cell(1), cell(2)].join(" | ")
}

/// The geometric means of the ratios, none of which may be more than a tenth above 1.
fn means(ratios: [[f64; 3]; 7]) -> [f64; 3] {
    let means: [f64; 3] = core::array::from_fn(|i| {
        let product: f64 = ratios.iter().map(|ratio| ratio[i]).product();
        product.powf(1.0 / 7.0)
    });
    println!("geometric means {means:.2?}");
    assert!(ratios.iter().flatten().all(|ratio| *ratio <= 1.1), "{ratios:?}");
    means
}

#[test]
fn an_error_costs_no_more_than_with_the_code_radau5() {
    let means = means([
        compared(VanDerPol, run, 0),
        compared(Robertson, run, 0),
        compared(Oregonator, run, 0),
        compared(Hires, run, 0),
        compared(E5, run, 0),
        compared(Brusselator, run, 0),
        compared(Pollution, run, 0),
    ]);
    assert!(means.iter().all(|mean| *mean <= 1.0), "{means:?}");
}

/// As if those of RADAU5 had the digits of its analytic Jacobians. A reaction as E5, whose end rests on what its equations
/// conserve, tells rounding errors of quotients; large systems tell how many of these are formed.
#[test]
fn nor_does_it_with_difference_quotients() {
    let means = means([
        compared(VanDerPol, run_by_quotients, 2),
        compared(Robertson, run_by_quotients, 3),
        compared(Oregonator, run_by_quotients, 3),
        compared(Hires, run_by_quotients, 8),
        compared(E5, run_by_quotients, 4),
        compared(Brusselator, run_by_quotients, 40),
        compared(Pollution, run_by_quotients, 20),
    ]);
    assert!(means.iter().all(|mean| *mean <= 1.0), "{means:?}");
}

#[test]
fn tolerances_are_kept() {
    fn check<const N: usize, P: Problem<N>>(problem: P)
    where
        Numbers<N>: State<Scalar = f64, Dim = D<N>>,
    {
        for k in 2..=8 {
            let rtol = 10.0_f64.powi(-k);
            let (error, _) = run(problem, rtol);
            assert!(error < 2.0 * rtol, "{} at {rtol:e}: {error:e}", P::NAME);
        }
    }
    check(VanDerPol);
    check(Robertson);
    check(Oregonator);
    check(Hires);
    check(E5);
}

/// A problem in another unit of its state.
#[derive(Clone, Copy, Debug)]
struct InUnits<P, const N: usize> {
    problem: P,
    unit: f64,
}

impl<P: Problem<N>, const N: usize> Dynamics for InUnits<P, N>
where
    Numbers<N>: State<Scalar = f64, Dim = D<N>>,
{
    type State = Numbers<N>;
    type Input = ();
    fn derivative(&self, t: f64, state: &Numbers<N>, (): &()) -> Numbers<N> {
        let there = Numbers(state.0.map(|x| x / self.unit));
        Numbers(self.problem.derivative(t, &there, &()).0.map(|x| x * self.unit))
    }
}

#[test]
fn units_of_the_state_change_nothing() {
    fn steps<const N: usize, P: Problem<N>>(problem: P, unit: f64) -> (u64, u64)
    where
        Numbers<N>: State<Scalar = f64, Dim = D<N>>,
    {
        let method = Radau5::new().rtol(1e-4).atol(P::atol(1e-4) * unit);
        let start = Numbers(P::START.map(|x| x * unit));
        let mut sim = Integrator::new(InUnits { problem, unit }, method, 0.0, start).max_steps(10_000);
        sim.advance_to(P::END).unwrap_or_else(|error| panic!("{} in units of {unit:e}: {error}", P::NAME));
        (sim.statistics().steps, sim.statistics().evaluations)
    }
    fn check<const N: usize, P: Problem<N>>(problem: P)
    where
        Numbers<N>: State<Scalar = f64, Dim = D<N>>,
    {
        let usual = steps(problem, 1.0);
        for exponent in [-200, -66, -40, 40, 66] {
            assert_eq!(steps(problem, 2.0_f64.powi(exponent)), usual, "{} 2^{exponent}", P::NAME);
        }
    }
    check(VanDerPol);
    check(Robertson);
    check(Oregonator);
    check(Hires);
    check(E5);
}

//! The other crates, each as its documentation says, with the least output that it can be asked for.

use differential_equations::prelude as de;
use diffsol::{NalgebraMat, OdeBuilder, OdeSolverMethod, OdeSolverStopReason};
use multicalc::linear_algebra::Vector;
use nalgebra::SVector;

use crate::problem::Problem;

struct System<P>(P);

impl<const N: usize, P: Problem<N>> ode_solvers::System<f64, SVector<f64, N>> for System<P> {
    fn system(&self, t: f64, x: &SVector<f64, N>, rate: &mut SVector<f64, N>) {
        *rate = self.0.rate(t, &(*x).into()).into();
    }
}

pub fn ode_solvers_rk4<const N: usize, P: Problem<N>>(
    system: &P,
    start: [f64; N],
    steps: u32,
) -> Option<[f64; N]> {
    let step = P::END / f64::from(steps);
    let mut stepper = ode_solvers::rk4::Rk4::new(System(*system), 0.0, start.into(), P::END, step);
    stepper.integrate().ok()?;
    Some((*stepper.y_out().last()?).into())
}

// its dense output gives a wrong end (version 0.6.2): every step is put out instead, the last is the end
macro_rules! adaptive {
    ($name:ident, $module:ident::$method:ident, $beta:literal, $least:literal, $most:literal) => {
        pub fn $name<const N: usize, P: Problem<N>>(
            system: &P,
            start: [f64; N],
            tol: f64,
        ) -> Option<[f64; N]> {
            let (out, end) = (ode_solvers::OutputType::Sparse, P::END);
            let mut stepper = ode_solvers::$module::$method::from_param(
                System(*system),
                0.0,
                end,
                0.0,
                start.into(),
                tol,
                tol,
                0.9,
                $beta,
                $least,
                $most,
                end,
                0.0,
                1_000_000,
                1000,
                out,
            );
            stepper.integrate().ok()?;
            Some((*stepper.y_out().last()?).into())
        }
    };
}
adaptive!(ode_solvers_dopri5, dopri5::Dopri5, 0.04, 0.2, 10.0);
adaptive!(ode_solvers_dop853, dop853::Dop853, 0.0, 0.333, 6.0);

/// `tableau`: 0 for dopri5, 1 for dop853, 2 for Verner's 9(8).
pub fn differential_equations<const N: usize, P: Problem<N>>(
    system: &P,
    start: [f64; N],
    tol: f64,
    tableau: u8,
) -> Option<[f64; N]> {
    let system = *system;
    let rate = move |t: f64, x: &[f64; N], rate: &mut [f64; N]| *rate = system.rate(t, x);
    macro_rules! solve {
        ($method:expr) => {
            de::IVP::ode_from_fn(rate, 0.0, P::END, start)
                .method($method.rtol(tol).atol(tol).max_steps(1_000_000))
                .t_eval([P::END])
                .solve()
                .ok()?
        };
    }
    let solution = match tableau {
        0 => solve!(de::ExplicitRungeKutta::dopri5()),
        1 => solve!(de::ExplicitRungeKutta::dop853()),
        _ => solve!(de::ExplicitRungeKutta::rkv988e()),
    };
    solution.y.last().copied()
}

pub fn diffsol_tsit45<const N: usize, P: Problem<N>>(
    system: &P,
    start: [f64; N],
    tol: f64,
) -> Option<[f64; N]> {
    let system = *system;
    let problem = OdeBuilder::<NalgebraMat<f64>>::new()
        .rtol(tol)
        .atol([tol])
        .rhs(move |x: &[f64], _p: &[f64], t: f64, rate: &mut [f64]| {
            let mut state = [0.0; N];
            state.copy_from_slice(x);
            rate.copy_from_slice(&system.rate(t, &state));
        })
        .init(move |_p: &[f64], _t: f64, x: &mut [f64]| x.copy_from_slice(&start), N)
        .build()
        .ok()?;
    let mut solver = problem.tsit45().ok()?;
    solver.set_stop_time(P::END).ok()?;
    loop {
        if let OdeSolverStopReason::TstopReached = solver.step().ok()? {
            break;
        }
    }
    let mut end = [0.0; N];
    for (i, x) in end.iter_mut().enumerate() {
        *x = solver.state().y[i];
    }
    Some(end)
}

pub fn multicalc_rk45<const N: usize, P: Problem<N>>(
    system: &P,
    start: [f64; N],
    tol: f64,
) -> Option<[f64; N]> {
    let rate = |t: f64, x: &Vector<N, f64>| Vector::new(system.rate(t, x.as_array()));
    let method = multicalc::ode::Rk45::default().with_rtol(tol).with_atol(tol).with_max_steps(1_000_000);
    method.solve(&rate, 0.0, &Vector::new(start), P::END).ok().map(|end| *end.as_array())
}

pub fn multicalc_rk4<const N: usize, P: Problem<N>>(
    system: &P,
    start: [f64; N],
    steps: u32,
) -> Option<[f64; N]> {
    let rate = |t: f64, x: &Vector<N, f64>| Vector::new(system.rate(t, x.as_array()));
    let step = P::END / f64::from(steps);
    let count = usize::try_from(steps).ok()?;
    let end = multicalc::ode::Rk4::integrate(&rate, 0.0, &Vector::new(start), step, count, |_, _| {});
    Some(*end.as_array())
}

#[cfg(feature = "russell")]
pub fn russell_dopri8<const N: usize, P: Problem<N>>(
    system: &P,
    start: [f64; N],
    tol: f64,
) -> Option<[f64; N]> {
    use russell_ode::prelude as ro;
    let system = *system;
    let equations = ro::System::new(N, move |rate, t, x: &russell_lab::Vector, _: &mut ro::NoArgs| {
        let mut state = [0.0; N];
        state.copy_from_slice(x.as_data());
        rate.as_mut_data().copy_from_slice(&system.rate(t, &state));
        Ok(())
    });
    let mut params = ro::Params::new(ro::Method::DoPri8);
    params.set_tolerances(tol, tol, None).ok()?;
    params.step.n_step_max = 1_000_000;
    let mut solver = ro::OdeSolver::new(params, equations).ok()?;
    let mut x = russell_lab::Vector::from(&start);
    solver.solve(&mut x, 0.0, P::END, None, &mut 0, None).ok()?;
    let mut end = [0.0; N];
    end.copy_from_slice(x.as_data());
    Some(end)
}

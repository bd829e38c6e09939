//! The parameters of a sleigh from a noisy record of its way, with how well they are known.
//!
//! `cargo run --release --example fit`
//!
//! The record is of positions and headings, twenty times a second, while a known torque acts. Residuals and their
//! derivatives come from one integration of the variational equations, with a column for each parameter and for the
//! speeds at the start, which are not known either. What is left is a problem of least squares: the crate `argmin`
//! solves it by Newton's method with JᵀJ in the place of second derivatives, as Gauss did, in full steps from a guess that
//! is near. The covariance of the result is
//! σ² (JᵀJ)⁻¹; whether it tells the truth is seen by fitting many records.
#![allow(non_snake_case, reason = "parameters are written as in mechanics: J")]

use std::error::Error;

use argmin::core::{Executor, Gradient, Hessian, State as _};
use argmin::solver::newton::Newton;
use argmin_math::{ArgminDot, ArgminInv};
use nalgebra::{SMatrix, SVector};
use nh_examples::Random;
use nonholonomic::prelude::*;
use nonholonomic::sensitivity::{By, ColumnTolerance, Variational};

/// A rigid body on a plane, carried by a knife edge at distance a from its centre of mass.
#[nonholonomic(
    base   { theta, x, y }
    basis  { omega, v1, v2 }
    anchor {
        der(theta) = omega;
        der(x) = v1 * cos(theta) - v2 * sin(theta);
        der(y) = v1 * sin(theta) + v2 * cos(theta);
    }
    lagrangian  { J / 2 * omega^2 + m / 2 * (v1^2 + (v2 + a * omega)^2) }
    constraints { edge: v2 = 0; }
    inputs      { torque }
    forces      { omega: torque - c * omega; }
    assume      { m > 0; J > 0; }
    units       { x, y, a = m; theta = rad; m = kg; J = kg m^2; torque = N m; c = N m s; }
    emit        { jacobian, parameter_jacobian }
)]
#[derive(Clone, Copy, Debug)]
struct Sleigh {
    m: f64,
    J: f64,
    a: f64,
    c: f64,
}

/// What is looked for: the four parameters and both speeds at the start.
const UNKNOWNS: usize = 6;
const NAMES: [&str; UNKNOWNS] = ["m", "J", "a", "c", "omega at the start", "v1 at the start"];
const COLUMNS: [By; UNKNOWNS] =
    [By::Parameter(0), By::Parameter(1), By::Parameter(2), By::Parameter(3), By::Start(3), By::Start(4)];
const TRUTH: [f64; UNKNOWNS] = [2.0, 0.4, 0.15, 0.2, 0.0, 1.0];
const GUESS: [f64; UNKNOWNS] = [2.3, 0.44, 0.16, 0.17, 0.03, 0.96];
const SAMPLES: usize = 160;
const PERIOD: f64 = 0.05;
/// Standard deviations of the record: of a heading (rad) and of a place (m).
const NOISE: [f64; 3] = [0.01, 0.005, 0.005];

/// Steps of Gauss and Newton, after which nothing changes any more.
const ITERATIONS: u64 = 10;
/// How many records are fitted.
const RECORDS: u32 = 100;
const UNDETERMINED: &str = "the record does not determine the unknowns";

/// A record: heading and place.
type Track = [[f64; 3]; SAMPLES];
/// The derivatives of a track by the unknowns.
type Slopes = Vec<[[f64; UNKNOWNS]; 3]>;
/// JᵀJ.
type Normal = SMatrix<f64, UNKNOWNS, UNKNOWNS>;

/// The torque, which changes its sign every second.
fn torque(sample: usize) -> SleighInput {
    SleighInput { torque: if (sample / 20).is_multiple_of(2) { 0.8 } else { -0.6 } }
}

/// The track of a sleigh, with its derivatives by the unknowns.
fn track(unknowns: &[f64]) -> Result<(Track, Slopes), Box<dyn Error>> {
    let &[m, J, a, c, omega, v1] = unknowns else { return Err("six unknowns".into()) };
    let motion = Variational::new(Sleigh { m, J, a, c }, COLUMNS)
        .by_parameters(|sleigh: &Sleigh, t, x, u| sleigh.parameter_jacobian(t, x, u));
    let start = motion.start(&SleighState { omega, v1, ..SleighState::default() })?;
    let mut sim =
        Integrator::new(motion, Dopri5::new().tolerance(ColumnTolerance::new(1e-8, 1e-6)), 0.0, start);
    let (mut places, mut slopes) = ([[0.0; 3]; SAMPLES], vec![[[0.0; UNKNOWNS]; 3]; SAMPLES]);
    for (sample, (place, slope)) in places.iter_mut().zip(&mut slopes).enumerate() {
        sim.set_input(torque(sample));
        sim.advance_to(sim.time() + PERIOD)?;
        let seen = |x: &SleighState| [x.theta, x.x, x.y];
        *place = seen(&sim.state().state);
        for (k, column) in sim.state().columns.iter().enumerate() {
            for (row, entry) in slope.iter_mut().zip(seen(column)) {
                row[k] = entry;
            }
        }
    }
    Ok((places, slopes))
}

/// A record of the true sleigh.
fn recorded(random: &mut Random) -> Result<Track, Box<dyn Error>> {
    let (mut track, _) = track(&TRUTH)?;
    for place in &mut track {
        for (number, deviation) in place.iter_mut().zip(NOISE) {
            *number += deviation * random.normal();
        }
    }
    Ok(track)
}

/// Half the sum of the squares of residuals over their standard deviations, as a function of the unknowns.
struct Misfit {
    record: Track,
}

impl Misfit {
    /// The same for the optimiser.
    fn told(&self, unknowns: &[f64]) -> Result<(SVector<f64, UNKNOWNS>, Normal), argmin::core::Error> {
        match self.expanded(unknowns) {
            Ok((_, gradient, normal)) => Ok((gradient, normal)),
            Err(error) => Err(argmin::core::Error::msg(error.to_string())),
        }
    }

    /// The misfit, its gradient, and JᵀJ.
    fn expanded(&self, unknowns: &[f64]) -> Result<(f64, SVector<f64, UNKNOWNS>, Normal), Box<dyn Error>> {
        let (track, slopes) = track(unknowns)?;
        let (mut sum, mut gradient, mut normal) = (0.0, SVector::zeros(), Normal::zeros());
        for ((seen, found), rows) in self.record.iter().zip(&track).zip(&slopes) {
            for (((seen, found), row), deviation) in seen.iter().zip(found).zip(rows).zip(NOISE) {
                let residual = (found - seen) / deviation;
                let row = SVector::from(*row) / deviation;
                sum += residual * residual / 2.0;
                gradient += row * residual;
                normal += row * row.transpose();
            }
        }
        Ok((sum, gradient, normal))
    }
}

impl Gradient for Misfit {
    type Param = Vec<f64>;
    type Gradient = Vec<f64>;
    fn gradient(&self, unknowns: &Vec<f64>) -> Result<Vec<f64>, argmin::core::Error> {
        let (gradient, _) = self.told(unknowns)?;
        Ok(gradient.iter().copied().collect())
    }
}

/// JᵀJ as `argmin` inverts and applies it.
#[derive(Clone)]
struct Curvature(Normal);

impl ArgminInv<Self> for Curvature {
    fn inv(&self) -> Result<Self, argmin::core::Error> {
        let factor = self.0.cholesky().ok_or_else(|| argmin::core::Error::msg(UNDETERMINED))?;
        Ok(Self(factor.inverse()))
    }
}

impl ArgminDot<Vec<f64>, Vec<f64>> for Curvature {
    fn dot(&self, vector: &Vec<f64>) -> Vec<f64> {
        (self.0 * SVector::<f64, UNKNOWNS>::from_row_slice(vector)).iter().copied().collect()
    }
}

impl Hessian for Misfit {
    type Param = Vec<f64>;
    type Hessian = Curvature;
    fn hessian(&self, unknowns: &Vec<f64>) -> Result<Curvature, argmin::core::Error> {
        Ok(Curvature(self.told(unknowns)?.1))
    }
}

/// The unknowns of a record, with their covariance and the misfit.
fn fitted(record: &Track) -> Result<([f64; UNKNOWNS], Normal, f64), Box<dyn Error>> {
    let misfit = Misfit { record: *record };
    let result = Executor::new(Misfit { record: *record }, Newton::<f64>::new())
        .configure(|state| state.param(GUESS.to_vec()).max_iters(ITERATIONS))
        .run()?;
    let found = result.state().get_param().ok_or("no parameters")?;
    let (sum, _, normal) = misfit.expanded(found)?;
    let covariance = normal.cholesky().ok_or(UNDETERMINED)?.inverse();
    Ok((SVector::<f64, UNKNOWNS>::from_row_slice(found).into(), covariance, sum))
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut random = Random::new(5);
    let (found, covariance, misfit) = fitted(&recorded(&mut random)?)?;
    let freedom = 3 * SAMPLES - UNKNOWNS;
    println!("one record of {SAMPLES} samples; χ² = {:.0} for {freedom} degrees of freedom", 2.0 * misfit);

    // what the covariance promises, against what many records give
    let (mut squares, mut within) = ([0.0; UNKNOWNS], [0_u32; UNKNOWNS]);
    for _ in 0..RECORDS {
        let (found, covariance, ..) = fitted(&recorded(&mut random)?)?;
        for k in 0..UNKNOWNS {
            let off = found[k] - TRUTH[k];
            squares[k] += off * off / f64::from(RECORDS);
            within[k] += u32::from(off.abs() < 1.96 * covariance[(k, k)].sqrt());
        }
    }
    println!(
        "\n{:20} {:>8} {:>8} {:>9} {:>9} {:>12} {:>14}",
        "", "true", "guess", "found", "±", "± of 100", "within 1.96 ±"
    );
    for k in 0..UNKNOWNS {
        println!(
            "{:20} {:8.3} {:8.3} {:9.4} {:9.4} {:12.4} {:13}%",
            NAMES[k],
            TRUTH[k],
            GUESS[k],
            found[k],
            covariance[(k, k)].sqrt(),
            squares[k].sqrt(),
            within[k] * 100 / RECORDS,
        );
    }
    let correlation =
        |i: usize, j: usize| covariance[(i, j)] / (covariance[(i, i)] * covariance[(j, j)]).sqrt();
    println!("\ncorrelation of m and a {:.2}, of J and c {:.2}", correlation(0, 2), correlation(1, 3));
    Ok(())
}

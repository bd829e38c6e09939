//! A two-wheeled robot follows a curve by linear-quadratic regulation, and knows where it is only from
//! noisy odometry: an extended Kalman filter.
//!
//! `cargo run --release --example lqr_ekf`
//!
//! Everything that regulator and filter need of the model comes from the generated `jacobian`: the
//! gains along the curve by a Riccati recursion backwards in time, the torques on the curve by solving
//! the equations for the inputs, and the transition of the filter. The robot that is simulated is 15 %
//! heavier than its model believes.

use std::error::Error;
use std::f64::consts::TAU;

use nalgebra::{Matrix2, SMatrix, SVector, matrix, vector};
use nh_examples::{BLUE, Chart, MUTED, ORANGE, Page, Picture, Random, View};
use nonholonomic::control::{Estimate, Regulator, zero_order_hold};
use nonholonomic::prelude::*;

/// A body on two coaxial wheels that roll without slipping, its centre of mass ahead of the axle.
#[nonholonomic(
    base { x, y, theta }
    basis { v, side, omega }
    anchor {
        der(x) = v * cos(theta) - side * sin(theta);
        der(y) = v * sin(theta) + side * cos(theta);
        der(theta) = omega;
    }
    lagrangian {
        let right = (v + c * omega) / r;
        let left = (v - c * omega) / r;
        m / 2 * (v^2 + (side + l * omega)^2) + J / 2 * omega^2 + Jw / 2 * (right^2 + left^2)
    }
    constraints { side = 0; }
    forces { v: (torque_right + torque_left) / r; omega: c / r * (torque_right - torque_left); }
    inputs { torque_right, torque_left }
    outputs { rate_right = (v + c * omega) / r; rate_left = (v - c * omega) / r; }
    assume { m > 0; J > 0; Jw > 0; r > 0; c > 0; }
    units {
        x, y, l, c, r = m;
        theta = rad;
        m = kg;
        J, Jw = kg m^2;
        torque_right, torque_left = N m;
        rate_right, rate_left = rad/s;
    }
    emit { jacobian }
)]
#[derive(Clone, Copy, Debug)]
pub struct Robot {
    /// Mass (kg).
    pub m: f64,
    /// Moment of inertia about the vertical through the centre of mass (kg m²).
    pub J: f64,
    /// Moment of inertia of a wheel about its axle (kg m²).
    pub Jw: f64,
    /// Centre of mass ahead of the axle (m).
    pub l: f64,
    /// Half the distance between the wheels (m).
    pub c: f64,
    /// Radius of the wheels (m).
    pub r: f64,
}

/// Time between two ticks (s).
const TICK: f64 = 0.01;
/// Ticks in a round of the figure of eight.
const ROUND: u32 = 2000;
/// Standard deviations: of a wheel's rate (rad/s), of the gyroscope (rad/s), of a position fix (m).
const WHEEL: f64 = 0.3;
const GYROSCOPE: f64 = 0.02;
const FIX: f64 = 0.05;
/// A fix of the position arrives every so many ticks.
const BETWEEN_FIXES: u32 = 100;

type Vector = SVector<f64, 5>;
type Matrix = SMatrix<f64, 5, 5>;

/// The state on the curve at a time: pose, speed and rate of turning of a point on a figure of eight.
fn on_the_curve(t: f64) -> RobotState {
    let rate = TAU / (TICK * 2000.0);
    let ((sin, cos), (sin2, cos2)) = ((rate * t).sin_cos(), (2.0 * rate * t).sin_cos());
    let velocity = (2.0 * rate * cos, 2.0 * rate * cos2);
    let acceleration = (-2.0 * rate * rate * sin, -4.0 * rate * rate * sin2);
    let v = velocity.0.hypot(velocity.1);
    let omega = (velocity.0 * acceleration.1 - velocity.1 * acceleration.0) / (v * v);
    RobotState { x: 2.0 * sin, y: sin2, theta: velocity.1.atan2(velocity.0), v, omega }
}

/// The torques that hold the robot on the curve: the equations are affine in them.
fn torques_on_the_curve(robot: &Robot, t: f64) -> Result<SVector<f64, 2>, Box<dyn Error>> {
    let (here, next) = (on_the_curve(t), on_the_curve(t + TICK));
    let none = RobotInput::default();
    let coasting = robot.derivative(t, &here, &none);
    let (_, b) = robot.jacobian(t, &here, &none);
    let wanted =
        vector![(next.v - here.v) / TICK - coasting.v, (next.omega - here.omega) / TICK - coasting.omega];
    let effect = b.fixed_rows::<2>(3).into_owned();
    effect.lu().solve(&wanted).ok_or_else(|| "the torques do not reach speed and turning".into())
}

/// The state minus another one, the headings the short way round.
fn deviation(state: &RobotState, from: &RobotState) -> Vector {
    let mut e = Vector::from(*state) - Vector::from(*from);
    e[2] = (e[2] + TAU / 2.0).rem_euclid(TAU) - TAU / 2.0;
    e
}

/// The gains for every tick, from the last one backwards: the curve repeats, so the second round
/// backwards starts from the cost of the first.
fn gains(robot: &Robot) -> Result<Vec<Regulator<f64, 5, 2>>, Box<dyn Error>> {
    let state = Matrix::from_diagonal(&vector![40.0, 40.0, 10.0, 1.0, 1.0]);
    let input = Matrix2::identity() * 20.0;
    let mut cost = state;
    let mut plan = Vec::new();
    for tick in (0..2 * ROUND).rev() {
        let t = TICK * f64::from(tick % ROUND);
        let held = RobotInput::from(torques_on_the_curve(robot, t)?);
        let (a, b) = robot.jacobian(t, &on_the_curve(t), &held);
        let (a, b) = zero_order_hold(&a, &b, TICK)?;
        let regulator = Regulator::before(&cost, &a, &b, &state, &input)?;
        cost = regulator.cost;
        if tick < ROUND {
            plan.push(regulator);
        }
    }
    plan.reverse();
    Ok(plan)
}

/// What the filter believes after a tick with these torques.
fn predict(
    robot: &Robot,
    belief: &Estimate<f64, 5>,
    t: f64,
    input: &RobotInput,
) -> Result<Estimate<f64, 5>, Box<dyn Error>> {
    let mean = RobotState::from(belief.mean);
    let (a, b) = robot.jacobian(t, &mean, input);
    let (transition, _) = zero_order_hold(&a, &b, TICK)?;
    // the model's masses are not the robot's: accelerations are uncertain
    let noise = Matrix::from_diagonal(&vector![1e-10, 1e-10, 1e-10, 4e-6, 4e-5]);
    Ok(belief.predicted(Rk4::step(robot, t, TICK, &mean, input).into(), &transition, &noise)?)
}

/// What the filter believes after the sensors have spoken.
fn correct(
    robot: &Robot,
    belief: &Estimate<f64, 5>,
    real: &RobotState,
    tick: u32,
    noise: &mut Random,
) -> Result<Estimate<f64, 5>, Box<dyn Error>> {
    let mean = RobotState::from(belief.mean);
    let none = RobotInput::default();
    let (real_rates, believed) = (robot.outputs(0.0, real, &none), robot.outputs(0.0, &mean, &none));
    let innovation = vector![
        real_rates.rate_right + WHEEL * noise.normal() - believed.rate_right,
        real_rates.rate_left + WHEEL * noise.normal() - believed.rate_left,
        real.omega + GYROSCOPE * noise.normal() - mean.omega
    ];
    let (forward, turn) = (1.0 / robot.r, robot.c / robot.r);
    let observation = matrix![
        0.0, 0.0, 0.0, forward, turn;
        0.0, 0.0, 0.0, forward, -turn;
        0.0, 0.0, 0.0, 0.0, 1.0
    ];
    let spread = nalgebra::Matrix3::from_diagonal(&vector![WHEEL, WHEEL, GYROSCOPE].map(|s| s * s));
    let mut corrected = belief.corrected(&innovation, &observation, &spread)?.estimate;
    if tick.is_multiple_of(BETWEEN_FIXES) {
        let seen = vector![real.x + FIX * noise.normal(), real.y + FIX * noise.normal()];
        let observation = SMatrix::<f64, 2, 5>::identity();
        let innovation = seen - corrected.mean.fixed_rows::<2>(0);
        corrected =
            corrected.corrected(&innovation, &observation, &(Matrix2::identity() * FIX * FIX))?.estimate;
    }
    Ok(corrected)
}

/// What happened at one tick.
struct Moment {
    t: f64,
    real: RobotState,
    belief: Estimate<f64, 5>,
    off: Vector,
}

fn main() -> Result<(), Box<dyn Error>> {
    let model = Robot { m: 9.0, J: 0.25, Jw: 0.006, l: 0.06, c: 0.18, r: 0.08 };
    let robot = Robot { m: 1.15 * model.m, J: 1.15 * model.J, ..model };
    let plan = gains(&model)?;
    let mut noise = Random::new(7);
    let mut real = RobotState { x: 0.3, y: -0.4, theta: 1.2, ..RobotState::default() };
    let guess = RobotState { theta: 0.9, ..RobotState::default() };
    let spread = vector![0.25, 0.25, 0.1, 1e-4, 1e-4];
    let mut belief = Estimate { mean: guess.into(), covariance: Matrix::from_diagonal(&spread) };
    let mut film = Vec::new();
    println!("     t   off the curve   believed wrongly   3 sigma of x and y   torques");
    for (tick, regulator) in (0u32..).zip(&plan) {
        let t = TICK * f64::from(tick);
        belief = correct(&model, &belief, &real, tick, &mut noise)?;
        let e = deviation(&RobotState::from(belief.mean), &on_the_curve(t));
        let wanted = torques_on_the_curve(&model, t)? + regulator.input(&e);
        let input = RobotInput::from(wanted.map(|torque| torque.clamp(-0.4, 0.4)));
        let off = deviation(&real, &on_the_curve(t));
        if tick.is_multiple_of(200) {
            let wrong = (real.x - belief.mean[0]).hypot(real.y - belief.mean[1]);
            let sigma = [0, 1].map(|i| 3.0 * belief.covariance[(i, i)].sqrt());
            println!(
                "{t:6.1} {:15.4} {wrong:18.4} {:12.4} {:7.4} {:9.3} {:.3}",
                off[0].hypot(off[1]),
                sigma[0],
                sigma[1],
                input.torque_right,
                input.torque_left
            );
        }
        film.push(Moment { t, real, belief, off });
        belief = predict(&model, &belief, t, &input)?;
        real = Rk4::step(&robot, t, TICK, &real, &input);
    }
    let (mut settled, mut sum) = (0.0, 0.0);
    for moment in film.iter().filter(|moment| moment.t > 10.0) {
        settled += 1.0;
        sum += moment.off[0].powi(2) + moment.off[1].powi(2);
    }
    let mean_square: f64 = sum / settled;
    println!("root of the mean square off the curve after 10 s: {:.4} m", mean_square.sqrt());
    draw(&film).save("lqr_ekf")?;
    Ok(())
}

fn draw(film: &[Moment]) -> Picture {
    let title = "Regulated from an estimate";
    let subtitle = "Wheel encoders and a gyroscope at 100 Hz, a position fix each second; the robot is 15 % \
                    heavier than its model.";
    let mut picture = Picture::new(960.0, 800.0, title, subtitle);
    let points = film.iter().map(|moment| (moment.real.x, moment.real.y));
    let view = View::showing(points, 0.35, Page { x: 36.0, y: 96.0 }, 888.0, 500.0);
    view.grid(&mut picture, 0.5, "m");
    for moment in film.iter().step_by(25) {
        let (x, y) = (moment.belief.mean[0], moment.belief.mean[1]);
        let c = moment.belief.covariance;
        // the ellipse of three standard deviations, by the Cholesky factor of its covariance
        let (a, b) = (c[(0, 0)].sqrt(), c[(0, 1)] / c[(0, 0)].sqrt());
        let d = (c[(1, 1)] - b * b).max(0.0).sqrt();
        let ellipse: Vec<Page> = (0..36)
            .map(|k| (TAU * f64::from(k) / 36.0).sin_cos())
            .map(|(sin, cos)| view.at((x + 3.0 * a * cos, y + 3.0 * (b * cos + d * sin))))
            .collect();
        picture.polygon(&ellipse, r##"fill="#5b7bb0" fill-opacity="0.07" stroke="none""##);
    }
    let curve: Vec<Page> =
        film.iter().map(|moment| on_the_curve(moment.t)).map(|s| view.at((s.x, s.y))).collect();
    picture.line(&curve, &format!(r#"stroke="{MUTED}" stroke-width="1.3" stroke-dasharray="2 6""#));
    let path = |place: &dyn Fn(&Moment) -> (f64, f64)| -> Vec<Page> {
        film.iter().map(|moment| view.at(place(moment))).collect()
    };
    let believed = path(&|moment| (moment.belief.mean[0], moment.belief.mean[1]));
    picture.line(&believed, r##"stroke="#5b7bb0" stroke-width="1.2""##);
    let real = path(&|moment| (moment.real.x, moment.real.y));
    picture.line(&real, r##"stroke="#e8623e" stroke-width="2.4""##);
    let corner = Page { x: 76.0, y: 654.0 };
    let end = film.last().map_or(1.0, |moment| moment.t);
    let mut chart = Chart::new(corner, [848.0, 90.0], [0.0, end], [0.0, 0.75]);
    let wrong = film.iter().map(|m| (m.t, (m.real.x - m.belief.mean[0]).hypot(m.real.y - m.belief.mean[1])));
    chart.line("of the estimate from the truth", BLUE, wrong);
    let off = film.iter().map(|moment| (moment.t, moment.off[0].hypot(moment.off[1])));
    chart.line("from the curve", ORANGE, off);
    chart.draw(&mut picture, "Distance (m)", "s");
    picture
}

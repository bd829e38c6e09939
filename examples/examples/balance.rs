//! A robot on two wheels balances and drives a figure eight by predictive control, although it is not quite the
//! model and is pushed.
//!
//! `cargo run --release --example balance`
//!
//! In every tick the plan is improved once from the state that is measured, its first inputs are applied, and
//! it is shifted. Upright is unstable: the inputs of a plan alone, rolled out in a model that is a little wrong,
//! lead away from the plan, so that the loop that does only this falls over. `Ilqr` follows its last plan by
//! its feedback from where the robot really is, and goes on from there.

use std::error::Error;

use nalgebra::{SVector, vector};
use nh_examples::{BLUE, Chart, FAINT, INK, MUTED, Page, Picture, View};
use nonholonomic::control::{ControlError, Ilqr, Model, Residuals, Sampled, Squares};
use nonholonomic::prelude::*;

/// Two driven wheels side by side, and a body that is mounted on their axle.
#[nonholonomic(
    base {
        x, y,
        /// The heading.
        theta,
        /// How far the body leans ahead.
        tilt
    }
    basis { v, side, omega, fall }
    anchor {
        der(x) = v * cos(theta) - side * sin(theta);
        der(y) = v * sin(theta) + side * cos(theta);
        der(theta) = omega;
        der(tilt) = fall;
    }
    lagrangian {
        // the centre of the body is l above the axle
        let ahead = v + l * cos(tilt) * fall;
        let left = side + l * sin(tilt) * omega;
        let up = -l * sin(tilt) * fall;
        wheels / 2 * (v^2 + side^2) + turning / 2 * omega^2 + J / 2 * fall^2
            + m / 2 * (ahead^2 + left^2 + up^2) - m * g * l * cos(tilt)
    }
    constraints { side = 0; }
    inputs {
        /// The torques of the motors (N m).
        left_wheel, right_wheel
    }
    forces {
        v: (left_wheel + right_wheel) / r + push;
        omega: (right_wheel - left_wheel) * track / (2 * r);
        // the motors turn the body back, a push at its top turns it ahead
        fall: 2 * l * cos(tilt) * push - left_wheel - right_wheel;
    }
    assume { wheels > 0; turning > 0; m > 0; J > 0; r > 0; l > 0; }
    units {
        x, y, l, r, track = m;
        theta, tilt = rad;
        wheels, m = kg;
        turning, J = kg m^2;
        push = N;
        g = m/s^2;
        left_wheel, right_wheel = N m;
    }
    emit { jacobian }
)]
#[derive(Clone, Copy, Debug)]
pub struct Robot {
    /// Mass of the wheels, with what their turning adds (kg).
    pub wheels: f64,
    /// Moment of inertia about the vertical (kg m²).
    pub turning: f64,
    /// Mass of the body (kg).
    pub m: f64,
    /// Its moment of inertia about its centre (kg m²).
    pub J: f64,
    /// The height of its centre above the axle (m).
    pub l: f64,
    /// The radius of the wheels (m).
    pub r: f64,
    /// The distance between them (m).
    pub track: f64,
    /// A push against the top of the body (N).
    pub push: f64,
    /// Gravity (m/s²).
    pub g: f64,
}

/// Time from tick to tick (s), the ticks of a plan, and those of the run.
const TICK: f64 = 0.02;
const HORIZON: usize = 50;
const TICKS: usize = 3000;
/// The largest torque of a motor (N m).
const BOUND: f64 = 2.5;
/// Half the length of the figure eight (m), and the time for it (s).
const SIZE: f64 = 2.5;
const ROUND: f64 = 20.0;
/// The pushes: when, for how long (s), and how hard (N).
const PUSHES: [(f64, f64, f64); 3] = [(9.0, 0.15, 12.0), (24.0, 0.2, -12.0), (43.0, 0.1, 20.0)];

type Plan = Ilqr<f64, 7, 2, HORIZON>;

/// Where the robot should be: a figure eight, entered slowly.
fn wanted(t: f64) -> (f64, f64) {
    let phase = std::f64::consts::TAU / ROUND * (t - 2.0 * (1.0 - (-t / 2.0).exp()));
    (SIZE * phase.sin(), SIZE / 2.0 * (2.0 * phase).sin())
}

fn push(t: f64) -> f64 {
    PUSHES.iter().filter(|(start, length, _)| *start <= t && t < start + length).map(|push| push.2).sum()
}

/// To follow the figure upright, with little effort; `now` is the time of the first tick.
struct Follow {
    now: f64,
}

impl Follow {
    fn off<S: Scalar>(&self, tick: u32, x: &[S; 7], mut add: impl FnMut(S)) {
        let (px, py) = wanted(self.now + TICK * f64::from(tick));
        let weight = S::from_f64(3.0);
        add(weight * (x[0] - S::from_f64(px)));
        add(weight * (x[1] - S::from_f64(py)));
    }
}

impl Residuals<7, 2> for Follow {
    fn stage<S: Scalar>(&self, tick: usize, x: &[S; 7], u: &[S; 2], mut add: impl FnMut(S)) {
        self.off(u32::try_from(tick).unwrap_or(0), x, &mut add);
        for (weight, x) in [(2.0, x[3]), (0.3, x[5]), (0.2, x[6]), (0.3, u[0]), (0.3, u[1])] {
            add(S::from_f64(weight) * x);
        }
    }

    fn end<S: Scalar>(&self, x: &[S; 7], mut add: impl FnMut(S)) {
        let end = u32::try_from(HORIZON).unwrap_or(0);
        self.off(end, x, |r| add(S::from_f64(5.0) * r));
        for (weight, x) in [(20.0, x[3]), (3.0, x[5]), (5.0, x[6])] {
            add(S::from_f64(weight) * x);
        }
    }
}

/// A moment of a run.
struct Moment {
    t: f64,
    state: RobotState,
    torque: [f64; 2],
}

/// A run until the end, or until the robot lies on the ground.
fn driven(model: &Robot, real: &Robot, feedback: bool) -> Result<Vec<Moment>, ControlError> {
    let planned = Sampled { system: *model, start: 0.0, dt: TICK };
    let bound = vector![BOUND, BOUND];
    let mut plan = Plan::new(SVector::zeros()).bounds(-bound, bound);
    let mut x: SVector<f64, 7> = RobotState::default().into();
    let mut film = Vec::new();
    for tick in 0..u32::try_from(TICKS).unwrap_or(0) {
        let t = TICK * f64::from(tick);
        if !feedback {
            // inputs that have been touched are taken as they are
            let _ = plan.inputs_mut();
        }
        plan.improve(&planned, &Squares(Follow { now: t }), &x)?;
        let torque = plan.inputs()[0];
        let plant = Sampled { system: Robot { push: push(t), ..*real }, start: t, dt: TICK };
        x = plant.step(0, &x, &torque);
        plan.shift();
        film.push(Moment { t, state: x.into(), torque: torque.into() });
        if x[3].abs() > 1.0 {
            break;
        }
    }
    Ok(film)
}

/// The time that a robot stays up, its largest tilt, and its distance from where it should be: the largest, and in
/// the mean.
fn summary(film: &[Moment]) -> [f64; 4] {
    let end = film.last().map_or(0.0, |moment| moment.t);
    let tilt = film.iter().fold(0.0, |most: f64, moment| most.max(moment.state.tilt.abs()));
    let off = film.iter().map(|moment| {
        let (x, y) = wanted(moment.t + TICK);
        (moment.state.x - x).hypot(moment.state.y - y)
    });
    let (most, sum, count) = off.fold((0.0, 0.0, 0.0), |(most, sum, count): (f64, f64, f64), off| {
        (most.max(off), sum + off, count + 1.0)
    });
    [end, tilt, most, sum / count]
}

fn main() -> Result<(), Box<dyn Error>> {
    let model = Robot {
        wheels: 1.2,
        turning: 0.08,
        m: 4.0,
        J: 0.09,
        l: 0.25,
        r: 0.08,
        track: 0.3,
        push: 0.0,
        g: 9.81,
    };
    model.validate()?;
    println!("body heavier,                        up for   largest tilt      off by (m)");
    println!("taller by     plan followed by          (s)          (rad)   most     mean");
    let mut shown = Vec::new();
    for share in [0.0, 0.02, 0.1] {
        let real = Robot { m: model.m * (1.0 + share), l: model.l * (1.0 + share), ..model };
        for (name, feedback) in [("its inputs alone", false), ("its feedback", true)] {
            let film = driven(&model, &real, feedback)?;
            let [end, tilt, most, mean] = summary(&film);
            println!("{:8.0} %    {name:18} {end:10.1} {tilt:14.2} {most:6.2} {mean:8.2}", 100.0 * share);
            if feedback {
                assert!(film.len() == TICKS && tilt < 0.6 && most < 0.6, "{share}: {tilt} {most}");
            }
            if feedback && share > 0.01 && shown.is_empty() {
                shown = film;
            }
        }
    }
    draw(&shown).save("balance")?;
    Ok(())
}

/// The figure as it was driven, the tilt, and the torques.
fn draw(film: &[Moment]) -> Picture {
    let title = "Balancing on two wheels around a figure eight";
    let subtitle = "Predictive control by iLQR, one iteration per tick of 20 ms; the body is 2 % heavier and taller \
                    than planned, and is pushed three times.";
    let mut picture = Picture::new(1000.0, 700.0, title, subtitle);
    let view = View::showing([(-2.9, -1.55), (2.9, 1.55)], 0.1, Page { x: 40.0, y: 90.0 }, 920.0, 340.0);
    let goal: Vec<Page> =
        (0..=400_u32).map(|i| view.at(wanted(ROUND + ROUND * f64::from(i) / 400.0))).collect();
    picture.line(&goal, &format!(r#"stroke="{FAINT}" stroke-width="7""#));
    let path: Vec<Page> = film.iter().map(|moment| view.at((moment.state.x, moment.state.y))).collect();
    picture.line(&path, r##"stroke="#e8623e" stroke-width="1.2""##);
    for (start, _, _) in PUSHES {
        if let Some(moment) = film.iter().find(|moment| moment.t >= start) {
            let at = view.at((moment.state.x, moment.state.y));
            picture.circle(at, 4.0, &format!(r#"fill="{INK}""#));
            let beside = Page { x: at.x + 8.0, y: at.y - 8.0 };
            picture.text(
                beside,
                &format!("push at {start:.0} s"),
                &format!(r#"font-size="12" fill="{MUTED}""#),
            );
        }
    }
    let end = TICK * 3000.0;
    let charts = [("tilt (rad)", 90.0, 0.4), ("torque of the left motor (N m)", 560.0, 2.5)];
    for (index, (name, x, size)) in charts.into_iter().enumerate() {
        let mut chart = Chart::new(Page { x, y: 500.0 }, [380.0, 150.0], [0.0, end], [-size, size]);
        let curve = film.iter().map(|moment| {
            let value = if index == 0 { moment.state.tilt } else { moment.torque[0] };
            (moment.t, value.clamp(-size, size))
        });
        chart.line("", BLUE, curve);
        chart.draw(&mut picture, name, "s");
    }
    picture
}

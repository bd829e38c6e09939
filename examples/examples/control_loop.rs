//! A loop at a thousand ticks a second: how long a tick computes, and how punctually it starts.
//!
//! `cargo run --release --example control_loop`
//!
//! In every tick the robot's model is stepped, linearised and discretised, and the covariance of its
//! state is carried on: what an estimator does between two measurements. The computation takes
//! microseconds, and nearly the same ones every time, for nothing in it allocates, branches on data or
//! iterates; the start of a tick is as late as the operating system wakes the thread, which is not the
//! business of the model: on a machine without an operating system it is a timer's interrupt.

use std::error::Error;
use std::hint::black_box;
use std::thread;
use std::time::{Duration, Instant};

use nalgebra::{SMatrix, SVector};
use nh_examples::{BLUE, Chart, MUTED, ORANGE, Page, Picture, Scale};
use nonholonomic::control::{Estimate, zero_order_hold};
use nonholonomic::prelude::*;

/// Two driven wheels and a body.
#[nonholonomic(
    base { x, y, theta }
    basis { v, side, omega }
    anchor {
        der(x) = v * cos(theta) - side * sin(theta);
        der(y) = v * sin(theta) + side * cos(theta);
        der(theta) = omega;
    }
    lagrangian { m / 2 * (v^2 + (side + l * omega)^2) + J / 2 * omega^2 }
    constraints { side = 0; }
    forces { v: (torque_right + torque_left) / r; omega: c / r * (torque_right - torque_left); }
    inputs { torque_right, torque_left }
    assume { m > 0; J > 0; r > 0; }
    units { x, y, l, c, r = m; theta = rad; m = kg; J = kg m^2; torque_right, torque_left = N m; }
    emit { jacobian }
)]
#[derive(Clone, Copy, Debug)]
struct Robot {
    m: f64,
    J: f64,
    l: f64,
    c: f64,
    r: f64,
}

/// The length of a tick, and their number.
const TICK: Duration = Duration::from_millis(1);
const TICKS: u32 = 2000;

/// What a tick computes.
fn tick(robot: &Robot, belief: &Estimate<f64, 5>, t: f64) -> Result<Estimate<f64, 5>, Box<dyn Error>> {
    let dt = TICK.as_secs_f64();
    let input = RobotInput { torque_right: 0.1 * t.sin(), torque_left: 0.1 * t.cos() };
    let mean = RobotState::from(belief.mean);
    let (a, b) = robot.jacobian(t, &mean, &input);
    let (transition, _) = zero_order_hold(&a, &b, dt)?;
    let next = Rk4::step(robot, t, dt, &mean, &input);
    Ok(belief.predicted(next.into(), &transition, &(SMatrix::identity() * 1e-9))?)
}

/// Durations in microseconds, sorted.
fn sorted(durations: &[Duration]) -> Vec<f64> {
    let mut microseconds: Vec<f64> = durations.iter().map(|d| d.as_secs_f64() * 1e6).collect();
    microseconds.sort_by(f64::total_cmp);
    microseconds
}

/// The value that this many of ten thousand in a sorted list do not exceed.
fn quantile(sorted: &[f64], of_ten_thousand: usize) -> f64 {
    let rank = (sorted.len() * of_ten_thousand).div_ceil(10_000);
    sorted.get(rank.saturating_sub(1)).copied().unwrap_or(f64::NAN)
}

fn main() -> Result<(), Box<dyn Error>> {
    let robot = Robot { m: 9.0, J: 0.25, l: 0.06, c: 0.18, r: 0.08 };
    robot.validate()?;
    let mut belief = Estimate { mean: SVector::zeros(), covariance: SMatrix::identity() * 1e-4 };
    let (mut late, mut busy) = (Vec::new(), Vec::new());
    let mut due = Instant::now();
    for index in 0..TICKS {
        due += TICK;
        thread::sleep(due.saturating_duration_since(Instant::now()));
        let woken = Instant::now();
        belief = black_box(tick(&robot, &belief, TICK.as_secs_f64() * f64::from(index))?);
        busy.push(woken.elapsed());
        late.push(woken.saturating_duration_since(due));
    }
    let (late, busy) = (sorted(&late), sorted(&busy));
    println!("microseconds           median      90 %      99 %    99.9 %     worst");
    for (name, values) in [("computing", &busy), ("starting late", &late)] {
        let row = [5000, 9000, 9900, 9990, 10_000].map(|share| format!("{:10.1}", quantile(values, share)));
        println!("{name:18} {}", row.concat());
    }
    println!("share of the tick in use: {:.2} % (median)", quantile(&busy, 5000) / 10.0);
    draw(&busy, &late).save("control_loop")?;
    Ok(())
}

fn draw(busy: &[f64], late: &[f64]) -> Picture {
    let title = "A thousand ticks a second";
    let subtitle =
        "The share of the ticks that took longer than a time to compute, or woke up later than that.";
    let mut picture = Picture::new(960.0, 400.0, title, subtitle);
    let mut chart = Chart::new(Page { x: 90.0, y: 130.0 }, [790.0, 200.0], [0.1, 1e4], [0.03, 100.0])
        .scales(Scale::Logarithmic, Scale::Logarithmic);
    for (name, values, colour) in [("waking up late", late, BLUE), ("computing", busy, ORANGE)] {
        let count = f64::from(TICKS);
        let curve = (0..TICKS).zip(values).map(|(index, value)| {
            let share = (count - f64::from(index)) / count;
            (value.clamp(0.1, 1e4), (100.0 * share).max(0.03))
        });
        chart.line(name, colour, curve);
    }
    chart.draw(&mut picture, "Share of the ticks (%)", "µs");
    let note = "time on a logarithmic scale; an ordinary thread of an operating system";
    let at = Page { x: 890.0, y: 384.0 };
    picture.text(at, note, &format!(r#"font-size="12" fill="{MUTED}" text-anchor="end""#));
    picture
}

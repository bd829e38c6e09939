//! A mobile robot: two driven wheels on one axle and a caster, steered along a curve by torques.
//!
//! `cargo run --release --example mobile_robot`
//!
//! A controller runs a hundred times a second, as on the robot: it compares the pose with a point
//! that runs along a figure of eight, asks for a speed and a rate of turning, and from them for
//! torques on the wheels. Between two of its ticks the torques are constant, so the work that they
//! do is exactly torque times angle, and the energy of the robot has to be that.

use std::error::Error;
use std::f64::consts::TAU;

use nh_examples::{BACKGROUND, BLUE, Chart, Colours, INK, MUTED, ORANGE, Page, Picture, Pose, View};
use nonholonomic::prelude::*;

/// A body on two coaxial wheels that roll without slipping, its centre of mass ahead of the axle.
#[nonholonomic(
    base { x, y, theta, right, left }
    basis {
        /// Speed along the body.
        v,
        /// Speed across it.
        side,
        /// Rate of turning.
        omega,
        /// Rate of the right wheel.
        spin_right,
        /// Rate of the left wheel.
        spin_left,
    }
    anchor {
        der(x) = v * cos(theta) - side * sin(theta);
        der(y) = v * sin(theta) + side * cos(theta);
        der(theta) = omega;
        der(right) = spin_right;
        der(left) = spin_left;
    }
    lagrangian {
        m / 2 * (v^2 + (side + l * omega)^2) + J / 2 * omega^2 + Jw / 2 * (spin_right^2 + spin_left^2)
    }
    constraints {
        no_skidding: side = 0;
        rolling_right: r * spin_right = v + c * omega;
        rolling_left: r * spin_left = v - c * omega;
    }
    independent { v, omega }
    forces { right: torque_right; left: torque_left; }
    inputs { torque_right, torque_left }
    assume { r > 0; c > 0; }
    units {
        x, y, l, c, r = m;
        theta, right, left = rad;
        m = kg;
        J, Jw = kg m^2;
        torque_right, torque_left = N m;
    }
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

/// Time between two ticks of the controller (s).
const TICK: f64 = 0.01;
/// Ticks in a round of the figure of eight.
const ROUND: u32 = 2000;

/// The point to follow: its pose, speed and rate of turning.
struct Target {
    pose: Pose,
    speed: f64,
    turning: f64,
}

/// A point on a figure of eight, twice as long as it is wide.
fn target(t: f64) -> Target {
    let rate = TAU / (TICK * f64::from(ROUND));
    let (sin, cos) = (rate * t).sin_cos();
    let (sin2, cos2) = (2.0 * rate * t).sin_cos();
    let velocity = (2.0 * rate * cos, 2.0 * rate * cos2);
    let acceleration = (-2.0 * rate * rate * sin, -4.0 * rate * rate * sin2);
    let speed = velocity.0.hypot(velocity.1);
    let turning = (velocity.0 * acceleration.1 - velocity.1 * acceleration.0) / (speed * speed);
    Target { pose: Pose { x: 2.0 * sin, y: sin2, heading: velocity.1.atan2(velocity.0) }, speed, turning }
}

impl Robot {
    /// The torques of the controller.
    fn control(&self, t: f64, state: &RobotState) -> RobotInput {
        let target = target(t);
        // where the target is, in the frame of the robot
        let (sin, cos) = state.theta.sin_cos();
        let (dx, dy) = (target.pose.x - state.x, target.pose.y - state.y);
        let (ahead, left) = (dx * cos + dy * sin, dy * cos - dx * sin);
        let aside = (target.pose.heading - state.theta + TAU / 2.0).rem_euclid(TAU) - TAU / 2.0;
        // Kanayama's law for speed and rate of turning
        let speed = target.speed * aside.cos() + 1.2 * ahead;
        let turning = target.turning + target.speed * (4.0 * left + 2.5 * aside.sin());
        let forward = 8.0 * (speed - state.v) * self.m * self.r / 2.0;
        let sideways = 8.0 * (turning - state.omega) * self.J * self.r / (2.0 * self.c);
        let torque = |wanted: f64| wanted.clamp(-0.4, 0.4);
        RobotInput { torque_right: torque(forward + sideways), torque_left: torque(forward - sideways) }
    }
}

/// What happened at one tick.
#[derive(Clone, Copy)]
struct Moment {
    t: f64,
    state: RobotState,
    torques: RobotInput,
}

fn main() -> Result<(), Box<dyn Error>> {
    let robot = Robot { m: 9.0, J: 0.25, Jw: 0.006, l: 0.06, c: 0.18, r: 0.08 };
    robot.validate()?;
    let mut state = RobotState { x: -1.0, y: 1.25, theta: 0.3, ..RobotState::default() };
    let mut work = robot.energy(0.0, &state);
    let mut film = Vec::new();
    println!("     t         x         y   off track         v     omega      energy  energy - work");
    for tick in 0..=ROUND {
        let t = TICK * f64::from(tick);
        let torques = robot.control(t, &state);
        film.push(Moment { t, state, torques });
        if tick % 200 == 0 {
            let goal = target(t).pose;
            let off = (goal.x - state.x).hypot(goal.y - state.y);
            let energy = robot.energy(t, &state);
            println!(
                "{t:6.1} {:9.4} {:9.4} {off:11.4} {:9.4} {:9.4} {energy:11.6} {:14.1e}",
                state.x,
                state.y,
                state.v,
                state.omega,
                energy - work
            );
        }
        let next = Rk4::step(&robot, t, TICK, &state, &torques);
        work += torques.torque_right * (next.right - state.right);
        work += torques.torque_left * (next.left - state.left);
        state = next;
    }
    draw(&robot, &film).save("mobile_robot")?;
    Ok(())
}

fn draw(robot: &Robot, film: &[Moment]) -> Picture {
    let mut picture = Picture::new(
        960.0,
        800.0,
        "Mobile robot",
        "Two wheels that roll without slipping, driven by torques at 100 Hz, catch up with a point on a figure of eight.",
    );
    let points = film.iter().map(|moment| (moment.state.x, moment.state.y));
    let view = View::showing(points, 0.35, Page { x: 36.0, y: 96.0 }, 888.0, 500.0);
    view.grid(&mut picture, 0.5, "m");
    let goals: Vec<Page> =
        film.iter().map(|moment| target(moment.t).pose).map(|pose| view.at((pose.x, pose.y))).collect();
    picture.line(&goals, &format!(r#"stroke="{MUTED}" stroke-width="1.3" stroke-dasharray="2 6""#));
    let coloured: Vec<(Page, f64)> =
        film.iter().map(|moment| (view.at((moment.state.x, moment.state.y)), moment.state.v)).collect();
    let colours = Colours::covering(coloured.iter().map(|(_, speed)| *speed));
    colours.draw(&mut picture, &coloured, r#"stroke-width="2.6""#);
    for moment in film.iter().step_by(100) {
        draw_robot(&mut picture, &view, robot, &moment.state);
    }
    colours.key(&mut picture, Page { x: 764.0, y: 560.0 }, 150.0, "speed", "m/s");
    draw_torques(&mut picture, film);
    let note = format!(
        "m = {} kg, J = {} kg m², centre of mass {} m ahead of the axle (circle); drawn every second; dotted: the curve to follow",
        robot.m, robot.J, robot.l
    );
    picture.text(
        Page { x: 924.0, y: 788.0 },
        &note,
        &format!(r#"font-size="12" fill="{MUTED}" text-anchor="end""#),
    );
    picture
}

/// The body from above: a rounded plate, two wheels, the centre of mass.
fn draw_robot(picture: &mut Picture, view: &View, robot: &Robot, state: &RobotState) {
    let pose = Pose { x: state.x, y: state.y, heading: state.theta };
    let plate: Vec<(f64, f64)> = (0..24)
        .map(|corner| {
            let (sin, cos) = (TAU * f64::from(corner) / 24.0).sin_cos();
            (0.05 + 0.15 * cos, 0.13 * sin)
        })
        .collect();
    let body = view.body(pose, &plate);
    picture.polygon(
        &body,
        &format!(
            r##"fill="#c9d3e2" fill-opacity="0.45" stroke="{INK}" stroke-opacity="0.55" stroke-width="1""##
        ),
    );
    for side in [robot.c, -robot.c] {
        let wheel = view.body(pose, &[(-robot.r, side), (robot.r, side)]);
        picture.line(&wheel, &format!(r#"stroke="{INK}" stroke-width="4" stroke-linecap="butt""#));
    }
    let axle = view.body(pose, &[(0.0, robot.c), (0.0, -robot.c)]);
    picture.line(&axle, &format!(r#"stroke="{INK}" stroke-width="1.2""#));
    let mass = view.at(pose.point(robot.l, 0.0));
    picture.circle(mass, 2.6, &format!(r#"fill="{BACKGROUND}" stroke="{INK}" stroke-width="1.2""#));
}

/// The torques over time.
fn draw_torques(picture: &mut Picture, film: &[Moment]) {
    let end = TICK * f64::from(ROUND);
    let corner = Page { x: 76.0, y: 654.0 };
    let mut chart = Chart::new(corner, [848.0, 90.0], [0.0, end], [-0.5, 0.5]);
    let left = film.iter().map(|moment| (moment.t, moment.torques.torque_left));
    chart.line("left wheel", BLUE, left);
    let right = film.iter().map(|moment| (moment.t, moment.torques.torque_right));
    chart.line("right wheel", ORANGE, right);
    chart.draw(picture, "Torque (N m)", "s");
}

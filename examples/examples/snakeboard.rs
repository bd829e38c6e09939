//! The snakeboard: a board on two pairs of wheels that steer against each other, with a rotor.
//!
//! `cargo run --release --example snakeboard`
//!
//! Its rider never touches the ground: turning the rotor and steering the wheels, in the right
//! rhythm, makes the board go. The rhythm (the gait) is prescribed by two constraints that depend on
//! time; their multipliers are the torques that the rider has to apply.

use std::error::Error;
use std::f64::consts::FRAC_PI_2;

use nh_examples::{BACKGROUND, Chart, Colours, INK, MUTED, ORANGE, Page, Picture, Pose, View};
use nonholonomic::prelude::*;

/// A snakeboard with a prescribed gait. The total inertia is m l².
#[nonholonomic(
    base { x, y, theta, psi, phi }
    basis {
        /// Speed along the board.
        u1,
        /// Speed across it.
        u2,
        /// Rate of turning.
        omega,
        /// Rate of the rotor against the board.
        dpsi,
        /// Rate of steering.
        dphi,
    }
    anchor {
        der(x) = u1 * cos(theta) - u2 * sin(theta);
        der(y) = u1 * sin(theta) + u2 * cos(theta);
        der(theta) = omega;
        der(psi) = dpsi;
        der(phi) = dphi;
    }
    lagrangian {
        m / 2 * (u1^2 + u2^2) + m * l^2 / 2 * omega^2 + J0 / 2 * dpsi^2 + J0 * dpsi * omega + J1 * dphi^2
    }
    constraints {
        front:  sin(phi) * u1 - cos(phi) * (u2 + l * omega) = 0;
        back:   sin(phi) * u1 + cos(phi) * (u2 - l * omega) = 0;
        rotor:  dpsi = rotor_amplitude * rotor_rate * cos(rotor_rate * t);
        steering: dphi = steering_amplitude * steering_rate * cos(steering_rate * t);
    }
    independent { u1 }
    units {
        x, y, l = m;
        theta, psi, phi = rad;
        m = kg;
        J0, J1 = kg m^2;
        rotor_amplitude, steering_amplitude = rad;
        rotor_rate, steering_rate = s^-1;
    }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
pub struct Snakeboard {
    /// Mass (kg).
    pub m: f64,
    /// Half the distance between the wheel pairs (m).
    pub l: f64,
    /// Moment of inertia of the rotor (kg m²).
    pub J0: f64,
    /// Moment of inertia of each pair of wheels (kg m²).
    pub J1: f64,
    /// Amplitude of the rotor.
    pub rotor_amplitude: f64,
    /// Angular frequency of the rotor (1/s).
    pub rotor_rate: f64,
    /// Amplitude of the steering.
    pub steering_amplitude: f64,
    /// Angular frequency of the steering (1/s).
    pub steering_rate: f64,
}

/// A rhythm, and where its picture stands.
struct Gait {
    name: &'static str,
    rotor_rate: f64,
    steering_rate: f64,
    /// The heading at the start.
    heading: f64,
    end: f64,
    corner: Page,
    width: f64,
    height: f64,
    /// The time between two boards that are drawn, in samples.
    every: usize,
}

const GAITS: [Gait; 3] = [
    Gait {
        name: "1 : 1  it drives, for 24 s",
        rotor_rate: 1.0,
        steering_rate: 1.0,
        heading: 0.0,
        end: 24.0,
        corner: Page { x: 36.0, y: 124.0 },
        width: 888.0,
        height: 150.0,
        every: 400,
    },
    Gait {
        name: "2 : 1  it turns on the spot, for 36 s",
        rotor_rate: 2.0,
        steering_rate: 1.0,
        heading: 0.0,
        end: 36.0,
        corner: Page { x: 36.0, y: 316.0 },
        width: 434.0,
        height: 280.0,
        every: 1500,
    },
    Gait {
        name: "3 : 2  it parks sideways, for 75 s",
        rotor_rate: 3.0,
        steering_rate: 2.0,
        heading: -FRAC_PI_2,
        end: 75.0,
        corner: Page { x: 490.0, y: 316.0 },
        width: 434.0,
        height: 280.0,
        every: 1000,
    },
];

/// Samples of each run.
const SAMPLES: u32 = 6000;

/// What happened at one instant.
struct Moment {
    t: f64,
    state: SnakeboardState,
    torques: SnakeboardMultipliers,
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut films = Vec::new();
    for gait in &GAITS {
        println!("rotor : steering = {}", gait.name);
        films.push(ride(gait)?);
        println!();
    }
    draw(&films).save("snakeboard")?;
    Ok(())
}

/// Rides a gait from rest and compares the energy with the work of the torques.
fn ride(gait: &Gait) -> Result<Vec<Moment>, IntegrationError> {
    let board = Snakeboard {
        m: 6.0,
        l: 0.2,
        J0: 0.072,
        J1: 0.0013,
        rotor_amplitude: 1.4,
        rotor_rate: gait.rotor_rate,
        steering_amplitude: 0.6,
        steering_rate: gait.steering_rate,
    };
    let start = SnakeboardState { theta: gait.heading, ..SnakeboardState::default() };
    let mut sim = Integrator::new(board, Dopri5::new().rtol(1e-11).atol(1e-13), 0.0, start);
    println!("     t         x         y     theta        u1      energy  energy - work   rotor torque");
    let mut film: Vec<Moment> = Vec::new();
    let mut work = board.energy(0.0, &start);
    for sample in 0..=SAMPLES {
        let t = gait.end * f64::from(sample) / f64::from(SAMPLES);
        sim.advance_to(t)?;
        let state = *sim.state();
        film.push(Moment { t, state, torques: board.multipliers(t, &state, &()) });
        // Simpson's rule over the last two intervals
        if sample % 2 == 0
            && let [.., a, b, c] = film.as_slice()
        {
            let power = |moment: &Moment| {
                let velocity = board.velocity(moment.t, &moment.state);
                moment.torques.rotor * velocity.dpsi + moment.torques.steering * velocity.dphi
            };
            work += (power(a) + 4.0 * power(b) + power(c)) * (c.t - a.t) / 6.0;
        }
        if sample % 1000 == 0 {
            let energy = board.energy(t, &state);
            println!(
                "{t:6.1} {:9.4} {:9.4} {:9.4} {:9.4} {energy:11.6} {:14.1e} {:14.4}",
                state.x,
                state.y,
                state.theta,
                state.u1,
                energy - work,
                film[film.len() - 1].torques.rotor
            );
        }
    }
    Ok(film)
}

fn draw(films: &[Vec<Moment>]) -> Picture {
    let mut picture = Picture::new(
        960.0,
        800.0,
        "Snakeboard",
        "From a standstill and without touching the ground: three rhythms of turning the rotor and steering the wheels.",
    );
    for (gait, film) in GAITS.iter().zip(films) {
        let points = film.iter().map(|moment| (moment.state.x, moment.state.y));
        let view = View::showing(points, 0.32, gait.corner, gait.width, gait.height);
        view.grid(&mut picture, 0.5, "m");
        let title = Page { y: gait.corner.y - 10.0, ..gait.corner };
        picture.text(title, gait.name, &format!(r#"font-size="13.5" fill="{INK}""#));
        let coloured: Vec<(Page, f64)> =
            film.iter().map(|moment| (view.at((moment.state.x, moment.state.y)), moment.t)).collect();
        for moment in film.iter().step_by(gait.every) {
            draw_board(&mut picture, &view, &moment.state);
        }
        Colours { low: 0.0, high: gait.end }.draw(&mut picture, &coloured, r#"stroke-width="1.8""#);
    }
    Colours { low: 0.0, high: 1.0 }.key(
        &mut picture,
        Page { x: 774.0, y: 96.0 },
        150.0,
        "share of the time",
        "",
    );
    draw_torque(&mut picture, &films[0]);
    let note = "m = 6 kg, half length 0.2 m, rotor 0.072 kg m²; amplitudes: rotor 1.4, steering 0.6";
    picture.text(
        Page { x: 924.0, y: 788.0 },
        note,
        &format!(r#"font-size="12" fill="{MUTED}" text-anchor="end""#),
    );
    picture
}

/// The board, its wheels as they are steered, and the rotor.
fn draw_board(picture: &mut Picture, view: &View, state: &SnakeboardState) {
    let pose = Pose { x: state.x, y: state.y, heading: state.theta };
    picture.line(&view.body(pose, &[(-0.2, 0.0), (0.2, 0.0)]), r##"stroke="#aab6c8" stroke-width="5""##);
    for (ahead, angle) in [(0.2, state.phi), (-0.2, -state.phi)] {
        let (sin, cos) = angle.sin_cos();
        for side in [0.07, -0.07] {
            let (x, y) = (ahead - side * sin, side * cos);
            let wheel = [(x - 0.04 * cos, y - 0.04 * sin), (x + 0.04 * cos, y + 0.04 * sin)];
            picture.line(
                &view.body(pose, &wheel),
                &format!(r#"stroke="{INK}" stroke-width="2.6" stroke-linecap="butt""#),
            );
        }
        let axle = [(ahead - 0.07 * sin, 0.07 * cos), (ahead + 0.07 * sin, -0.07 * cos)];
        picture.line(&view.body(pose, &axle), &format!(r#"stroke="{INK}" stroke-width="1""#));
    }
    let (sin, cos) = state.psi.sin_cos();
    let rotor = [(0.1 * sin, -0.1 * cos), (-0.1 * sin, 0.1 * cos)];
    picture.line(&view.body(pose, &rotor), r##"stroke="#e8623e" stroke-width="2.2""##);
    picture.circle(
        view.at(pose.point(0.0, 0.0)),
        2.4,
        &format!(r#"fill="{BACKGROUND}" stroke="{INK}" stroke-width="1""#),
    );
}

/// The torque that keeps the rotor in its rhythm.
fn draw_torque(picture: &mut Picture, film: &[Moment]) {
    let largest = film.iter().map(|moment| moment.torques.rotor.abs()).fold(0.0, f64::max);
    let corner = Page { x: 76.0, y: 654.0 };
    let up = [-1.1 * largest, 1.1 * largest];
    let mut chart = Chart::new(corner, [848.0, 90.0], [0.0, 24.0], up);
    let torque = film.iter().map(|moment| (moment.t, moment.torques.rotor));
    chart.line("", ORANGE, torque);
    chart.draw(picture, "Driving: the torque on the rotor, the multiplier of its constraint (N m)", "s");
}

//! When does a rolling wheel slip? The multipliers of the rolling constraints are the forces of the
//! floor, and the floor can give only μ N.
//!
//! `cargo run --release --example friction_cone`
//!
//! An upright disk is driven in pulses while it is steered left and right. The faster
//! it rolls, the more its turns ask of the floor. The simulation rolls without slipping; it is valid
//! up to the instant at which the force of the floor leaves the friction cone, which is found in the
//! dense output of the integrator.

use std::error::Error;

use nh_examples::{Chart, Colours, INK, MUTED, ORANGE, Page, Picture, View};
use nonholonomic::prelude::*;

/// An upright disk that rolls on a floor.
#[nonholonomic(
    base {
        /// Point of contact.
        x,
        /// Point of contact.
        y,
        /// Angle of rolling.
        theta,
        /// Heading.
        phi,
    }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) + I / 2 * der(theta)^2 + J / 2 * der(phi)^2 }
    constraints {
        floor_x: der(x) = R * cos(phi) * der(theta);
        floor_y: der(y) = R * sin(phi) * der(theta);
    }
    forces { theta: drive * (1 + pulse * sin(2 * swing * t)); phi: J * turn * swing * cos(swing * t); }
    emit { multipliers }
    assume { m > 0; I > 0; J > 0; R > 0; }
    units {
        x, y, R = m;
        theta, phi = rad;
        m = kg;
        I, J = kg m^2;
        drive = N m;
        pulse = 1;
        turn, swing = rad/s;
    }
)]
#[derive(Clone, Copy, Debug)]
pub struct Disk {
    /// Mass (kg).
    pub m: f64,
    /// Moment of inertia about the axle (kg m²).
    pub I: f64,
    /// Moment of inertia about the vertical (kg m²).
    pub J: f64,
    /// Radius (m).
    pub R: f64,
    /// Mean torque on the axle (N m).
    pub drive: f64,
    /// How much the torque varies, as a share of its mean.
    pub pulse: f64,
    /// Largest turning rate (rad/s).
    pub turn: f64,
    /// Angular frequency of steering (rad/s).
    pub swing: f64,
}

const DISK: Disk =
    Disk { m: 2.0, I: 0.0625, J: 0.03, R: 0.25, drive: 0.2, pulse: 3.0, turn: 1.3, swing: 1.6 };
const GRAVITY: f64 = 9.81;
/// How long the disk is watched (s).
const END: f64 = 11.0;
/// Floors and their coefficients of friction.
const FLOORS: [(&str, f64); 4] = [("ice", 0.1), ("wet wood", 0.25), ("dry wood", 0.4), ("rubber mat", 0.6)];

/// What the disk asks of the floor, in units of its weight.
#[derive(Clone, Copy, Debug)]
struct Demand {
    /// Forwards.
    along: f64,
    /// To the left.
    across: f64,
}

impl Demand {
    /// The multipliers are forces along the axes of the floor.
    fn of(disk: &Disk, t: f64, state: &DiskState) -> Self {
        let force = disk.multipliers(t, state, &());
        let (sin, cos) = state.phi.sin_cos();
        let weight = disk.m * GRAVITY;
        Self {
            along: (force.floor_x * cos + force.floor_y * sin) / weight,
            across: (force.floor_y * cos - force.floor_x * sin) / weight,
        }
    }

    /// The least coefficient of friction that provides it.
    fn friction(self) -> f64 {
        self.along.hypot(self.across)
    }
}

/// An instant of the motion.
#[derive(Clone, Copy, Debug)]
struct Moment {
    t: f64,
    state: DiskState,
    demand: Demand,
}

/// The motion, and the instants at which each floor gives way, if it does.
struct Ride {
    track: Vec<Moment>,
    slips: Vec<Option<Moment>>,
}

fn ride(disk: Disk) -> Result<Ride, IntegrationError> {
    let start = DiskState { theta_dot: 4.0, phi: -disk.turn / disk.swing, ..DiskState::default() };
    let mut sim = Integrator::new(disk, Dopri5::new().rtol(1e-11).atol(1e-12), 0.0, start);
    let moment = |t: f64, state: DiskState| Moment { t, state, demand: Demand::of(&disk, t, &state) };
    let mut track = vec![moment(0.0, start)];
    let mut slips = vec![None; FLOORS.len()];
    while sim.time() < END {
        let before = sim.time();
        sim.step_towards(END)?;
        let now = moment(sim.time(), *sim.state());
        for (slip, (_, grip)) in slips.iter_mut().zip(FLOORS) {
            if slip.is_none() && now.demand.friction() > grip {
                // bisection in the step that crossed the cone
                let (mut held, mut lost) = (before, now.t);
                while lost - held > 1e-9 {
                    let middle = f64::midpoint(held, lost);
                    let there = moment(middle, sim.at(middle)?);
                    if there.demand.friction() > grip { lost = middle } else { held = middle }
                }
                *slip = Some(moment(lost, sim.at(lost)?));
            }
        }
        track.push(now);
    }
    Ok(Ride { track, slips })
}

fn main() -> Result<(), Box<dyn Error>> {
    println!("torque  floor       mu    slips at    speed   forwards  sideways");
    println!(" (N m)                        (s)     (m/s)      (share of m g)");
    for drive in [0.1, 0.2, 0.5] {
        let disk = Disk { drive, ..DISK };
        for ((name, grip), slip) in FLOORS.iter().zip(ride(disk)?.slips) {
            print!("{drive:6.1}  {name:10} {grip:4.2}");
            match slip {
                Some(Moment { t, state, demand }) => println!(
                    "  {t:9.4} {:8.3}   {:8.4}  {:8.4}",
                    disk.R * state.theta_dot,
                    demand.along,
                    demand.across
                ),
                None => println!("    holds for {END} s"),
            }
        }
    }
    draw(&ride(DISK)?).save("friction_cone")?;
    Ok(())
}

fn draw(ride: &Ride) -> Picture {
    let mut picture = Picture::new(
        960.0,
        800.0,
        "Slip of a steered wheel",
        "The force of the floor on a rolling disk that is driven and steered; it slips where the floor cannot give that force.",
    );
    let track = &ride.track;
    let points = track.iter().map(|moment| (moment.state.x, moment.state.y));
    let view = View::showing(points, 1.5, Page { x: 36.0, y: 90.0 }, 888.0, 250.0);
    view.grid(&mut picture, 2.0, "m");
    let place = |moment: &Moment| view.at((moment.state.x, moment.state.y));
    let coloured: Vec<(Page, f64)> =
        track.iter().map(|moment| (place(moment), moment.demand.friction())).collect();
    let colours = Colours::covering(coloured.iter().map(|(_, friction)| *friction));
    colours.draw(&mut picture, &coloured, r#"stroke-width="3""#);
    colours.key(&mut picture, Page { x: 764.0, y: 366.0 }, 150.0, "friction that is needed", "");
    for ((name, _), slip) in FLOORS.iter().zip(&ride.slips) {
        let Some(slip) = slip else { continue };
        let at = place(slip);
        mark(&mut picture, at);
        // outside of the turn
        let outside = Page { y: if slip.demand.across > 0.0 { at.y + 20.0 } else { at.y - 11.0 }, ..at };
        picture.text(outside, name, &format!(r#"font-size="12" fill="{INK}" text-anchor="middle""#));
    }
    draw_cone(&mut picture, ride);
    draw_history(&mut picture, ride);
    picture
}

fn mark(picture: &mut Picture, at: Page) {
    picture.circle(at, 4.5, &format!(r##"fill="#ffffff" stroke="{INK}" stroke-width="1.6""##));
}

/// The force in the frame of the disk, and the friction cones cut at its height.
fn draw_cone(picture: &mut Picture, ride: &Ride) {
    const REACH: f64 = 0.75;
    let corner = Page { x: 76.0, y: 434.0 };
    let range = [-REACH, REACH];
    let mut chart = Chart::new(corner, [310.0, 310.0], range, range);
    let forces = ride.track.iter().map(|moment| (-moment.demand.across, moment.demand.along));
    chart.line("", ORANGE, forces);
    chart.draw(picture, "Force of the floor: to the right, forwards (share of m g)", "");
    for (name, grip) in FLOORS {
        let pixels = chart.at(grip, 0.0).x - chart.at(0.0, 0.0).x;
        let ring = format!(r#"fill="none" stroke="{MUTED}" stroke-width="1" stroke-dasharray="4 4""#);
        picture.circle(chart.at(0.0, 0.0), pixels, &ring);
        let label = chart.at(0.0, -grip);
        let style = format!(r#"font-size="11" fill="{MUTED}" text-anchor="middle""#);
        picture.text(Page { y: label.y + 12.0, ..label }, name, &style);
    }
    for slip in ride.slips.iter().flatten() {
        mark(picture, chart.at(-slip.demand.across, slip.demand.along));
    }
}

/// The friction that is needed, over time.
fn draw_history(picture: &mut Picture, ride: &Ride) {
    let corner = Page { x: 500.0, y: 434.0 };
    let mut chart = Chart::new(corner, [404.0, 310.0], [0.0, END], [0.0, 0.75]);
    let needed = ride.track.iter().map(|moment| (moment.t, moment.demand.friction()));
    chart.line("", INK, needed);
    chart.draw(picture, "Coefficient of friction that is needed", "s");
    for (name, grip) in FLOORS {
        let ends = [0.0, END].map(|t| chart.at(t, grip));
        picture.line(&ends, &format!(r#"stroke="{MUTED}" stroke-width="1" stroke-dasharray="4 4""#));
        let above = Page { x: ends[0].x + 34.0, y: ends[0].y - 5.0 };
        picture.text(above, name, &format!(r#"font-size="11" fill="{MUTED}""#));
    }
    for slip in ride.slips.iter().flatten() {
        mark(picture, chart.at(slip.t, slip.demand.friction()));
    }
    let note = format!(
        "m = {} kg, R = {} m, mean torque {} N m; circles: the floor gives way.",
        DISK.m, DISK.R, DISK.drive
    );
    let style = format!(r#"font-size="12" fill="{MUTED}" text-anchor="end""#);
    picture.text(Page { x: 924.0, y: 784.0 }, &note, &style);
}

//! The Chaplygin sleigh: a rigid body that slides on a plane, carried by a knife edge and two
//! smooth points. The edge moves along itself and never sideways.
//!
//! `cargo run --release --example chaplygin_sleigh`
//!
//! The sleigh is pushed backwards with a little spin. That motion is unstable: it turns over,
//! through a cusp of its track, and ends up sliding forwards, the centre of mass ahead. No force
//! acts and the energy stays what it is, and yet the motion settles: this is what nonholonomic
//! constraints do, and no Hamiltonian system does.

use std::error::Error;

use nh_examples::{BACKGROUND, Chart, Colours, INK, MUTED, ORANGE, PALE, Page, Picture, Pose, View};
use nonholonomic::prelude::*;

/// A rigid body on a plane, carried by a knife edge.
#[nonholonomic(
    base {
        /// Heading of the edge.
        theta,
        /// Contact point.
        x,
        /// Contact point.
        y,
    }
    basis {
        /// Angular velocity.
        omega,
        /// Velocity of the contact point along the edge.
        v1,
        /// Velocity of the contact point across the edge.
        v2,
    }
    anchor {
        der(theta) = omega;
        der(x) = v1 * cos(theta) - v2 * sin(theta);
        der(y) = v1 * sin(theta) + v2 * cos(theta);
    }
    lagrangian { J / 2 * omega^2 + m / 2 * ((v1 - b * omega)^2 + (v2 + a * omega)^2) }
    constraints { edge: v2 = 0; }
    outputs { turning = (J + m * (a^2 + b^2)) / 2 * omega^2; speed = sqrt(v1^2 + v2^2); }
    units { x, y, a, b = m; theta = rad; m = kg; J = kg m^2; turning = J; speed = m/s; edge = N; }
)]
#[derive(Clone, Copy, Debug)]
pub struct Sleigh {
    /// Mass (kg).
    pub m: f64,
    /// Moment of inertia about the centre of mass (kg m²).
    pub J: f64,
    /// Centre of mass ahead of the contact point (m).
    pub a: f64,
    /// Centre of mass to the left of the contact point (m).
    pub b: f64,
}

/// How long the sleigh is watched (s).
const END: f64 = 24.0;
/// Instants at which the track is drawn.
const SAMPLES: u32 = 1200;

fn main() -> Result<(), Box<dyn Error>> {
    let sleigh = Sleigh { m: 1.0, J: 0.9, a: 0.2, b: 0.0 };
    let start = SleighState { theta: -0.4, x: 0.0, y: 0.0, omega: 0.15, v1: -1.0 };
    let mut sim = Integrator::new(sleigh, Dopri5::new().rtol(1e-12).atol(1e-14), 0.0, start);
    let initial = sleigh.energy(0.0, &start);

    println!("     t         x         y     theta     omega        v1      energy     drift");
    let mut track = vec![(0.0, start)];
    for sample in 0..=SAMPLES {
        let t = END * f64::from(sample) / f64::from(SAMPLES);
        sim.advance_to(t)?;
        let s = *sim.state();
        track.push((t, s));
        if sample % 100 == 0 {
            let energy = sleigh.energy(t, &s);
            let drift = energy / initial - 1.0;
            println!(
                "{t:6.1} {:9.4} {:9.4} {:9.4} {:9.4} {:9.4} {energy:11.8} {drift:9.1e}",
                s.x, s.y, s.theta, s.omega, s.v1
            );
        }
    }
    let cost = sim.statistics();
    println!("\n{} steps, {} evaluations of the derivative", cost.steps, cost.evaluations);
    draw(&sleigh, &track).save("chaplygin_sleigh")?;
    Ok(())
}

fn draw(sleigh: &Sleigh, track: &[(f64, SleighState)]) -> Picture {
    let mut picture = Picture::new(
        960.0,
        800.0,
        "Chaplygin sleigh",
        "Pushed backwards, it turns over and slides on forwards. No force acts, the energy is constant, and yet the motion settles.",
    );
    let points = track.iter().map(|(_, s)| (s.x, s.y));
    let view = View::showing(points, 0.6, Page { x: 36.0, y: 96.0 }, 888.0, 500.0);
    view.grid(&mut picture, 1.0, "m");
    let speed = |t: f64, s: &SleighState| sleigh.outputs(t, s, &()).speed;
    let coloured: Vec<(Page, f64)> = track.iter().map(|(t, s)| (view.at((s.x, s.y)), speed(*t, s))).collect();
    let colours = Colours::covering(coloured.iter().map(|(_, speed)| *speed));
    colours.draw(&mut picture, &coloured, r#"stroke-width="2.6""#);
    for (_, state) in track.iter().skip(1).step_by(50) {
        draw_sleigh(&mut picture, &view, sleigh, state);
    }
    for (t, state) in [track[0], track[track.len() - 1]] {
        let pose = Pose { x: state.x, y: state.y, heading: state.theta };
        let style = format!(r#"font-size="12" fill="{INK}" text-anchor="middle""#);
        picture.text(view.at(pose.point(0.1, 0.4)), &format!("t = {t} s"), &style);
    }
    // the sleigh itself, along its track
    let hull = HULL.map(|(ahead, left)| Page { x: view.length(ahead), y: -view.length(left) });
    let poses: Vec<(Page, f64)> = track[1..]
        .iter()
        .step_by(5)
        .map(|(_, state)| (view.at((state.x, state.y)), -state.theta.to_degrees()))
        .collect();
    picture.moving(&hull, &poses, END, &format!(r##"fill="#e8623e" stroke="{INK}" stroke-width="1.4""##));
    colours.key(&mut picture, Page { x: 764.0, y: 560.0 }, 150.0, "speed of the contact point", "m/s");
    draw_energy(&mut picture, sleigh, track);
    picture
}

/// The body, ahead and to the left of the contact.
const HULL: [(f64, f64); 8] = [
    (-0.15, 0.0),
    (-0.12, 0.06),
    (0.30, 0.21),
    (0.38, 0.18),
    (0.41, 0.0),
    (0.38, -0.18),
    (0.30, -0.21),
    (-0.12, -0.06),
];

/// The body as a rounded triangle: the edge behind, two smooth points in front, the centre of mass.
fn draw_sleigh(picture: &mut Picture, view: &View, sleigh: &Sleigh, state: &SleighState) {
    let pose = Pose { x: state.x, y: state.y, heading: state.theta };
    let hull = view.body(pose, &HULL);
    picture.polygon(
        &hull,
        &format!(
            r##"fill="#c9d3e2" fill-opacity="0.35" stroke="{INK}" stroke-opacity="0.55" stroke-width="1""##
        ),
    );
    for left in [0.15, -0.15] {
        picture.circle(view.at(pose.point(0.31, left)), 1.5, &format!(r#"fill="{MUTED}""#));
    }
    let edge = view.body(pose, &[(-0.12, 0.0), (0.12, 0.0)]);
    picture.line(&edge, &format!(r#"stroke="{INK}" stroke-width="2.2""#));
    let mass = view.at(pose.point(sleigh.a, sleigh.b));
    picture.circle(mass, 2.6, &format!(r#"fill="{BACKGROUND}" stroke="{INK}" stroke-width="1.2""#));
}

/// The energy, and how it goes from sliding to turning and back.
fn draw_energy(picture: &mut Picture, sleigh: &Sleigh, track: &[(f64, SleighState)]) {
    let total = sleigh.energy(0.0, &track[0].1);
    let corner = Page { x: 76.0, y: 654.0 };
    let mut chart = Chart::new(corner, [848.0, 90.0], [0.0, END], [0.0, total * 1.08]);
    let turning = |t: f64, s: &SleighState| sleigh.outputs(t, s, &()).turning;
    let shares: Vec<(f64, f64, f64)> =
        track.iter().map(|(t, s)| (*t, turning(*t, s), sleigh.energy(*t, s))).collect();
    chart.band("turning", ORANGE, shares.iter().map(|(t, part, _)| (*t, 0.0, *part)));
    chart.band("sliding", PALE, shares.iter().map(|(t, part, all)| (*t, *part, *all)));
    chart.line("all", INK, shares.iter().map(|(t, _, all)| (*t, *all)));
    chart.draw(picture, "Energy (J)", "s");
    let note = format!(
        "m = {} kg, J = {} kg m², a = {} m; drawn every second: stroke the edge, circle the centre of mass",
        sleigh.m, sleigh.J, sleigh.a
    );
    picture.text(
        Page { x: 924.0, y: 788.0 },
        &note,
        &format!(r#"font-size="12" fill="{MUTED}" text-anchor="end""#),
    );
}

//! The Veselova system: a rigid body about a fixed point whose angular velocity stays orthogonal to
//! a direction that is fixed in space.
//!
//! `cargo run --release --example veselova`
//!
//! Seen from the body, the fixed direction γ runs on the unit sphere. The velocities allowed at γ
//! form the plane γ⊥, and these planes have no frame on the whole sphere: the state keeps all three
//! angular velocities and the constraint acts through its multiplier. A numerical solution drifts off
//! |γ| = 1 and off ⟨γ, ω⟩ = 0, by as little as the table says; `Projected` takes it back.

use std::error::Error;
use std::f64::consts::{PI, TAU};

use nh_examples::{Chart, Colours, FAINT, INK, MUTED, ORANGE, PALE, Page, Picture};
use nonholonomic::prelude::*;

/// A rigid body in a linear potential, its angular velocity `w` orthogonal to `g`.
#[nonholonomic(
    base {
        /// The fixed direction, seen from the body.
        g[3],
    }
    on { unit: dot(g, g) = 1; }
    basis {
        /// Angular velocity, seen from the body.
        w[3],
    }
    anchor {
        der(g[0]) = g[1] * w[2] - g[2] * w[1];
        der(g[1]) = g[2] * w[0] - g[0] * w[2];
        der(g[2]) = g[0] * w[1] - g[1] * w[0];
    }
    brackets so(3) { w }
    lagrangian  { sum(i in 0..3: I[i] * w[i]^2) / 2 - dot(c, g) }
    constraints { veselova: dot(g, w) = 0; }
    assume      { I > 0; }
 units       { g = 1; I = kg m^2; c = J; }
)]
#[derive(Clone, Copy, Debug)]
pub struct Veselova {
    /// Principal moments of inertia (kg m²).
    pub I: [f64; 3],
    /// The potential is ⟨c, g⟩ (J).
    pub c: [f64; 3],
}

/// How long the body is watched (s).
const END: f64 = 60.0;
/// Instants at which the trace is drawn.
const SAMPLES: u32 = 3000;

fn main() -> Result<(), Box<dyn Error>> {
    let body = Veselova { I: [1.0, 1.6, 2.3], c: [0.25, 0.0, 0.6] };
    let start = VeselovaState { g: [0.6, 0.0, -0.8], w: [0.8, 0.9, 0.6] };
    let method = Projected::new(Dopri5::new().rtol(1e-11).atol(1e-13), 20);
    let mut sim = Integrator::new(body, method, 0.0, start);
    let initial = body.energy(0.0, &start);
    println!("     t        g1        g2        g3      energy     drift    |g| - 1     <g, w>");
    let mut trace = Vec::new();
    for sample in 0..=SAMPLES {
        let t = END * f64::from(sample) / f64::from(SAMPLES);
        sim.advance_to(t)?;
        let state = *sim.state();
        trace.push((t, state));
        if sample % 300 == 0 {
            let [g1, g2, g3] = state.g;
            let energy = body.energy(t, &state);
            let length = dot(state.g, state.g).sqrt();
            println!(
                "{t:6.1} {g1:9.4} {g2:9.4} {g3:9.4} {energy:11.8} {:9.1e} {:10.1e} {:10.1e}",
                energy / initial - 1.0,
                length - 1.0,
                dot(state.g, state.w)
            );
        }
    }
    draw(&body, &trace).save("veselova")?;
    Ok(())
}

fn dot(u: [f64; 3], v: [f64; 3]) -> f64 {
    u[0] * v[0] + u[1] * v[1] + u[2] * v[2]
}

/// A sphere looked at from far away.
struct Sphere {
    centre: Page,
    radius: f64,
    /// To the right, upwards, and towards the eye.
    axes: [[f64; 3]; 3],
}

impl Sphere {
    /// The page point of a point of the sphere, and whether it is on the near side.
    fn at(&self, point: [f64; 3]) -> (Page, bool) {
        let [right, up, near] = self.axes.map(|axis| dot(axis, point));
        (Page { x: self.centre.x + self.radius * right, y: self.centre.y - self.radius * up }, near > 0.0)
    }

    /// Draws circles of latitude and of longitude, the far side faintly.
    fn draw(&self, picture: &mut Picture) {
        picture.circle(
            self.centre,
            self.radius,
            &format!(r##"fill="#f3f1ec" stroke="{MUTED}" stroke-width="1""##),
        );
        for index in 1..6 {
            let latitude = PI * (f64::from(index) / 6.0 - 0.5);
            self.curve(picture, |angle| {
                [latitude.cos() * angle.cos(), latitude.cos() * angle.sin(), latitude.sin()]
            });
        }
        for index in 0..6 {
            let longitude = PI * f64::from(index) / 6.0;
            self.curve(picture, |angle| {
                [angle.cos() * longitude.cos(), angle.cos() * longitude.sin(), angle.sin()]
            });
        }
    }

    fn curve(&self, picture: &mut Picture, point: impl Fn(f64) -> [f64; 3]) {
        let points: Vec<(Page, bool)> =
            (0..=120).map(|index| self.at(point(TAU * f64::from(index) / 120.0))).collect();
        for side in points.chunk_by(|a, b| a.1 == b.1) {
            let line: Vec<Page> = side.iter().map(|(page, _)| *page).collect();
            let style = if side[0].1 { r##"stroke="#cfccc4""## } else { &format!(r#"stroke="{FAINT}""#) };
            picture.line(&line, &format!(r#"{style} stroke-width="1""#));
        }
    }
}

fn draw(body: &Veselova, trace: &[(f64, VeselovaState)]) -> Picture {
    let mut picture = Picture::new(
        960.0,
        800.0,
        "Veselova system",
        "The fixed direction on the unit sphere, as the body sees it; its angular velocity stays orthogonal to it.",
    );
    let (turn, tilt) = (-0.5_f64, 0.35_f64);
    let axes = [
        [-turn.sin(), turn.cos(), 0.0],
        [-tilt.sin() * turn.cos(), -tilt.sin() * turn.sin(), tilt.cos()],
        [tilt.cos() * turn.cos(), tilt.cos() * turn.sin(), tilt.sin()],
    ];
    let sphere = Sphere { centre: Page { x: 480.0, y: 348.0 }, radius: 252.0, axes };
    sphere.draw(&mut picture);
    let colours = Colours { low: 0.0, high: END };
    let points: Vec<(Page, f64, bool)> = trace
        .iter()
        .map(|(t, state)| {
            let (page, near) = sphere.at(state.g);
            (page, *t, near)
        })
        .collect();
    for (side, style) in
        [(false, r#"stroke-width="1.4" stroke-opacity="0.25""#), (true, r#"stroke-width="2.2""#)]
    {
        for piece in points.chunk_by(|a, b| a.2 == b.2).filter(|piece| piece[0].2 == side) {
            let line: Vec<(Page, f64)> = piece.iter().map(|(page, t, _)| (*page, *t)).collect();
            colours.draw(&mut picture, &line, style);
        }
    }
    picture.circle(points[0].0, 4.5, &format!(r#"fill="{INK}""#));
    colours.key(&mut picture, Page { x: 764.0, y: 560.0 }, 150.0, "time (far side faint)", "s");
    draw_energy(&mut picture, body, trace);
    let note =
        format!("I = diag {:?} kg m², potential <c, g> with c = {:?} J; dot: the start", body.I, body.c);
    picture.text(
        Page { x: 924.0, y: 788.0 },
        &note,
        &format!(r#"font-size="12" fill="{MUTED}" text-anchor="end""#),
    );
    picture
}

/// Kinetic and potential energy, and their sum.
fn draw_energy(picture: &mut Picture, body: &Veselova, trace: &[(f64, VeselovaState)]) {
    let total = body.energy(0.0, &trace[0].1);
    let potential = |state: &VeselovaState| dot(body.c, state.g);
    let lowest = trace.iter().map(|(_, state)| potential(state)).fold(0.0, f64::min);
    let corner = Page { x: 76.0, y: 654.0 };
    let up = [lowest * 1.1, total.max(0.0) * 1.1];
    let mut chart = Chart::new(corner, [848.0, 90.0], [0.0, END], up);
    let between = trace.iter().map(|(t, state)| (*t, potential(state), body.energy(*t, state)));
    chart.band("kinetic", PALE, between);
    chart.line("potential", ORANGE, trace.iter().map(|(t, state)| (*t, potential(state))));
    chart.line("all", INK, trace.iter().map(|(t, state)| (*t, body.energy(*t, state))));
    chart.draw(picture, "Energy (J)", "s");
}

//! When does a body leave the ground? The multiplier of the contact is the normal reaction, and where
//! it falls to zero the contact ends.
//!
//! `cargo run --release --example lift_off`
//!
//! A skier slides down a slope with moguls, and takes off where the ground would have to pull. In the
//! air there is no constraint, until the height above the ground falls to zero; the landing takes the
//! velocity across the ground. Both are events, located by the integrator: one system hands over to
//! another at each.

use std::error::Error;

use nh_examples::{Chart, Colours, INK, MUTED, ORANGE, Page, Picture, View};
use nonholonomic::prelude::*;

/// A skier who stays on the ground y = bump sin(k x) − slope x.
#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - m * g * y }
    constraints { ground: der(y) = (bump * k * cos(k * x) - slope) * der(x); }
    emit { multipliers }
    assume { m > 0; }
    units { x, y, bump = m; m = kg; g = m/s^2; k = m^-1; slope = 1; ground = N; }
)]
#[derive(Clone, Copy, Debug)]
pub struct Sliding {
    /// Mass (kg).
    pub m: f64,
    /// Gravity (m/s²).
    pub g: f64,
    /// Height of the moguls (m).
    pub bump: f64,
    /// Their wave number (1/m).
    pub k: f64,
    /// Mean slope.
    pub slope: f64,
}

/// The same skier in the air.
#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - m * g * y }
    assume { m > 0; }
    units { x, y = m; m = kg; g = m/s^2; }
)]
#[derive(Clone, Copy, Debug)]
pub struct Flying {
    /// Mass (kg).
    pub m: f64,
    /// Gravity (m/s²).
    pub g: f64,
}

const SKIER: Sliding = Sliding { m: 75.0, g: 9.81, bump: 0.8, k: 0.5, slope: 0.3 };
/// Where the slope ends (m).
const END: f64 = 75.0;

impl Sliding {
    /// Height of the ground.
    fn ground(&self, x: f64) -> f64 {
        self.bump * (self.k * x).sin() - self.slope * x
    }

    /// Its slope.
    fn incline(&self, x: f64) -> f64 {
        self.bump * self.k * (self.k * x).cos() - self.slope
    }

    /// The reaction of the ground across it, in units of the weight.
    fn reaction(&self, t: f64, state: &SlidingState) -> f64 {
        // the multiplier is its vertical part
        let vertical = self.multipliers(t, state, &()).ground;
        vertical * self.incline(state.x).hypot(1.0) / (self.m * self.g)
    }
}

/// An instant of the descent.
#[derive(Clone, Copy, Debug)]
struct Moment {
    t: f64,
    at: (f64, f64),
    speed: f64,
    /// None in the air.
    reaction: Option<f64>,
}

/// The descent, and where it leaves and meets the ground.
#[derive(Default)]
struct Descent {
    track: Vec<Moment>,
    takeoffs: Vec<Moment>,
    landings: Vec<Moment>,
}

fn descend(skier: Sliding) -> Result<Descent, IntegrationError> {
    let mut descent = Descent::default();
    let mut t = 0.0;
    let mut state = SlidingState { x: 0.0, y: skier.ground(0.0), x_dot: 4.0 };
    let method = Dop853::new().rtol(1e-11).max_step(0.02);
    loop {
        // on the ground
        let mut slide = Integrator::new(skier, method, t, state);
        let moment = |t: f64, s: &SlidingState| Moment {
            t,
            at: (s.x, s.y),
            speed: s.x_dot * skier.incline(s.x).hypot(1.0),
            reaction: Some(skier.reaction(t, s)),
        };
        let events = Events::new(|t, s: &SlidingState, (): &()| [skier.reaction(t, s), END - s.x])
            .directions([Direction::Falling; 2]);
        let takeoff = loop {
            descent.track.push(moment(slide.time(), slide.state()));
            if let Some(event) = slide.advance_until(slide.time() + 0.02, &events)? {
                break event;
            }
        };
        let left = moment(takeoff.time, &takeoff.state);
        descent.track.push(left);
        if takeoff.index == 1 {
            return Ok(descent);
        }
        descent.takeoffs.push(left);
        // in the air
        let SlidingState { x, y, x_dot } = takeoff.state;
        let start = FlyingState { x, y, x_dot, y_dot: skier.incline(x) * x_dot };
        let mut flight = Integrator::new(Flying { m: skier.m, g: skier.g }, method, takeoff.time, start);
        let moment = |t: f64, s: &FlyingState| Moment {
            t,
            at: (s.x, s.y),
            speed: s.x_dot.hypot(s.y_dot),
            reaction: None,
        };
        let events = Events::new(|_, s: &FlyingState, (): &()| [s.y - skier.ground(s.x)])
            .directions([Direction::Closing]);
        let landing = loop {
            if let Some(event) = flight.advance_until(flight.time() + 0.02, &events)? {
                break event;
            }
            descent.track.push(moment(flight.time(), flight.state()));
        };
        descent.landings.push(moment(landing.time, &landing.state));
        descent.track.push(moment(landing.time, &landing.state));
        // what is left of the velocity is its part along the ground
        let FlyingState { x, x_dot, y_dot, .. } = landing.state;
        let incline = skier.incline(x);
        let along = (x_dot + incline * y_dot) / (1.0 + incline * incline);
        (t, state) = (landing.time, SlidingState { x, y: skier.ground(x), x_dot: along });
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let descent = descend(SKIER)?;
    println!("   leaves the ground              meets it");
    println!("   t (s)    x (m)  (m/s)       t (s)    x (m)  (m/s)     air (s)");
    for (up, down) in descent.takeoffs.iter().zip(&descent.landings) {
        println!(
            "{:8.4} {:8.3} {:6.2}    {:8.4} {:8.3} {:6.2}    {:8.4}",
            up.t,
            up.at.0,
            up.speed,
            down.t,
            down.at.0,
            down.speed,
            down.t - up.t
        );
    }
    let worst =
        descent.takeoffs.iter().filter_map(|moment| moment.reaction).fold(0.0, |w, r| f64::max(w, r.abs()));
    println!("\nlargest reaction at a take-off, in units of the weight: {worst:.1e}");
    draw(&descent).save("lift_off")?;
    Ok(())
}

fn draw(descent: &Descent) -> Picture {
    let mut picture = Picture::new(
        960.0,
        640.0,
        "Lift-off",
        "A skier leaves the ground where its reaction falls to zero, and lands where the height above it does.",
    );
    let track = &descent.track;
    let view =
        View::showing(track.iter().map(|moment| moment.at), 1.5, Page { x: 36.0, y: 90.0 }, 888.0, 300.0);
    view.grid(&mut picture, 5.0, "m");
    let ground: Vec<Page> =
        (0..=600).map(|i| END * f64::from(i) / 600.0).map(|x| view.at((x, SKIER.ground(x)))).collect();
    picture.line(&ground, &format!(r#"stroke="{MUTED}" stroke-width="1""#));
    let coloured: Vec<(Page, f64)> = track.iter().map(|moment| (view.at(moment.at), moment.speed)).collect();
    let colours = Colours::covering(coloured.iter().map(|(_, speed)| *speed));
    colours.draw(&mut picture, &coloured, r#"stroke-width="3""#);
    colours.key(&mut picture, Page { x: 764.0, y: 116.0 }, 150.0, "speed", "m/s");
    mark(&mut picture, descent, |moment| view.at(moment.at));
    draw_reaction(&mut picture, descent);
    picture
}

/// Open circles where the skier leaves the ground, full ones where he meets it.
fn mark(picture: &mut Picture, descent: &Descent, place: impl Fn(&Moment) -> Page) {
    for moment in &descent.takeoffs {
        picture.circle(place(moment), 4.5, &format!(r##"fill="#ffffff" stroke="{INK}" stroke-width="1.6""##));
    }
    for moment in &descent.landings {
        picture.circle(place(moment), 4.0, &format!(r#"fill="{INK}""#));
    }
}

/// The reaction over time, in units of the weight.
fn draw_reaction(picture: &mut Picture, descent: &Descent) {
    let end = descent.track.last().map_or(1.0, |moment| moment.t);
    let most = descent.track.iter().filter_map(|moment| moment.reaction).fold(1.0, f64::max);
    let corner = Page { x: 76.0, y: 450.0 };
    let mut chart = Chart::new(corner, [848.0, 130.0], [0.0, end], [0.0, most * 1.05]);
    for stretch in descent.track.split(|moment| moment.reaction.is_none()) {
        let pairs = stretch.iter().filter_map(|moment| Some((moment.t, moment.reaction?)));
        chart.line("", ORANGE, pairs);
    }
    chart.draw(picture, "Reaction of the ground (in units of the weight)", "s");
    mark(picture, descent, |moment| chart.at(moment.t, 0.0));
    let note = format!(
        "open circles: take-off, full circles: landing; moguls of {} m on a slope of {}",
        SKIER.bump, SKIER.slope
    );
    let style = format!(r#"font-size="12" fill="{MUTED}" text-anchor="end""#);
    picture.text(Page { x: 924.0, y: 626.0 }, &note, &style);
}

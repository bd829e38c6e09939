//! Modes of a wheel: it flies, touches the ground, slips, rolls, and lifts off again.
//!
//! `cargo run --release --example modes`
//!
//! Its centre of mass is off its middle, so that it hops when it turns fast. Each mode is a declaration; that rolling and
//! slipping are flying with further constraints is proved by `morphism!`, which gives the maps between their states. The
//! multipliers of a mode say when it ends: rolling where they leave the cone of friction, contact where the ground would
//! have to pull. An impact leads from flight to the ground.

use std::error::Error;
use std::fmt::{self, Display, Formatter};

use nh_examples::{Chart, INK, MUTED, Page, Picture, View};
use nonholonomic::prelude::*;

/// Above the ground, with a pull along the ground at the lowest point.
#[nonholonomic(
    base { x, y, phi }
    inputs { pull }
    lagrangian {
        m / 2 * (der(x)^2 + der(y)^2 + c^2 * der(phi)^2 + 2 * c * der(phi) * (der(x) * cos(phi) - der(y) * sin(phi)))
            + J / 2 * der(phi)^2 - m * g * (y + c * cos(phi))
    }
    forces { x: pull; phi: -R * pull; }
    impacts { touch: y >= R; grip: y >= R, der(x) = R * der(phi); }
    units { x, y, R, c = m; phi = rad; m = kg; J = kg m^2; g = m/s^2; pull = N; }
)]
#[derive(Clone, Copy, Debug)]
pub struct Flying {
    /// Mass (kg).
    pub m: f64,
    /// Moment of inertia about the centre of mass (kg m²).
    pub J: f64,
    /// Radius (m).
    pub R: f64,
    /// Distance of the centre of mass from the middle (m).
    pub c: f64,
    /// Gravity (m/s²).
    pub g: f64,
}

/// On the ground without slip.
#[nonholonomic(
    base { x, y, phi }
    lagrangian {
        m / 2 * (der(x)^2 + der(y)^2 + c^2 * der(phi)^2 + 2 * c * der(phi) * (der(x) * cos(phi) - der(y) * sin(phi)))
            + J / 2 * der(phi)^2 - m * g * (y + c * cos(phi))
    }
    constraints { contact: der(y) = 0; grip: der(x) = R * der(phi); }
    units { x, y, R, c = m; phi = rad; m = kg; J = kg m^2; g = m/s^2; }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
pub struct Rolling {
    /// Mass (kg).
    pub m: f64,
    /// Moment of inertia about the centre of mass (kg m²).
    pub J: f64,
    /// Radius (m).
    pub R: f64,
    /// Distance of the centre of mass from the middle (m).
    pub c: f64,
    /// Gravity (m/s²).
    pub g: f64,
}

morphism! { Rolling -> Flying { base { x = x; y = y; phi = phi; } inputs { pull = 0; } } }

/// On the ground, the lowest point sliding to the side of s: friction is in proportion to the load, which depends on
/// the friction, since the centre of mass is off the middle.
#[nonholonomic(
    base { x, y, phi }
    let arm = R + c * cos(phi);
    let support = g - c * der(phi)^2 * cos(phi);
    let turning = (mu * s * arm * m * support + m * g * c * sin(phi) - m * c^2 * der(phi)^2 * sin(phi) * cos(phi))
        / (J + m * c^2 * sin(phi)^2 + mu * s * arm * m * c * sin(phi));
    let normal = m * support - m * c * sin(phi) * turning;
    lagrangian {
        m / 2 * (der(x)^2 + der(y)^2 + c^2 * der(phi)^2 + 2 * c * der(phi) * (der(x) * cos(phi) - der(y) * sin(phi)))
            + J / 2 * der(phi)^2 - m * g * (y + c * cos(phi))
    }
    constraints { contact: der(y) = 0; }
    forces { x: -mu * s * normal; phi: R * mu * s * normal; }
    units { x, y, R, c = m; phi = rad; m = kg; J = kg m^2; g = m/s^2; mu, s = 1; }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
pub struct Slipping {
    /// Mass (kg).
    pub m: f64,
    /// Moment of inertia about the centre of mass (kg m²).
    pub J: f64,
    /// Radius (m).
    pub R: f64,
    /// Distance of the centre of mass from the middle (m).
    pub c: f64,
    /// Gravity (m/s²).
    pub g: f64,
    /// Coefficient of friction.
    pub mu: f64,
    /// The side to which the lowest point slides: 1 or −1.
    pub s: f64,
}

morphism! {
    Slipping -> Flying { base { x = x; y = y; phi = phi; } inputs { pull = -mu * s * normal; } }
}

/// How long it is watched (s).
const END: f64 = 4.0;
/// The time between two records (s).
const TICK: f64 = 0.005;
/// Coefficient of friction.
const MU: f64 = 0.35;
/// More changes than this are no motion but a mistake.
const MOST_CHANGES: usize = 500;

/// What holds.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Mode {
    Flying,
    Slipping(f64),
    Rolling,
}

impl Display for Mode {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Flying => "flying",
            Self::Slipping(_) => "slipping",
            Self::Rolling => "rolling",
        })
    }
}

impl Mode {
    /// Its colour in the picture.
    const fn colour(self) -> &'static str {
        match self {
            Self::Flying => "#4a7fc1",
            Self::Slipping(_) => "#e8623e",
            Self::Rolling => "#3c9a5f",
        }
    }
}

/// The wheel at an instant, as one that might fly.
type Moment = (f64, FlyingState, Mode);

/// The wheel, with what is recorded of it.
struct Wheel {
    flying: Flying,
    rolling: Rolling,
    track: Vec<Moment>,
}

impl Wheel {
    fn slipping(&self, s: f64) -> Slipping {
        let Flying { m, J, R, c, g } = self.flying;
        Slipping { m, J, R, c, g, mu: MU, s }
    }

    /// Goes on in one mode until one of some functions falls through 0, or to the end.
    fn follow<S: Dynamics<State: State<Scalar = f64>> + Copy, const N: usize>(
        &mut self,
        (system, mode): (S, Mode),
        (start, state): (f64, S::State),
        functions: impl Fn(f64, &S::State) -> [f64; N],
        include: impl Fn(f64, &S::State) -> FlyingState,
    ) -> Result<(f64, FlyingState), Box<dyn Error>> {
        let events =
            Events::new(|t, x: &S::State, _: &S::Input| functions(t, x)).directions([Direction::Closing; N]);
        let mut sim = Integrator::new(system, Dopri5::new().rtol(1e-10).atol(1e-12), start, state);
        loop {
            let next = (sim.time() + TICK).min(END);
            let event = sim.advance_until(next, &events)?;
            let whole = include(sim.time(), sim.state());
            self.track.push((sim.time(), whole, mode));
            if event.is_some() || sim.time() >= END {
                return Ok((sim.time(), whole));
            }
        }
    }

    /// What follows on the ground, where the lowest point stands: it sticks if the multipliers are in the cone of
    /// friction, and else begins to slide against what friction would have to be.
    fn on_the_ground(&self, t: f64, wheel: &FlyingState) -> Result<Mode, Box<dyn Error>> {
        let rolling = self.rolling.restrict(t, wheel)?;
        let RollingMultipliers { contact, grip } = self.rolling.multipliers(t, &rolling, &());
        Ok(if contact <= 0.0 {
            Mode::Flying
        } else if grip.abs() <= MU * contact {
            Mode::Rolling
        } else {
            Mode::Slipping(-grip.signum())
        })
    }

    /// One mode from its start to its end: the time, the state, and the next mode.
    fn go_on(&mut self, mode: Mode, t: f64, wheel: FlyingState) -> Result<Moment, Box<dyn Error>> {
        match mode {
            Mode::Flying => {
                let flying = self.flying;
                let (t, wheel) =
                    self.follow((flying, mode), (t, wheel), |t, x| [flying.event_touch(t, x)], |_, x| *x)?;
                if t >= END {
                    return Ok((t, wheel, mode));
                }
                // it sticks at once if the impulses are in the cone; else the ground stops its fall alone
                let (gripped, impulses) = flying.impact_grip(t, &wheel)?;
                let [normal, along] = impulses.grip;
                if along.abs() <= MU * normal {
                    return Ok((t, gripped, self.on_the_ground(t, &gripped)?));
                }
                let (touched, _) = flying.impact_touch(t, &wheel)?;
                let slip = touched.x_dot - flying.R * touched.phi_dot;
                Ok((t, touched, Mode::Slipping(slip.signum())))
            }
            Mode::Slipping(s) => {
                let slipping = self.slipping(s);
                let start = slipping.restrict(t, &wheel)?;
                if slipping.multipliers(t, &start, &()).contact <= 0.0 {
                    // the ground would have to pull at once: it swings up from the blow
                    return Ok((t, wheel, Mode::Flying));
                }
                let ends = |t: f64, x: &SlippingState| {
                    let slip = x.x_dot - slipping.R * x.phi_dot;
                    [s * slip, slipping.multipliers(t, x, &()).contact]
                };
                let include = |t: f64, x: &SlippingState| slipping.include(t, x);
                let (t, wheel) = self.follow((slipping, mode), (t, start), ends, include)?;
                let load = slipping.multipliers(t, &slipping.restrict(t, &wheel)?, &()).contact;
                if t >= END || load <= 0.0 {
                    return Ok((t, wheel, Mode::Flying));
                }
                // the slip is zero to the resolution of time: from here it is that
                let stuck = FlyingState { x_dot: slipping.R * wheel.phi_dot, ..wheel };
                Ok((t, stuck, self.on_the_ground(t, &stuck)?))
            }
            Mode::Rolling => {
                let rolling = self.rolling;
                let start = rolling.restrict(t, &wheel)?;
                let ends = |t: f64, x: &RollingState| {
                    let RollingMultipliers { contact, grip } = rolling.multipliers(t, x, &());
                    [MU * contact - grip.abs(), contact]
                };
                let include = |t: f64, x: &RollingState| rolling.include(t, x);
                let (t, wheel) = self.follow((rolling, mode), (t, start), ends, include)?;
                Ok((t, wheel, self.on_the_ground(t, &wheel)?))
            }
        }
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let flying = Flying { m: 1.0, J: 0.2, R: 0.5, c: 0.16, g: 9.81 };
    let Flying { m, J, R, c, g } = flying;
    let mut wheel = Wheel { flying, rolling: Rolling { m, J, R, c, g }, track: Vec::new() };
    let (mut t, mut mode) = (0.0, Mode::Flying);
    let mut state = FlyingState { x: 0.0, y: 0.8, phi: 0.3, x_dot: 1.0, y_dot: 0.0, phi_dot: 20.0 };
    let mut energy = flying.energy(0.0, &state);
    println!("     t         x         y       phi      slip    energy   mode");
    let mut changes = 0;
    let mut seen = [false; 3];
    while t < END && changes < MOST_CHANGES {
        let slip = state.x_dot - R * state.phi_dot;
        let now = flying.energy(t, &state);
        println!("{t:6.3} {:9.4} {:9.4} {:9.4} {slip:9.4} {now:9.4}   {mode}", state.x, state.y, state.phi);
        // nothing but the pull drives it, and that brakes
        if now > energy + 1e-6 {
            return Err(format!("the energy has grown from {energy} to {now}").into());
        }
        energy = now;
        seen[usize::from(mode != Mode::Flying) + usize::from(mode == Mode::Rolling)] = true;
        (t, state, mode) = wheel.go_on(mode, t, state)?;
        changes += 1;
    }
    if seen.contains(&false) || changes == MOST_CHANGES {
        return Err(format!("{changes} changes, of which some modes are no part: {seen:?}").into());
    }
    println!("\n{changes} modes one after the other; the maps between them are proved:");
    print!("{}", <Rolling as Inclusion<Flying>>::REPORT);
    draw(&flying, &wheel.track).save("modes")?;
    Ok(())
}

fn draw(flying: &Flying, track: &[Moment]) -> Picture {
    let title = "A wheel flies, slips and rolls";
    let subtitle =
        "Its centre of mass (dot) is off the middle: turning fast it hops. The path of the middle, by mode.";
    let mut picture = Picture::new(960.0, 560.0, title, subtitle);
    let points = track.iter().flat_map(|(_, s, _)| [(s.x - 0.5, 0.0), (s.x + 0.5, s.y + 0.6)]);
    let view = View::showing(points, 0.1, Page { x: 36.0, y: 90.0 }, 888.0, 220.0);
    let ground = [(track[0].1.x - 0.6, 0.0), (track[track.len() - 1].1.x + 0.6, 0.0)];
    picture.line(&ground.map(|at| view.at(at)), &format!(r#"stroke="{INK}" stroke-width="1.2""#));
    for (_, state, mode) in track.iter().step_by(24) {
        let style = format!(r#"fill="none" stroke="{}" stroke-opacity="0.45""#, mode.colour());
        picture.circle(view.at((state.x, state.y)), view.length(flying.R), &style);
        let (sin, cos) = state.phi.sin_cos();
        let mass = view.at((state.x + flying.c * sin, state.y + flying.c * cos));
        picture.circle(mass, 2.0, &format!(r#"fill="{}""#, mode.colour()));
    }
    for pair in track.windows(2) {
        let style = format!(r#"stroke="{}" stroke-width="2.6""#, pair[1].2.colour());
        picture.line(&[0, 1].map(|k: usize| view.at((pair[k].1.x, pair[k].1.y))), &style);
    }
    let energies: Vec<(f64, f64, Mode)> =
        track.iter().map(|(t, state, mode)| (*t, flying.energy(*t, state), *mode)).collect();
    let most = energies[0].1 * 1.05;
    let corner = Page { x: 76.0, y: 380.0 };
    let mut chart = Chart::new(corner, [848.0, 120.0], [0.0, END], [0.0, most]);
    for pair in energies.windows(2) {
        chart.line("", pair[1].2.colour(), pair.iter().map(|(t, energy, _)| (*t, *energy)));
    }
    chart.draw(&mut picture, "Energy: it falls at impacts and while the wheel slips (J)", "s");
    for (index, mode) in [Mode::Flying, Mode::Slipping(1.0), Mode::Rolling].into_iter().enumerate() {
        let across = 690.0 + 85.0 * f64::from(u32::try_from(index).unwrap_or(0));
        picture.circle(Page { x: across, y: 348.0 }, 5.0, &format!(r#"fill="{}""#, mode.colour()));
        let style = format!(r#"font-size="12" fill="{MUTED}""#);
        picture.text(Page { x: across + 10.0, y: 352.0 }, &mode.to_string(), &style);
    }
    picture
}

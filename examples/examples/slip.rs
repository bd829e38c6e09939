//! When do the wheels slip? The multipliers of the constraints know.
//!
//! `cargo run --release --example slip`
//!
//! A multiplier is the force that a constraint needs. A robot that rolls by assumption drives along a
//! circle, faster and faster; as soon as the force that one of its contacts needs exceeds what
//! friction can give, the assumption is broken, and `multipliers` says so at once, from the state and
//! the torques alone. To see that this is right, the same drive is simulated by a model that has no
//! constraints but friction: it leaves the circle a moment later, when neither wheel has a reserve.

use std::error::Error;

use nh_examples::{BLUE, Chart, INK, MUTED, ORANGE, Page, Picture, View};
use nonholonomic::prelude::*;

/// The robot that rolls without slipping, by two constraints on each wheel.
#[nonholonomic(
    base { x, y, theta }
    basis { v, side, omega, spin_right, spin_left }
    anchor {
        der(x) = v * cos(theta) - side * sin(theta);
        der(y) = v * sin(theta) + side * cos(theta);
        der(theta) = omega;
    }
    brackets se(2) { omega, v, side }
    lagrangian {
        m / 2 * (v^2 + (side + l * omega)^2) + J / 2 * omega^2 + Jw / 2 * (spin_right^2 + spin_left^2)
    }
    constraints {
        across: side = 0;
        right: v + c * omega = r * spin_right;
        left: v - c * omega = r * spin_left;
    }
    independent { v, omega }
    forces { spin_right: torque_right; spin_left: torque_left; }
    inputs { torque_right, torque_left }
    assume { m > 0; J > 0; Jw > 0; r > 0; c > 0; }
    units {
        x, y, l, c, r = m;
        theta = rad;
        spin_right, spin_left = rad/s;
        m = kg;
        J, Jw = kg m^2;
        torque_left, torque_right = N m;
    }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct Rolling {
    m: f64,
    J: f64,
    Jw: f64,
    l: f64,
    c: f64,
    r: f64,
}

/// The robot on wheels that may slip: friction of at most `grip` at each contact, against the
/// direction of slipping, and a little softened where that is slow.
#[nonholonomic(
    base { x, y, theta }
    basis { v, side, omega, spin_right, spin_left }
    anchor {
        der(x) = v * cos(theta) - side * sin(theta);
        der(y) = v * sin(theta) + side * cos(theta);
        der(theta) = omega;
    }
    brackets se(2) { omega, v, side }
    lagrangian {
        m / 2 * (v^2 + (side + l * omega)^2) + J / 2 * omega^2 + Jw / 2 * (spin_right^2 + spin_left^2)
    }
    forces {
        let slip_right = v + c * omega - r * spin_right;
        let slip_left = v - c * omega - r * spin_left;
        let hold_right = grip / sqrt(slip_right^2 + side^2 + soft^2);
        let hold_left = grip / sqrt(slip_left^2 + side^2 + soft^2);
        v: -hold_right * slip_right - hold_left * slip_left;
        side: -(hold_right + hold_left) * side;
        omega: -c * (hold_right * slip_right - hold_left * slip_left);
        spin_right: torque_right + r * hold_right * slip_right;
        spin_left: torque_left + r * hold_left * slip_left;
    }
    inputs { torque_right, torque_left }
    assume { m > 0; J > 0; Jw > 0; grip >= 0; soft > 0; }
    units {
        x, y, l, c, r = m;
        theta = rad;
        spin_right, spin_left = rad/s;
        m = kg;
        J, Jw = kg m^2;
        grip = N;
        soft = m/s;
        torque_right, torque_left = N m;
    }
)]
#[derive(Clone, Copy, Debug)]
struct Slipping {
    m: f64,
    J: f64,
    Jw: f64,
    l: f64,
    c: f64,
    r: f64,
    grip: f64,
    soft: f64,
}

/// Coefficient of friction and weight on one wheel (N).
const FRICTION: f64 = 0.6;
const LOAD: f64 = 9.0 * 9.81 / 2.0;
/// Time between two ticks (s), their number, and the radius of the circle (m).
const TICK: f64 = 0.01;
const TICKS: u32 = 700;
const RADIUS: f64 = 1.0;
/// Torque of the drive, shared by the wheels (N m).
const DRIVE: f64 = 0.5;

/// The torques: a constant drive, and what holds the rate of turning to v / radius.
fn torques(v: f64, omega: f64) -> [f64; 2] {
    let turn = 1.5 * (v / RADIUS - omega);
    [DRIVE / 2.0 + turn, DRIVE / 2.0 - turn]
}

/// The share of the available friction that each contact needs: right, left.
fn use_of_friction(lambda: &RollingMultipliers) -> [f64; 2] {
    // the force across is shared by the wheels; +λ acts along ∂φ/∂y, which is 1 for `side` and `v`
    let across = lambda.across / 2.0;
    [lambda.right, lambda.left].map(|along| along.hypot(across) / (FRICTION * LOAD))
}

/// What happened at one tick.
struct Moment {
    t: f64,
    rolling: RollingState,
    needs: [f64; 2],
    slipping: SlippingState,
}

fn main() -> Result<(), Box<dyn Error>> {
    let rolling = Rolling { m: 9.0, J: 0.25, Jw: 0.006, l: 0.06, c: 0.18, r: 0.08 };
    let Rolling { m, J: inertia, Jw: spin, l, c, r } = rolling;
    let grip = FRICTION * LOAD;
    let slipping = Slipping { m, J: inertia, Jw: spin, l, c, r, grip, soft: 1e-3 };
    let mut state = RollingState { x: RADIUS, theta: std::f64::consts::FRAC_PI_2, ..RollingState::default() };
    let start = SlippingState { x: state.x, theta: state.theta, ..SlippingState::default() };
    let mut other = Integrator::new(slipping, Dopri5::new().rtol(1e-6).atol(1e-8), 0.0, start);
    let mut film = Vec::new();
    println!("     t     speed   friction used: right    left    slip of the other model (m/s)");
    for tick in 0..=TICKS {
        let t = TICK * f64::from(tick);
        let input = RollingInput::from(torques(state.v, state.omega));
        let needs = use_of_friction(&rolling.multipliers(t, &state, &input));
        let slid = *other.state();
        if tick % 50 == 0 {
            println!("{t:6.2} {:9.3} {:19.3} {:9.3} {:18.4}", state.v, needs[0], needs[1], slid.side.abs());
        }
        film.push(Moment { t, rolling: state, needs, slipping: slid });
        state = Rk4::step(&rolling, t, TICK, &state, &input);
        other.set_input(SlippingInput::from(torques(slid.v, slid.omega)));
        other.advance_to(t + TICK)?;
    }
    let predicted = film.iter().find(|moment| moment.needs[0].max(moment.needs[1]) > 1.0);
    // a speed of slipping far above that of the softened contact
    let seen = film.iter().find(|moment| moment.slipping.side.abs() > 0.02);
    if let (Some(predicted), Some(seen)) = (predicted, seen) {
        println!(
            "the multipliers exceed friction at {:.2} s; the other model slips at {:.2} s",
            predicted.t, seen.t
        );
    }
    draw(&film).save("slip")?;
    Ok(())
}

fn draw(film: &[Moment]) -> Picture {
    let title = "When do the wheels slip?";
    let subtitle = "Faster and faster along a circle: a model that rolls by assumption (blue), one with friction (orange).";
    let mut picture = Picture::new(960.0, 560.0, title, subtitle);
    let points = film.iter().map(|moment| (moment.slipping.x, moment.slipping.y));
    let view = View::showing(points, 0.2, Page { x: 36.0, y: 96.0 }, 420.0, 420.0);
    view.grid(&mut picture, 0.5, "m");
    let path = |place: &dyn Fn(&Moment) -> (f64, f64)| -> Vec<Page> {
        film.iter().map(|moment| view.at(place(moment))).collect()
    };
    let rolling = path(&|moment| (moment.rolling.x, moment.rolling.y));
    picture.line(&rolling, r##"stroke="#5b7bb0" stroke-width="1.4""##);
    let slipping = path(&|moment| (moment.slipping.x, moment.slipping.y));
    picture.line(&slipping, r##"stroke="#e8623e" stroke-width="2""##);
    let end = TICK * f64::from(TICKS);
    let mut upper = Chart::new(Page { x: 540.0, y: 130.0 }, [380.0, 160.0], [0.0, end], [0.0, 1.5]);
    let needs = film.iter().map(|moment| (moment.t, moment.needs[0].max(moment.needs[1]).min(1.5)));
    upper.line("", BLUE, needs);
    upper.draw(&mut picture, "Friction that the worse wheel needs, in units of what there is", "s");
    let limit = [upper.at(0.0, 1.0), upper.at(end, 1.0)];
    picture.line(&limit, &format!(r#"stroke="{INK}" stroke-width="1" stroke-dasharray="4 4""#));
    let mut lower = Chart::new(Page { x: 540.0, y: 366.0 }, [380.0, 130.0], [0.0, end], [0.0, 1.0]);
    let slips = film.iter().map(|moment| (moment.t, moment.slipping.side.abs().min(1.0)));
    lower.line("", ORANGE, slips);
    lower.draw(&mut picture, "Speed of slipping across (m/s)", "s");
    let note = format!("friction coefficient {FRICTION}; radius {RADIUS} m");
    let at = Page { x: 924.0, y: 546.0 };
    picture.text(at, &note, &format!(r#"font-size="12" fill="{MUTED}" text-anchor="end""#));
    picture
}

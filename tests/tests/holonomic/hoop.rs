//! A bead on a hoop that turns about its vertical diameter: a position constraint that depends on time.

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y, z }
    holonomic {
        plane: x * sin(W * t) = y * cos(W * t);
        hoop: x^2 + y^2 + z^2 = r^2;
    }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) - m * g * z }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct Bead {
    m: f64,
    r: f64,
    g: f64,
    W: f64,
}

/// By the angle from the lowest point, in the hoop's frame.
#[nonholonomic(
    base { theta }
    lagrangian { m * r^2 / 2 * (der(theta)^2 + W^2 * sin(theta)^2) + m * g * r * cos(theta) }
)]
#[derive(Clone, Copy, Debug)]
struct OnTheHoop {
    m: f64,
    r: f64,
    g: f64,
    W: f64,
}

const BEAD: Bead = Bead { m: 0.3, r: 0.5, g: 9.81, W: 6.0 };
const HOOP: OnTheHoop = OnTheHoop { m: 0.3, r: 0.5, g: 9.81, W: 6.0 };

fn in_space(t: f64, OnTheHoopState { theta, theta_dot }: OnTheHoopState) -> BeadState {
    let Bead { r, W, .. } = BEAD;
    let (sin, cos) = theta.sin_cos();
    let (turned, along) = (W * t).sin_cos();
    let (out, outwards) = (r * sin, r * cos * theta_dot);
    BeadState {
        x: out * along,
        y: out * turned,
        z: -r * cos,
        x_dot: outwards * along - out * W * turned,
        y_dot: outwards * turned + out * W * along,
        z_dot: r * sin * theta_dot,
    }
}

#[test]
fn a_moving_hoop_drives_the_bead() {
    let start = OnTheHoopState { theta: 0.4, theta_dot: 0.0 };
    let method = Dop853::new().rtol(1e-12).atol(1e-12);
    let mut bead = Integrator::new(BEAD, method, 0.3, in_space(0.3, start));
    let mut angle = Integrator::new(HOOP, method, 0.3, start);
    for step in 1..=10 {
        let t = 0.3 + f64::from(step);
        bead.advance_to(t).unwrap();
        angle.advance_to(t).unwrap();
        let expected = in_space(t, *angle.state()).to_array();
        for (found, expected) in bead.state().to_array().iter().zip(expected) {
            assert!((found - expected).abs() < 1e-8, "{found} {expected} at {t}");
        }
        let left = BEAD.constraint_residual(t, bead.state());
        assert!(left.plane.abs() < 1e-15 && left.hoop.abs() < 1e-15, "{left:?}");
        assert!(left.plane_dot.abs() < 1e-14 && left.hoop_dot.abs() < 1e-14, "{left:?}");
    }
}

#[test]
fn the_hoop_does_work() {
    // dE/dt = −λ_A ∂_t f^A: along the solution, by a difference quotient
    let start = OnTheHoopState { theta: 0.9, theta_dot: 1.3 };
    let (t, h) = (0.2, 1e-5);
    let run = |time: f64| {
        let mut sim = Integrator::new(HOOP, Dop853::new().rtol(1e-13).atol(1e-13), t, start);
        sim.advance_to(time).unwrap();
        BEAD.energy(time, &in_space(time, *sim.state()))
    };
    let slope = (run(t + h) - run(t - h)) / (2.0 * h);
    let state = in_space(t, start);
    let lambda = BEAD.multipliers(t, &state, &()).plane;
    let (sin, cos) = (BEAD.W * t).sin_cos();
    let drift = BEAD.W * (state.x * cos + state.y * sin);
    assert!((slope + lambda * drift).abs() < 1e-7 * slope.abs(), "{slope} {}", -lambda * drift);
}

//! The momentum equation along trajectories: what a momentum gains is the integral of its rate, for
//! sections that are declared and for those of the splitting; momenta of horizontal symmetries stay.

use nonholonomic::prelude::*;

/// A robot that tows a trailer, driven at the hitch, with friction along the group.
#[nonholonomic(
    base { x, y, theta, b }
    lagrangian {
        m / 2 * (der(x)^2 + der(y)^2) + J / 2 * der(theta)^2 + K / 2 * (der(theta) + der(b))^2
            + n / 2 * ((der(x) + d * sin(theta + b) * (der(theta) + der(b)))^2
                + (der(y) - d * cos(theta + b) * (der(theta) + der(b)))^2)
    }
    constraints {
        cos(theta) * der(y) - sin(theta) * der(x) = 0;
        cos(theta + b) * der(y) - sin(theta + b) * der(x) = d * (der(theta) + der(b));
    }
    assume { d > 0; }
    forces { b: u; theta: -c * der(theta); }
    inputs { u }
    symmetries { turn: der(theta) + x * der(y) - y * der(x); }
    emit { splitting }
)]
#[derive(Clone, Copy, Debug)]
struct Tow {
    m: f64,
    n: f64,
    J: f64,
    K: f64,
    d: f64,
    c: f64,
}

/// A rolling wheel with a rotor on an incline that is moved.
#[nonholonomic(
    base { x, y, phi, psi, rho }
    lagrangian {
        m / 2 * (der(x)^2 + der(y)^2) + I / 2 * der(psi)^2 + J / 2 * der(phi)^2
            + K / 2 * (der(rho) + der(phi))^2 - m * g * sin(s * t) * x
    }
    constraints { der(x) = r * cos(phi) * der(psi); der(y) = r * sin(phi) * der(psi); }
    symmetries {
        roll: der(psi) + r * cos(phi) * der(x) + r * sin(phi) * der(y);
        swing: sin(psi) * der(rho);
        rotor: der(rho);
        body: der(phi) - der(rho);
    }
)]
#[derive(Clone, Copy, Debug)]
struct Wheel {
    m: f64,
    I: f64,
    J: f64,
    K: f64,
    g: f64,
    s: f64,
    r: f64,
}

/// Gains and integrals by Gauss' formula with three nodes.
fn balance<S: Dynamics<State: State<Scalar = f64>> + Copy, const N: usize>(
    system: S,
    start: S::State,
    input: S::Input,
    momenta: impl Fn(f64, &S::State) -> [f64; N],
    rates: impl Fn(f64, &S::State) -> [f64; N],
) -> [[f64; 2]; N] {
    let (steps, h) = (300, 0.01);
    let node = 0.6_f64.sqrt();
    let mut sim = Integrator::new(system, Dop853::new().rtol(1e-12).atol(1e-12), 0.0, start);
    sim.set_input(input);
    let begin = momenta(0.0, &start);
    let mut integral = [0.0; N];
    for step in 0..steps {
        for (node, weight) in [(-node, 5.0), (0.0, 8.0), (node, 5.0)] {
            sim.advance_to(h * (f64::from(step) + f64::midpoint(1.0, node))).unwrap();
            for (sum, rate) in integral.iter_mut().zip(rates(sim.time(), sim.state())) {
                *sum += h * weight / 18.0 * rate;
            }
        }
    }
    sim.advance_to(h * f64::from(steps)).unwrap();
    let end = momenta(sim.time(), sim.state());
    std::array::from_fn(|i| [end[i] - begin[i], integral[i]])
}

/// Checks mathematics (25).
#[test]
fn momenta_of_the_splitting() {
    let tow = Tow { m: 2.0, n: 1.1, J: 0.5, K: 0.3, d: 0.7, c: 0.1 };
    let place = TowState { x: 0.1, y: -0.2, theta: 0.4, b: 0.5, ..TowState::default() };
    // along the lift and the vertical section, so that the constraints hold
    let ([lift], [vertical]) = (tow.horizontal_lifts(0.0, &place), tow.vertical_sections(0.0, &place));
    let [x_dot, y_dot, theta_dot, b_dot] = std::array::from_fn(|i| 0.8 * lift[i] - 0.6 * vertical[i]);
    let start = TowState { x_dot, y_dot, theta_dot, b_dot, ..place };
    assert!((tow.vertical_velocities(0.0, &start)[0] + 0.6).abs() < 1e-14);
    let input = TowInput { u: 0.3 };
    let [[gain, integral]] = balance(
        tow,
        start,
        input,
        |t, x| tow.vertical_momenta(t, x),
        |t, x| tow.vertical_momentum_rates(t, x, &input),
    );
    assert!((gain - integral).abs() < 1e-10 && gain.abs() > 1e-2, "{gain} {integral}");
}

#[test]
fn declared_momenta() {
    let wheel = Wheel { m: 2.0, I: 0.5, J: 1.1, K: 0.3, g: 9.8, s: 0.4, r: 0.3 };
    let start = WheelState {
        x: 0.1,
        y: -0.2,
        phi: 0.4,
        psi: 0.5,
        rho: 0.2,
        phi_dot: 0.7,
        psi_dot: -0.8,
        rho_dot: 0.4,
    };
    let gains = balance(
        wheel,
        start,
        (),
        |t, x| <[f64; 4]>::from(wheel.momenta(t, x)),
        |t, x| <[f64; 4]>::from(wheel.momentum_rates(t, x, &())),
    );
    for (index, [gain, integral]) in gains.into_iter().enumerate() {
        assert!((gain - integral).abs() < 1e-10, "{index}: {gain} {integral}");
        // the rotor and the body are free
        assert_eq!(gain.abs() > 1e-2, index < 2, "{index}: {gain}");
    }
}

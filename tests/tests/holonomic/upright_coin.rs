//! Contacts by coordinates without inertia, at a place where a constraint moves these alone.

use nonholonomic::prelude::*;

/// A coin rolls on a cylinder that lies: the place on the rim, and that on the cylinder, are coordinates.
#[nonholonomic(
    base { p[3], yaw, lean, spin, s, b, along }
    let R = rot_z(yaw) * rot_x(lean);
    let rim = R * [r * sin(s), 0, -r * cos(s)];
    let tangent = R * [cos(s), 0, sin(s)];
    let ground = [along, C * sin(b), C * cos(b)];
    let out = [0, sin(b), cos(b)];
    holonomic { touch: p + rim - ground = 0; flat: dot(tangent, out) = 0; }
    let slip = der(p) + cross(space_rate(R) + der(spin) * (R * [0, 1, 0]), rim);
    constraints { rolling: [slip[0], slip[1] * cos(b) - slip[2] * sin(b)] = 0; }
    lagrangian { kinetic(m, [I, 0, I], p, R) + Iy / 2 * (der(spin) + body_rate(R)[1])^2 - m * g * p[2] }
    emit { multipliers }
    assume { m > 0; I > 0; Iy > 0; r > 0; C > 0; }
)]
#[derive(Clone, Copy, Debug)]
struct Coin {
    r: f64,
    C: f64,
    m: f64,
    I: f64,
    Iy: f64,
    g: f64,
}

const COIN: Coin = Coin { r: 0.1, C: 1.0, m: 0.2, I: 0.0005, Iy: 0.001, g: 9.81 };

/// Upright on top, in some direction.
fn on_top(yaw: f64) -> CoinState {
    let (sine, cosine) = yaw.sin_cos();
    let spin_dot = 8.0;
    let v = COIN.r * spin_dot;
    CoinState {
        p: [0.0, 0.0, COIN.C + COIN.r],
        yaw,
        spin_dot,
        p_dot: [v * cosine, v * sine, 0.0],
        ..CoinState::default()
    }
}

#[test]
fn a_coin_that_stands_on_top_goes_on_as_those_beside() {
    for yaw in [0.0, 0.3, -0.2] {
        let mut start = on_top(yaw);
        COIN.project(0.0, &mut start).unwrap();
        let there: [f64; 18] = COIN.derivative(0.0, &start, &()).into();
        let mut beside = CoinState { s: start.s + 1e-9, b: start.b + 1e-9, ..start };
        COIN.project(0.0, &mut beside).unwrap();
        let near: [f64; 18] = COIN.derivative(0.0, &beside, &()).into();
        let largest = near.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        for (there, near) in there.iter().zip(&near) {
            assert!((there - near).abs() < 1e-5 * largest, "{yaw}: {there} {near}");
        }
        let forces = COIN.multipliers(0.0, &start, &());
        assert!(forces.touch[2].is_finite() && forces.rolling[0].is_finite(), "{forces:?}");
    }
    // straight along the cylinder nothing happens, and the ground carries the weight
    let mut start = on_top(0.0);
    COIN.project(0.0, &mut start).unwrap();
    let rates = COIN.derivative(0.0, &start, &());
    assert!(rates.p_dot.iter().all(|rate| rate.abs() < 1e-12) && rates.spin_dot.abs() < 1e-12, "{rates:?}");
    assert!((COIN.multipliers(0.0, &start, &()).touch[2] - COIN.m * COIN.g).abs() < 1e-13);
    let mut sim = Integrator::new(COIN, Dopri5::new().rtol(1e-10), 0.0, start);
    sim.advance_to(0.5).unwrap();
    assert!((sim.state().p[0] - 0.4).abs() < 1e-9, "{:?}", sim.state());
}

#[test]
fn it_is_assembled_from_a_guess_on_top() {
    for (yaw, lean) in [(0.0, 0.0), (0.3, 0.1), (0.3, 0.0), (0.0, 0.1)] {
        let guess = CoinState { p: [0.0, 0.02, 1.1], yaw, lean, spin_dot: 8.0, ..CoinState::default() };
        let found = COIN.assemble(0.0, &guess).unwrap();
        let left = COIN.constraint_residual(0.0, &found);
        assert!(left.touch.iter().all(|left| left.abs() < 1e-15) && left.flat.abs() < 1e-15, "{left:?}");
    }
}

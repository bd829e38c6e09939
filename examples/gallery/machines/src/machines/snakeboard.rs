use nonholonomic::prelude::*;

use crate::live::{Model, Slider};
use crate::scene::{Colour, Scene, placed};

/// A snakeboard: a rider swings a rotor and steers both pairs of wheels against each other.
#[nonholonomic(
    base   { x, y, theta, psi, phi }
    basis  { u1, u2, omega, dpsi, dphi }
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
        front: sin(phi) * u1 - cos(phi) * (u2 + l * omega) = 0;
        back:  sin(phi) * u1 + cos(phi) * (u2 - l * omega) = 0;
        rotor:    dpsi = swing * rate * cos(rate * t);
        steering: dphi = steer * rate * cos(rate * t);
    }
    independent { u1 }
    units { x, y, l = m; theta, psi, phi, swing, steer = rad; t = s; rate = s^-1; m = kg; J0, J1 = kg m^2; }
    emit { latex }
)]
#[derive(Clone, Copy, Debug)]
pub struct Snakeboard {
    pub m: f64,
    pub l: f64,
    pub J0: f64,
    pub J1: f64,
    /// Amplitude of the rotor (rad).
    pub swing: f64,
    /// Amplitude of the steering (rad).
    pub steer: f64,
    /// Angular frequency of both (1/s).
    pub rate: f64,
}

impl Model for Snakeboard {
    const TITLE: &'static str = "A snakeboard's gait";
    const TEXT: &'static str = "Nobody pushes off the ground: swinging a rotor and steering in the same rhythm drives the \
        board ahead. Rotor and steering are prescribed by constraints that depend on time.";
    const SOURCE: &'static str = include_str!("snakeboard.rs");
    const DERIVED: &'static str = Self::REPORT;
    const TYPESET: &'static str = Self::LATEX;
    const CONSERVATIVE: bool = false;

    fn start() -> (Self, SnakeboardState) {
        let board = Self { m: 6.0, l: 0.2, J0: 0.016, J1: 0.0013, swing: -0.7, steer: 0.4, rate: 6.0 };
        (board, SnakeboardState::default())
    }

    fn sliders() -> Vec<Slider<Self>> {
        vec![
            Slider {
                label: "swing of the rotor (rad)",
                range: [-1.5, 1.5],
                get: |s| s.swing,
                set: |s, x| s.swing = x,
            },
            Slider { label: "steering (rad)", range: [-0.8, 0.8], get: |s| s.steer, set: |s, x| s.steer = x },
        ]
    }

    fn pushed(&self, state: &SnakeboardState, [right, up]: [f64; 2]) -> SnakeboardState {
        let (sin, cos) = state.theta.sin_cos();
        SnakeboardState { u1: state.u1 + right * cos + up * sin, ..*state }
    }

    fn traced(&self, state: &SnakeboardState) -> Option<[f64; 2]> {
        Some([state.x, state.y])
    }

    fn view(&self, state: &SnakeboardState) -> ([f64; 2], f64) {
        ([state.x, state.y], 1.0)
    }

    fn draw(&self, _t: f64, state: &SnakeboardState, scene: &mut Scene) {
        let (at, heading) = ([state.x, state.y], state.theta);
        scene.ground(at, 2.0, 0.25);
        scene.block(Colour::Body, at, heading, [self.l, 0.04]);
        for (end, turned) in [(self.l, state.phi), (-self.l, -state.phi)] {
            let axle = placed(at, heading, [end, 0.0]);
            let across = heading + turned;
            scene.line(
                Colour::Contact,
                3.0,
                &[placed(axle, across, [0.0, -0.1]), placed(axle, across, [0.0, 0.1])],
            );
            for side in [-0.1, 0.1] {
                scene.block(Colour::Contact, placed(axle, across, [0.0, side]), across, [0.035, 0.012]);
            }
        }
        let rotor = heading + state.psi;
        scene.line(Colour::Accent, 3.0, &[placed(at, rotor, [-0.12, 0.0]), placed(at, rotor, [0.12, 0.0])]);
    }
}

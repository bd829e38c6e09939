use nonholonomic::prelude::*;

use crate::live::{Model, Slider};
use crate::scene::{Colour, Scene, placed};

/// A roller racer: a seat on wheels, and a handlebar with wheels hinged to it.
#[nonholonomic(
    base   { x, y, theta, phi }
    basis  { v, side, omega, dphi }
    anchor {
        der(x) = v * cos(theta) - side * sin(theta);
        der(y) = v * sin(theta) + side * cos(theta);
        der(theta) = omega;
        der(phi) = dphi;
    }
    lagrangian { m / 2 * (v^2 + side^2) + J1 / 2 * omega^2 + J2 / 2 * (omega + dphi)^2 }
    constraints {
        rear: side = 0;
        // the front axle is l2 behind the hinge, which is l1 ahead of the rear axle
        front: v * sin(phi) = (side + l1 * omega) * cos(phi) - l2 * (omega + dphi);
        handlebar: dphi = swing * rate * cos(rate * t);
    }
    independent { v }
    assume { m > 0; J1 > 0; J2 > 0; l1 > 0; l2 > 0; }
    units { x, y, l1, l2 = m; theta, phi, swing = rad; t = s; rate = s^-1; m = kg; J1, J2 = kg m^2; }
    emit { latex }
)]
#[derive(Clone, Copy, Debug)]
pub struct RollerRacer {
    pub m: f64,
    pub J1: f64,
    pub J2: f64,
    pub l1: f64,
    pub l2: f64,
    /// Amplitude of the handlebar (rad).
    pub swing: f64,
    /// Its angular frequency (1/s).
    pub rate: f64,
}

impl Model for RollerRacer {
    const TITLE: &'static str = "A roller racer";
    const TEXT: &'static str = "A toy that children ride by wiggling the handlebar: wheels without motors, and yet it runs \
        ahead. The swing is prescribed by a constraint; what is left is one velocity.";
    const SOURCE: &'static str = include_str!("roller_racer.rs");
    const DERIVED: &'static str = Self::REPORT;
    const TYPESET: &'static str = Self::LATEX;
    const CONSERVATIVE: bool = false;

    fn start() -> (Self, RollerRacerState) {
        let racer = Self { m: 10.0, J1: 0.4, J2: 0.05, l1: 0.5, l2: 0.1, swing: 0.6, rate: 5.0 };
        (racer, RollerRacerState::default())
    }

    fn sliders() -> Vec<Slider<Self>> {
        vec![
            Slider { label: "swing (rad)", range: [0.0, 1.0], get: |s| s.swing, set: |s, x| s.swing = x },
            Slider {
                label: "length of the seat (m)",
                range: [0.3, 0.8],
                get: |s| s.l1,
                set: |s, x| s.l1 = x,
            },
        ]
    }

    fn pushed(&self, state: &RollerRacerState, [right, up]: [f64; 2]) -> RollerRacerState {
        let (sin, cos) = state.theta.sin_cos();
        RollerRacerState { v: state.v + right * cos + up * sin, ..*state }
    }

    fn traced(&self, state: &RollerRacerState) -> Option<[f64; 2]> {
        Some([state.x, state.y])
    }

    fn view(&self, state: &RollerRacerState) -> ([f64; 2], f64) {
        ([state.x, state.y], 1.5)
    }

    fn draw(&self, _t: f64, state: &RollerRacerState, scene: &mut Scene) {
        let (at, heading) = ([state.x, state.y], state.theta);
        scene.ground(at, 3.0, 0.5);
        let hinge = placed(at, heading, [self.l1, 0.0]);
        scene.line(Colour::Body, 5.0, &[at, hinge]);
        for (axle, turned) in
            [(at, heading), (placed(hinge, heading + state.phi, [-self.l2, 0.0]), heading + state.phi)]
        {
            scene.line(
                Colour::Contact,
                3.0,
                &[placed(axle, turned, [0.0, -0.2]), placed(axle, turned, [0.0, 0.2])],
            );
            for side in [-0.2, 0.2] {
                scene.block(Colour::Contact, placed(axle, turned, [0.0, side]), turned, [0.08, 0.02]);
            }
        }
        let bar = heading + state.phi;
        scene.line(Colour::Accent, 3.0, &[hinge, placed(hinge, bar, [-self.l2, 0.0])]);
    }
}

use nonholonomic::prelude::*;

use crate::live::{Model, Slider};
use crate::scene::{Colour, Scene, placed};

/// A body on a plane, carried by a knife edge (Chaplygin's sleigh).
#[nonholonomic(
    base   { theta, x, y }
    basis  { omega, v, side }
    anchor {
        der(theta) = omega;
        der(x) = v * cos(theta) - side * sin(theta);
        der(y) = v * sin(theta) + side * cos(theta);
    }
    lagrangian  { J / 2 * omega^2 + m / 2 * (v^2 + (side + a * omega)^2) }
    constraints { edge: side = 0; }
    assume      { m > 0; J > 0; }
    units       { theta = rad; x, y, a = m; m = kg; J = kg m^2; edge = N; }
    emit { latex }
)]
#[derive(Clone, Copy, Debug)]
pub struct Sleigh {
    pub m: f64,
    pub J: f64,
    /// The centre of mass is so far ahead of the edge (m).
    pub a: f64,
}

impl Model for Sleigh {
    const TITLE: &'static str = "Chaplygin's sleigh";
    const TEXT: &'static str = "A body glides on a knife edge. Pushed backwards, with its centre of mass ahead of the \
        edge, it turns over, loops, and ends gliding forwards on a straight line. Energy is conserved, and yet the \
        motion forgets where it came from: no mechanical system without rolling or blades can do that.";
    const SOURCE: &'static str = include_str!("sleigh.rs");
    const DERIVED: &'static str = Self::REPORT;
    const TYPESET: &'static str = Self::LATEX;

    fn start() -> (Self, SleighState) {
        let sleigh = Self { m: 1.0, J: 0.9, a: 0.2 };
        (sleigh, SleighState { theta: -0.4, x: 0.0, y: 0.0, omega: 0.15, v: -1.0 })
    }

    fn sliders() -> Vec<Slider<Self>> {
        vec![
            Slider {
                label: "centre of mass ahead, a (m)",
                range: [-0.4, 0.4],
                get: |s| s.a,
                set: |s, a| s.a = a,
            },
            Slider {
                label: "moment of inertia, J (kg m²)",
                range: [0.1, 3.0],
                get: |s| s.J,
                set: |s, j| s.J = j,
            },
        ]
    }

    fn pushed(&self, state: &SleighState, [right, up]: [f64; 2]) -> SleighState {
        let (sin, cos) = state.theta.sin_cos();
        let (along, across) = (right * cos + up * sin, up * cos - right * sin);
        SleighState { v: state.v + along, omega: state.omega + across, ..*state }
    }

    fn traced(&self, state: &SleighState) -> Option<[f64; 2]> {
        Some([state.x, state.y])
    }

    fn view(&self, state: &SleighState) -> ([f64; 2], f64) {
        ([state.x, state.y], 3.0)
    }

    fn draw(&self, _t: f64, state: &SleighState, scene: &mut Scene) {
        let (at, heading) = ([state.x, state.y], state.theta);
        scene.ground(at, 6.0, 1.0);
        scene.block(Colour::Body, placed(at, heading, [self.a, 0.0]), heading, [0.45, 0.2]);
        scene.line(
            Colour::Contact,
            4.0,
            &[placed(at, heading, [-0.25, 0.0]), placed(at, heading, [0.25, 0.0])],
        );
        scene.disk(Colour::Accent, placed(at, heading, [self.a, 0.0]), 0.06);
    }
}

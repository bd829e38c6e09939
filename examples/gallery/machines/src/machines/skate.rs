use nonholonomic::prelude::*;

use crate::live::{Model, Slider};
use crate::scene::{Colour, Scene, placed};

/// A skate on an inclined plane: it slides along its blade and turns freely.
#[nonholonomic(
    base   { theta, x, y }
    basis  { omega, v, side }
    anchor {
        der(theta) = omega;
        der(x) = v * cos(theta) - side * sin(theta);
        der(y) = v * sin(theta) + side * cos(theta);
    }
    lagrangian  { J / 2 * omega^2 + m / 2 * (v^2 + side^2) - m * g * sin(slope) * y }
    constraints { blade: side = 0; }
    assume      { m > 0; J > 0; }
    units       { theta, slope = rad; x, y = m; m = kg; J = kg m^2; g = m/s^2; blade = N; }
    emit { latex }
)]
#[derive(Clone, Copy, Debug)]
pub struct Skate {
    pub m: f64,
    pub J: f64,
    pub g: f64,
    /// The plane falls towards −y (rad).
    pub slope: f64,
}

impl Model for Skate {
    const TITLE: &'static str = "A skate on a slope";
    const TEXT: &'static str = "A spinning skate on an inclined plane does not run down: it drifts across the slope along \
        a cycloid, since its blade points uphill as often as downhill. Stop its spin and it is off.";
    const SOURCE: &'static str = include_str!("skate.rs");
    const DERIVED: &'static str = Self::REPORT;
    const TYPESET: &'static str = Self::LATEX;

    fn start() -> (Self, SkateState) {
        let skate = Self { m: 1.0, J: 0.1, g: 9.81, slope: 0.1 };
        (skate, SkateState { theta: 0.0, x: 0.0, y: 0.0, omega: 1.5, v: 0.0 })
    }

    fn sliders() -> Vec<Slider<Self>> {
        vec![Slider {
            label: "slope (rad)",
            range: [0.0, 0.4],
            get: |s| s.slope,
            set: |s, slope| s.slope = slope,
        }]
    }

    fn pushed(&self, state: &SkateState, [right, up]: [f64; 2]) -> SkateState {
        let (sin, cos) = state.theta.sin_cos();
        let (along, across) = (right * cos + up * sin, up * cos - right * sin);
        SkateState { v: state.v + along, omega: state.omega + across, ..*state }
    }

    fn traced(&self, state: &SkateState) -> Option<[f64; 2]> {
        Some([state.x, state.y])
    }

    fn view(&self, state: &SkateState) -> ([f64; 2], f64) {
        ([state.x, state.y], 2.0)
    }

    fn draw(&self, _t: f64, state: &SkateState, scene: &mut Scene) {
        let (at, heading) = ([state.x, state.y], state.theta);
        scene.ground(at, 4.0, 0.5);
        scene.block(Colour::Body, at, heading, [0.22, 0.09]);
        scene.line(
            Colour::Contact,
            4.0,
            &[placed(at, heading, [-0.3, 0.0]), placed(at, heading, [0.3, 0.0])],
        );
        // downhill
        scene.line(Colour::Accent, 2.0, &[[at[0], at[1]], [at[0], at[1] - 2.0 * self.slope]]);
    }
}

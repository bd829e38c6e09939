use nonholonomic::prelude::*;

use crate::live::{Fault, Model, Slider};
use crate::scene::{Colour, Scene};
use crate::space::{seen, turn};

/// A body with a fixed point that cannot turn about the vertical (Veselova's problem).
#[nonholonomic(
    base {
        /// The vertical, seen from the body.
        g[3],
    }
    on { unit: dot(g, g) = 1; }
    basis { w[3] }
    anchor { for i in 0..3 { der(g[i]) = cross(g, w)[i]; } }
    brackets so(3) { w }
    lagrangian  { sum(i in 0..3: I[i] * w[i]^2) / 2 - c * g[2] }
    constraints { veselova: dot(g, w) = 0; }
    assume      { I > 0; }
    units       { g = 1; w = s^-1; I = kg m^2; c = J; }
    emit { latex }
)]
#[derive(Clone, Copy, Debug)]
pub struct Veselova {
    pub I: [f64; 3],
    /// Weight times the height of the centre of mass along the third axis (J).
    pub c: f64,
}

impl Model for Veselova {
    const TITLE: &'static str = "Veselova's problem";
    const TEXT: &'static str = "A body turns about a point, but never about the vertical. What is drawn is the path of the \
        vertical as the body sees it, on a sphere. No basis of the allowed velocities exists everywhere on it, so \
        all velocities are kept, and the state returns to the constraint after every step.";
    const SOURCE: &'static str = include_str!("veselova.rs");
    const DERIVED: &'static str = Self::REPORT;
    const TYPESET: &'static str = Self::LATEX;

    fn start() -> (Self, VeselovaState) {
        let body = Self { I: [1.0, 1.6, 2.3], c: 0.6 };
        (body, VeselovaState { g: [0.6, 0.0, -0.8], w: [0.8, 0.9, 0.6] })
    }

    fn sliders() -> Vec<Slider<Self>> {
        vec![
            Slider {
                label: "first moment of inertia (kg m²)",
                range: [0.5, 3.0],
                get: |s| s.I[0],
                set: |s, x| s.I[0] = x,
            },
            Slider { label: "weight (J)", range: [0.0, 2.0], get: |s| s.c, set: |s, x| s.c = x },
        ]
    }

    fn after(&self, t: f64, tick: f64, state: &VeselovaState, (): ()) -> Result<VeselovaState, Fault> {
        let method = Projected::new(Dopri5::new().rtol(1e-10).atol(1e-12), 1);
        let mut motion = Integrator::new(*self, method, t, *state);
        motion.advance_to(t + tick)?;
        Ok(*motion.state())
    }

    fn off_constraints(&self, t: f64, state: &VeselovaState) -> Option<f64> {
        Some(self.constraint_residual(t, state).veselova.abs())
    }

    fn pushed(&self, state: &VeselovaState, [right, up]: [f64; 2]) -> VeselovaState {
        let [w0, w1, w2] = state.w;
        let mut pushed = VeselovaState { w: [w0 + right, w1 + up, w2], ..*state };
        let _ = self.project(0.0, &mut pushed);
        pushed
    }

    fn traced(&self, state: &VeselovaState) -> Option<[f64; 2]> {
        Some(seen(state.g))
    }

    fn view(&self, _state: &VeselovaState) -> ([f64; 2], f64) {
        ([0.0, 0.0], 1.3)
    }

    fn draw(&self, _t: f64, state: &VeselovaState, scene: &mut Scene) {
        scene.circle(Colour::Faint, 1.5, [0.0, 0.0], 1.0);
        for k in -2..=2 {
            let height = f64::from(k) * 0.4;
            let radius = (1.0 - height * height).sqrt();
            let circle: Vec<[f64; 2]> =
                turn(48).map(|angle| seen([radius * angle.cos(), radius * angle.sin(), height])).collect();
            scene.line(Colour::Faint, 0.7, &circle);
        }
        let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        for axis in axes {
            scene.line(Colour::Body, 2.0, &[[0.0, 0.0], seen(axis.map(|x| 1.1 * x))]);
        }
        scene.line(Colour::Accent, 3.0, &[[0.0, 0.0], seen(state.g)]);
        scene.disk(Colour::Accent, seen(state.g), 0.04);
    }
}

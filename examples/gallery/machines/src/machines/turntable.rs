use nonholonomic::prelude::*;

use crate::live::{Model, Slider};
use crate::scene::{Colour, Scene};
use crate::space::turn;

/// A ball that rolls on a turning table: affine constraints.
#[nonholonomic(
    base  { x, y }
    basis { vx, vy, w[3] }
    anchor { der(x) = vx; der(y) = vy; }
    // angular velocities seen in space
    brackets so(3) { w[2], w[1], w[0] }
    lagrangian { m / 2 * (vx^2 + vy^2 + k^2 * dot(w, w)) - m * g * slope * x }
    constraints {
        vx = r * w[1] - rate * y;
        vy = -r * w[0] + rate * x;
    }
    conserved { spin = w[2]; }
    assume { r > 0; k > 0; m > 0; }
    units { x, y, k, r = m; w, rate = s^-1; m = kg; g = m/s^2; slope = 1; }
    emit { latex }
)]
#[derive(Clone, Copy, Debug)]
pub struct Turntable {
    pub m: f64,
    /// Radius of gyration (m).
    pub k: f64,
    pub r: f64,
    /// The table's rate (1/s).
    pub rate: f64,
    pub g: f64,
    /// The table falls towards −x.
    pub slope: f64,
}

impl Model for Turntable {
    const TITLE: &'static str = "A ball on a turning table";
    const TEXT: &'static str = "A ball put on a turning table is not thrown off: it runs in circles, at two sevenths of the \
        table's rate if it is solid. Tilt the table, and the circles drift across the slope, never down.";
    const SOURCE: &'static str = include_str!("turntable.rs");
    const DERIVED: &'static str = Self::REPORT;
    const TYPESET: &'static str = Self::LATEX;
    const CONSERVATIVE: bool = false;

    fn start() -> (Self, TurntableState) {
        let r = 0.1;
        let table = Self { m: 1.0, k: (0.4_f64).sqrt() * r, r, rate: 3.0, g: 9.81, slope: 0.0 };
        (table, TurntableState { x: 0.5, y: 0.0, w: [0.0, 4.0, 0.0] })
    }

    fn sliders() -> Vec<Slider<Self>> {
        vec![
            Slider {
                label: "rate of the table (1/s)",
                range: [-6.0, 6.0],
                get: |s| s.rate,
                set: |s, x| s.rate = x,
            },
            Slider { label: "slope", range: [0.0, 0.03], get: |s| s.slope, set: |s, x| s.slope = x },
            Slider { label: "radius of gyration (m)", range: [0.02, 0.1], get: |s| s.k, set: |s, x| s.k = x },
        ]
    }

    fn pushed(&self, state: &TurntableState, [right, up]: [f64; 2]) -> TurntableState {
        let [wx, wy, wz] = state.w;
        TurntableState { w: [wx - up / self.r, wy + right / self.r, wz], ..*state }
    }

    fn traced(&self, state: &TurntableState) -> Option<[f64; 2]> {
        Some([state.x, state.y])
    }

    fn view(&self, _state: &TurntableState) -> ([f64; 2], f64) {
        ([0.0, 0.0], 2.2)
    }

    fn draw(&self, t: f64, state: &TurntableState, scene: &mut Scene) {
        scene.circle(Colour::Faint, 2.0, [0.0, 0.0], 2.0);
        for spoke in turn(8) {
            let (sin, cos) = (spoke + self.rate * t).sin_cos();
            scene.line(Colour::Faint, 1.0, &[[0.0, 0.0], [2.0 * cos, 2.0 * sin]]);
        }
        scene.disk(Colour::Accent, [state.x, state.y], self.r);
    }
}

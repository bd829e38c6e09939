use nonholonomic::prelude::*;

use crate::live::{Fault, Model, Slider};
use crate::scene::{Colour, Scene};
use crate::space::{cross, dot, in_space, seen, turn};

/// Chaplygin's sphere: a ball with three moments of inertia, its centre of mass in the middle, rolls on a plane.
#[nonholonomic(
    base { g[3], e[3], x, y }
    on { dot(g, g) = 1; dot(e, e) = 1; dot(e, g) = 0; }
    basis { w[3], vx, vy }
    anchor {
        for i in 0..3 {
            der(g[i]) = cross(g, w)[i];
            der(e[i]) = cross(e, w)[i];
        }
        der(x) = vx;
        der(y) = vy;
    }
    brackets so(3) { w }
    lagrangian { m / 2 * (vx^2 + vy^2) + (I[0] * w[0]^2 + I[1] * w[1]^2 + I[2] * w[2]^2) / 2 }
    constraints {
        vx = r * dot(cross(g, e), w);
        vy = -r * dot(e, w);
    }
    assume { m > 0; I > 0; r > 0; }
    units { g, e = 1; x, y, r = m; w = s^-1; m = kg; I = kg m^2; }
    emit { latex }
)]
#[derive(Clone, Copy, Debug)]
pub struct ChaplyginSphere {
    pub m: f64,
    pub I: [f64; 3],
    pub r: f64,
}

impl Model for ChaplyginSphere {
    const TITLE: &'static str = "Chaplygin's sphere";
    const TEXT: &'static str = "A balanced but uneven ball rolls on a table. Its track wanders as if at random; it is \
        integrable all the same, and keeps a volume that Chaplygin found in 1903.";
    const SOURCE: &'static str = include_str!("chaplygin_sphere.rs");
    const DERIVED: &'static str = Self::REPORT;
    const TYPESET: &'static str = Self::LATEX;

    fn start() -> (Self, ChaplyginSphereState) {
        let ball = Self { m: 1.0, I: [0.05, 0.09, 0.12], r: 0.5 };
        let start = ChaplyginSphereState {
            g: [0.0, 0.0, 1.0],
            e: [1.0, 0.0, 0.0],
            w: [0.3, 2.0, 0.4],
            ..ChaplyginSphereState::default()
        };
        (ball, start)
    }

    fn sliders() -> Vec<Slider<Self>> {
        vec![
            Slider {
                label: "least moment of inertia (kg m²)",
                range: [0.03, 0.15],
                get: |s| s.I[0],
                set: |s, x| s.I[0] = x,
            },
            Slider {
                label: "middle moment of inertia (kg m²)",
                range: [0.03, 0.15],
                get: |s| s.I[1],
                set: |s, x| s.I[1] = x,
            },
        ]
    }

    fn after(
        &self,
        t: f64,
        tick: f64,
        state: &ChaplyginSphereState,
        (): (),
    ) -> Result<ChaplyginSphereState, Fault> {
        let mut motion = Integrator::new(*self, Dopri5::new().rtol(1e-10).atol(1e-12), t, *state);
        motion.advance_to(t + tick)?;
        let mut state = *motion.state();
        let _ = self.normalize(&mut state);
        Ok(state)
    }

    fn off_constraints(&self, _t: f64, state: &ChaplyginSphereState) -> Option<f64> {
        let (g, e) = (state.g, state.e);
        Some([dot(g, g) - 1.0, dot(e, e) - 1.0, dot(e, g)].map(f64::abs).into_iter().fold(0.0, f64::max))
    }

    fn pushed(&self, state: &ChaplyginSphereState, [right, up]: [f64; 2]) -> ChaplyginSphereState {
        let frame = cross(state.g, state.e);
        let mut pushed = *state;
        for ((w, across), along) in pushed.w.iter_mut().zip(frame).zip(state.e) {
            *w += (right * across - up * along) / self.r;
        }
        pushed
    }

    fn traced(&self, state: &ChaplyginSphereState) -> Option<[f64; 2]> {
        Some(seen([state.x, state.y, 0.0]))
    }

    fn view(&self, state: &ChaplyginSphereState) -> ([f64; 2], f64) {
        (seen([state.x, state.y, 0.4]), 2.0)
    }

    fn draw(&self, _t: f64, state: &ChaplyginSphereState, scene: &mut Scene) {
        let at = [state.x, state.y, self.r];
        let frame = [state.e, cross(state.g, state.e), state.g];
        for k in -6..=6 {
            let (x, y, place) = (state.x.round(), state.y.round(), f64::from(k));
            scene.line(
                Colour::Faint,
                1.0,
                &[seen([x + place, y - 6.0, 0.0]), seen([x + place, y + 6.0, 0.0])],
            );
            scene.line(
                Colour::Faint,
                1.0,
                &[seen([x - 6.0, y + place, 0.0]), seen([x + 6.0, y + place, 0.0])],
            );
        }
        scene.disk(Colour::Body, seen(at), self.r);
        for axis in 0..3 {
            // the near half of a great circle about each axis of inertia
            let circle: Vec<[f64; 3]> = turn(60)
                .map(|angle| {
                    let (s, c) = angle.sin_cos();
                    let mut point = [0.0; 3];
                    point[(axis + 1) % 3] = self.r * c;
                    point[(axis + 2) % 3] = self.r * s;
                    in_space(at, frame, point)
                })
                .collect();
            for pair in circle.windows(2) {
                let [a, b] = [pair[0], pair[1]];
                let near = towards([a[0] - at[0], a[1] - at[1], a[2] - at[2]]) > 0.0;
                let (colour, width) = if near { (Colour::Contact, 2.0) } else { (Colour::Faint, 1.0) };
                scene.line(colour, width, &[seen(a), seen(b)]);
            }
        }
    }
}

/// How far a vector points to who looks.
fn towards([x, y, z]: [f64; 3]) -> f64 {
    let away = y * 0.5_f64.cos() - x * 0.5_f64.sin();
    z * 0.5_f64.sin() - away * 0.5_f64.cos()
}

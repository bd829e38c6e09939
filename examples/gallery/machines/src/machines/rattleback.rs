use nonholonomic::prelude::*;

use crate::live::{Fault, Model, Slider};
use crate::scene::{Colour, Scene};
use crate::space::{cross, dot, in_space, seen, turn};

/// A rattleback: half an ellipsoid that rolls on a plane, with its mass not along its axes.
#[nonholonomic(
    base {
        /// The vertical, seen from the body.
        g[3],
        /// A direction on the table, seen from the body.
        e[3],
        /// The centre of mass over the table.
        x, y
    }
    on { dot(g, g) = 1; dot(e, e) = 1; dot(e, g) = 0; }
    basis { w[3], v[3] }
    anchor {
        for i in 0..3 {
            der(g[i]) = cross(g, w)[i];
            der(e[i]) = cross(e, w)[i];
        }
        der(x) = dot(e, v);
        der(y) = dot(cross(g, e), v);
    }
    brackets se(3) { w, v }
    lagrangian {
        // the centre of mass is h above the centre of the ellipsoid's bottom, whose height over the table is s
        let s = sqrt(a[0]^2 * g[0]^2 + a[1]^2 * g[1]^2 + a[2]^2 * g[2]^2);
        m / 2 * dot(v, v)
            + (I[0] * w[0]^2 + I[1] * w[1]^2 + I[2] * w[2]^2) / 2 + D * w[0] * w[1]
            - m * gravity * (s - h * g[2])
    }
    constraints {
        // the point of contact is at rest: r points from the centre of mass to it
        let s = sqrt(a[0]^2 * g[0]^2 + a[1]^2 * g[1]^2 + a[2]^2 * g[2]^2);
        let r = [-a[0]^2 * g[0] / s, -a[1]^2 * g[1] / s, h - a[2]^2 * g[2] / s];
        for i in 0..3 { v[i] = -cross(w, r)[i]; }
    }
    forces { for i in 0..3 { w[i]: -c * w[i]; } }
    assume { m > 0; I > 0; a > 0; }
    units { g, e = 1; x, y, a, h = m; w = s^-1; m = kg; I, D = kg m^2; gravity = m/s^2; c = N m s; }
    emit { latex }
)]
#[derive(Clone, Copy, Debug)]
pub struct Rattleback {
    pub m: f64,
    /// Moments of inertia about the axes of the ellipsoid, and the deviation moment (kg m²).
    pub I: [f64; 3],
    pub D: f64,
    /// Half the axes (m).
    pub a: [f64; 3],
    /// The centre of mass lies so far below the ellipsoid's centre (m).
    pub h: f64,
    pub gravity: f64,
    /// A little drag (N m s).
    pub c: f64,
}

impl Model for Rattleback {
    const TITLE: &'static str = "A rattleback";
    const TEXT: &'static str = "A stone with a will of its own: spun this way it begins to rattle, stops, and turns back; the other way \
        it goes on for much longer. Its axes of inertia are turned against those of its bottom: the slider's deviation moment.";
    const SOURCE: &'static str = include_str!("rattleback.rs");
    const DERIVED: &'static str = Self::REPORT;
    const TYPESET: &'static str = Self::LATEX;

    fn is_conservative(&self) -> bool {
        self.c == 0.0
    }

    fn start() -> (Self, RattlebackState) {
        let stone = Self {
            m: 1.0,
            I: [0.0002, 0.0016, 0.0017],
            D: -0.000_02,
            a: [0.2, 0.03, 0.02],
            h: 0.01,
            gravity: 9.81,
            c: 0.0,
        };
        let mut start = RattlebackState {
            g: [0.0087, 0.0087, 0.0],
            e: [1.0, 0.0, 0.0],
            w: [0.0, 0.0, -5.0],
            ..RattlebackState::default()
        };
        start.g[2] = (1.0 - start.g[0] * start.g[0] - start.g[1] * start.g[1]).sqrt();
        let along = start.g[0];
        start.e = [1.0 - along * start.g[0], -along * start.g[1], -along * start.g[2]];
        let length = dot(start.e, start.e).sqrt();
        start.e = start.e.map(|x| x / length);
        (stone, start)
    }

    fn sliders() -> Vec<Slider<Self>> {
        vec![
            Slider {
                label: "deviation moment (kg m²)",
                range: [-0.00006, 0.00006],
                get: |s| s.D,
                set: |s, x| s.D = x,
            },
            Slider { label: "drag (N m s)", range: [0.0, 0.0002], get: |s| s.c, set: |s, x| s.c = x },
        ]
    }

    fn after(&self, t: f64, tick: f64, state: &RattlebackState, (): ()) -> Result<RattlebackState, Fault> {
        let mut motion = Integrator::new(*self, Dopri5::new().rtol(1e-10).atol(1e-12), t, *state);
        motion.advance_to(t + tick)?;
        let mut state = *motion.state();
        // back onto the unit sphere of directions
        let _ = self.normalize(&mut state);
        Ok(state)
    }

    fn off_constraints(&self, _t: f64, state: &RattlebackState) -> Option<f64> {
        let (g, e) = (state.g, state.e);
        Some([dot(g, g) - 1.0, dot(e, e) - 1.0, dot(e, g)].map(f64::abs).into_iter().fold(0.0, f64::max))
    }

    fn pushed(&self, state: &RattlebackState, [right, up]: [f64; 2]) -> RattlebackState {
        let mut pushed = *state;
        pushed.w[2] += 5.0 * right;
        pushed.w[0] += 3.0 * up;
        pushed
    }

    fn view(&self, _state: &RattlebackState) -> ([f64; 2], f64) {
        ([0.0, 0.0], 0.2)
    }

    fn draw(&self, _t: f64, state: &RattlebackState, scene: &mut Scene) {
        let frame = [state.e, cross(state.g, state.e), state.g];
        let height = (0..3).map(|i| (self.a[i] * state.g[i]).powi(2)).sum::<f64>().sqrt();
        // the ellipsoid's centre; the stone is drawn where it spins, not where it wanders
        let at = [0.0, 0.0, height];
        for k in -4..=4 {
            let place = f64::from(k) * 0.08;
            scene.line(Colour::Faint, 1.0, &[seen([place, -0.32, 0.0]), seen([place, 0.32, 0.0])]);
            scene.line(Colour::Faint, 1.0, &[seen([-0.32, place, 0.0]), seen([0.32, place, 0.0])]);
        }
        let curve = |point: &dyn Fn(f64, f64) -> [f64; 3]| -> Vec<[f64; 2]> {
            turn(40)
                .map(|angle| {
                    let (s, c) = angle.sin_cos();
                    seen(in_space(at, frame, point(s, c)))
                })
                .collect()
        };
        let deck = curve(&|s, c| [self.a[0] * c, self.a[1] * s, 0.0]);
        scene.area(Colour::Body, &deck);
        for part in [-0.7_f64, 0.0, 0.7] {
            let rest = (1.0 - part * part).sqrt();
            let rib: Vec<[f64; 2]> = (0..=16)
                .map(|k| {
                    let (s, c) = (std::f64::consts::PI * f64::from(k) / 16.0).sin_cos();
                    let point = [self.a[0] * part, self.a[1] * rest * c, -self.a[2] * rest * s];
                    seen(in_space(at, frame, point))
                })
                .collect();
            scene.line(Colour::Contact, 1.5, &rib);
        }
        let tip = |x: f64| seen(in_space(at, frame, [x, 0.0, 0.0]));
        scene.line(Colour::Accent, 2.0, &[tip(0.0), tip(self.a[0])]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// When it first turns the other way, if it does so within a minute (s).
    fn turned_back(rate: f64) -> f64 {
        let (stone, mut state) = Rattleback::start();
        state.w[2] = rate;
        for tick in 0..6000 {
            state = stone.after(f64::from(tick) * 0.01, 0.01, &state, ()).expect("it moves");
            if state.w[2] * rate < 0.0 {
                return f64::from(tick) * 0.01;
            }
        }
        60.0
    }

    #[test]
    fn it_prefers_one_way() {
        let shown = Rattleback::start().1.w[2];
        let (way, back) = (turned_back(shown), turned_back(-shown));
        assert!(way < 10.0 && back > 2.0 * way, "after {way} s as shown, {back} s the other way round");
    }
}

use nonholonomic::prelude::*;

use crate::live::{Model, Slider};
use crate::scene::{Colour, Scene, placed};

/// A tractor with two trailers, each hitched to the axle before it.
#[nonholonomic(
    base   { x, y, th[3], delta }
    basis  { v, side, dth[3], ddelta }
    anchor {
        der(x) = v * cos(th[0]) - side * sin(th[0]);
        der(y) = v * sin(th[0]) + side * cos(th[0]);
        for i in 0..3 { der(th[i]) = dth[i]; }
        der(delta) = ddelta;
    }
    lagrangian {
        m / 2 * (v^2 + side^2) + sum(i in 0..3: J / 2 * dth[i]^2) + Js / 2 * ddelta^2
    }
    constraints {
        tractor: side = 0;
        steered: dth[0] = v * tan(delta) / wheelbase;
        first:   dth[1] = v * sin(th[0] - th[1]) / d;
        second:  dth[2] = v * cos(th[0] - th[1]) * sin(th[1] - th[2]) / d;
    }
    inputs { drive, turn }
    forces { v: drive; ddelta: turn; }
    assume { m > 0; J > 0; Js > 0; d > 0; wheelbase > 0; }
    units { x, y, d, wheelbase = m; th, delta = rad; m = kg; J, Js = kg m^2; drive = N; turn = N m; }
    emit { latex }
)]
#[derive(Clone, Copy, Debug)]
pub struct Trailers {
    pub m: f64,
    pub J: f64,
    pub Js: f64,
    pub d: f64,
    pub wheelbase: f64,
    /// The wanted bend of the last trailer's path (1/m).
    #[nh(skip)]
    pub bend: f64,
}

/// The speed that is kept (m/s): backwards.
const SPEED: f64 = -0.6;

impl Trailers {
    /// The steering that makes the last trailer follow a circle, from its bends to the front.
    fn wanted(&self, state: &TrailersState) -> f64 {
        let [tractor, first, second] = state.th;
        // the angle between neighbours on the circle, approached from behind
        let rest = (self.bend * self.d).clamp(-0.7, 0.7).asin();
        let (gamma_2, gamma_1) = (first - second, tractor - first);
        let wanted_1 = rest - 2.2 * (rest - gamma_2);
        let bend_1 = wanted_1.clamp(-0.9, 0.9).sin() / self.d;
        let wanted_0 = bend_1 * self.wheelbase - 2.8 * (wanted_1.clamp(-0.9, 0.9) - gamma_1);
        wanted_0.clamp(-0.9, 0.9)
    }
}

impl Model for Trailers {
    const TITLE: &'static str = "Backing up with two trailers";
    const TEXT: &'static str = "Backwards, every angle of a train of trailers runs away: the steering follows all of them, \
        forty times a second, to take the last trailer round a circle. Push it, and see it recover.";
    const SOURCE: &'static str = include_str!("trailers.rs");
    const DERIVED: &'static str = Self::REPORT;
    const TYPESET: &'static str = Self::LATEX;
    const CONSERVATIVE: bool = false;

    fn start() -> (Self, TrailersState) {
        let train = Self { m: 3.0, J: 0.05, Js: 0.01, d: 0.5, wheelbase: 0.35, bend: 0.3 };
        (train, TrailersState { v: SPEED, ..TrailersState::default() })
    }

    fn sliders() -> Vec<Slider<Self>> {
        vec![Slider {
            label: "bend of the path (1/m)",
            range: [-0.6, 0.6],
            get: |s| s.bend,
            set: |s, x| s.bend = x,
        }]
    }

    fn input(&self, _t: f64, state: &TrailersState) -> TrailersInput {
        let turn = 400.0 * self.Js * (self.wanted(state) - state.delta) - 40.0 * self.Js * state.ddelta;
        TrailersInput { drive: 6.0 * self.m * (SPEED - state.v), turn }
    }

    fn pushed(&self, state: &TrailersState, [right, up]: [f64; 2]) -> TrailersState {
        TrailersState { ddelta: state.ddelta + 3.0 * (right + up), ..*state }
    }

    fn traced(&self, state: &TrailersState) -> Option<[f64; 2]> {
        let first = placed([state.x, state.y], state.th[1], [-self.d, 0.0]);
        Some(placed(first, state.th[2], [-self.d, 0.0]))
    }

    fn view(&self, state: &TrailersState) -> ([f64; 2], f64) {
        ([state.x, state.y], 2.5)
    }

    fn draw(&self, _t: f64, state: &TrailersState, scene: &mut Scene) {
        let at = [state.x, state.y];
        scene.ground(at, 5.0, 0.5);
        let front = placed(at, state.th[0], [self.wheelbase, 0.0]);
        scene.block(
            Colour::Accent,
            placed(at, state.th[0], [self.wheelbase / 2.0, 0.0]),
            state.th[0],
            [0.25, 0.12],
        );
        scene.block(Colour::Contact, front, state.th[0] + state.delta, [0.08, 0.025]);
        let mut axle = at;
        for heading in [state.th[1], state.th[2]] {
            let next = placed(axle, heading, [-self.d, 0.0]);
            scene.line(Colour::Body, 2.0, &[axle, next]);
            scene.block(Colour::Body, next, heading, [0.2, 0.12]);
            for side in [-0.13, 0.13] {
                scene.block(Colour::Contact, placed(next, heading, [0.0, side]), heading, [0.06, 0.02]);
            }
            axle = next;
        }
    }
}

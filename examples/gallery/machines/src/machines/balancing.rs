use nalgebra::{SMatrix, SVector};
use nonholonomic::control::{Regulator, zero_order_hold};
use nonholonomic::prelude::*;

use crate::live::{Model, Slider};
use crate::scene::{Colour, Scene};

/// A robot that balances on two wheels, seen from the side.
#[nonholonomic(
    base   { x, tilt }
    lagrangian {
        // the centre of the body is l above the axle
        let ahead = der(x) + l * cos(tilt) * der(tilt);
        let up = -l * sin(tilt) * der(tilt);
        wheels / 2 * der(x)^2 + J / 2 * der(tilt)^2 + m / 2 * (ahead^2 + up^2) - m * g * l * cos(tilt)
    }
    inputs { torque }
    forces { x: torque / r; tilt: -torque; }
    assume { wheels > 0; m > 0; J > 0; r > 0; l > 0; }
    emit { jacobian, latex }
    units  { x, l, r = m; tilt = rad; wheels, m = kg; J = kg m^2; g = m/s^2; torque = N m; }
)]
#[derive(Clone, Copy, Debug)]
pub struct Balancing {
    /// Mass of the wheels, with what their turning adds (kg).
    pub wheels: f64,
    pub m: f64,
    pub J: f64,
    /// The height of the centre of the body above the axle (m).
    pub l: f64,
    /// The radius of the wheels (m).
    pub r: f64,
    pub g: f64,
    /// Where it should stand (m).
    #[nh(skip)]
    pub goal: f64,
}

impl Balancing {
    /// The feedback of a linear-quadratic regulator about standing upright.
    fn feedback(&self) -> Option<SMatrix<f64, 1, 4>> {
        let (a, b) = self.jacobian(0.0, &BalancingState::default(), &BalancingInput::default());
        let (a, b) = zero_order_hold(&a, &b, 1.0 / 120.0).ok()?;
        let q = SMatrix::<f64, 4, 4>::from_diagonal(&SVector::from([4.0, 4.0, 0.5, 0.2]));
        let r = SMatrix::<f64, 1, 1>::from_element(0.3);
        Regulator::stationary(&a, &b, &q, &r).ok().map(|regulator| regulator.gain)
    }
}

impl Model for Balancing {
    const TITLE: &'static str = "A robot that balances";
    const TEXT: &'static str = "A linear-quadratic regulator, computed from the emitted Jacobian whenever a slider moves, \
        holds a body upright above its wheels. Push it over; move its goal.";
    const SOURCE: &'static str = include_str!("balancing.rs");
    const DERIVED: &'static str = Self::REPORT;
    const TYPESET: &'static str = Self::LATEX;
    const CONSERVATIVE: bool = false;

    fn start() -> (Self, BalancingState) {
        let robot = Self { wheels: 1.2, m: 4.0, J: 0.09, l: 0.25, r: 0.08, g: 9.81, goal: 0.0 };
        (robot, BalancingState { tilt: 0.25, ..BalancingState::default() })
    }

    fn sliders() -> Vec<Slider<Self>> {
        vec![
            Slider { label: "goal (m)", range: [-1.0, 1.0], get: |s| s.goal, set: |s, x| s.goal = x },
            Slider { label: "height of the body (m)", range: [0.1, 0.6], get: |s| s.l, set: |s, x| s.l = x },
        ]
    }

    fn input(&self, _t: f64, state: &BalancingState) -> BalancingInput {
        let off = SVector::<f64, 4>::from([state.x - self.goal, state.tilt, state.x_dot, state.tilt_dot]);
        let torque = self.feedback().map_or(0.0, |gain| -(gain * off)[0]);
        BalancingInput { torque: torque.clamp(-6.0, 6.0) }
    }

    fn pushed(&self, state: &BalancingState, [right, up]: [f64; 2]) -> BalancingState {
        BalancingState { tilt_dot: state.tilt_dot + 2.0 * right, x_dot: state.x_dot + up, ..*state }
    }

    fn view(&self, _state: &BalancingState) -> ([f64; 2], f64) {
        ([0.0, 0.4], 0.8)
    }

    fn draw(&self, _t: f64, state: &BalancingState, scene: &mut Scene) {
        scene.line(Colour::Faint, 2.0, &[[-5.0, 0.0], [5.0, 0.0]]);
        scene.line(Colour::Track, 2.0, &[[self.goal, 0.0], [self.goal, -0.08]]);
        let axle = [state.x, self.r];
        let (sin, cos) = state.tilt.sin_cos();
        let top = [axle[0] + 2.0 * self.l * sin, axle[1] + 2.0 * self.l * cos];
        scene.line(Colour::Body, 14.0, &[axle, top]);
        scene.circle(Colour::Contact, 4.0, axle, self.r);
        let angle = state.x / self.r;
        scene.line(
            Colour::Accent,
            2.0,
            &[axle, [axle[0] + self.r * angle.sin(), axle[1] + self.r * angle.cos()]],
        );
    }
}

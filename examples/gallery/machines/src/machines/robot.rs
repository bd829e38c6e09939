use nonholonomic::prelude::*;

use crate::live::{Model, Slider};
use crate::scene::{Colour, Scene, placed};

/// A robot on two wheels with motors; its centre of mass is ahead of the axle.
#[nonholonomic(
    base   { x, y, theta, left, right }
    basis  { v, side, omega, dleft, dright }
    anchor {
        der(x) = v * cos(theta) - side * sin(theta);
        der(y) = v * sin(theta) + side * cos(theta);
        der(theta) = omega;
        der(left) = dleft;
        der(right) = dright;
    }
    lagrangian {
        m / 2 * (v^2 + (side + a * omega)^2) + J / 2 * omega^2 + Jw / 2 * (dleft^2 + dright^2)
    }
    constraints {
        blade: side = 0;
        roll_left: dleft = (v - b * omega) / r;
        roll_right: dright = (v + b * omega) / r;
    }
    inputs  { torque_left, torque_right }
    forces  { dleft: torque_left - c * dleft; dright: torque_right - c * dright; }
    assume  { m > 0; J > 0; Jw > 0; r > 0; }
    units   {
        x, y, a, b, r = m;
        theta, left, right = rad;
        m = kg;
        J, Jw = kg m^2;
        c = N m s;
        torque_left, torque_right = N m;
    }
    emit { latex }
)]
#[derive(Clone, Copy, Debug)]
pub struct Robot {
    pub m: f64,
    pub J: f64,
    pub Jw: f64,
    /// The centre of mass is so far ahead of the axle (m).
    pub a: f64,
    /// Half the distance between the wheels (m).
    pub b: f64,
    /// The radius of the wheels (m).
    pub r: f64,
    /// Friction of the motors (N m s).
    pub c: f64,
    /// The motors' torques, as the sliders set them (N m).
    #[nh(skip)]
    pub torques: [f64; 2],
}

impl Model for Robot {
    const TITLE: &'static str = "A robot on two wheels";
    const TEXT: &'static str = "Two motors drive the wheels; both roll without slipping, and three constraints leave two \
        of five velocities. The mass ahead of the axle pulls a turning robot forward. The energy changes by what \
        the motors do.";
    const SOURCE: &'static str = include_str!("robot.rs");
    const DERIVED: &'static str = Self::REPORT;
    const TYPESET: &'static str = Self::LATEX;
    const CONSERVATIVE: bool = false;

    fn start() -> (Self, RobotState) {
        let robot =
            Self { m: 5.0, J: 0.1, Jw: 0.002, a: 0.08, b: 0.15, r: 0.05, c: 0.004, torques: [0.10, 0.13] };
        (robot, RobotState { v: 0.3, ..RobotState::default() })
    }

    fn sliders() -> Vec<Slider<Self>> {
        vec![
            Slider {
                label: "left torque (N m)",
                range: [-0.3, 0.3],
                get: |s| s.torques[0],
                set: |s, torque| s.torques[0] = torque,
            },
            Slider {
                label: "right torque (N m)",
                range: [-0.3, 0.3],
                get: |s| s.torques[1],
                set: |s, torque| s.torques[1] = torque,
            },
            Slider {
                label: "centre of mass ahead, a (m)",
                range: [-0.1, 0.1],
                get: |s| s.a,
                set: |s, a| s.a = a,
            },
        ]
    }

    fn input(&self, _t: f64, _state: &RobotState) -> RobotInput {
        RobotInput { torque_left: self.torques[0], torque_right: self.torques[1] }
    }

    fn pushed(&self, state: &RobotState, [right, up]: [f64; 2]) -> RobotState {
        let (sin, cos) = state.theta.sin_cos();
        let (along, across) = (right * cos + up * sin, up * cos - right * sin);
        RobotState { v: state.v + along, omega: state.omega + 3.0 * across, ..*state }
    }

    fn traced(&self, state: &RobotState) -> Option<[f64; 2]> {
        Some([state.x, state.y])
    }

    fn view(&self, state: &RobotState) -> ([f64; 2], f64) {
        ([state.x, state.y], 1.2)
    }

    fn draw(&self, _t: f64, state: &RobotState, scene: &mut Scene) {
        let (at, heading) = ([state.x, state.y], state.theta);
        scene.ground(at, 2.4, 0.25);
        scene.block(Colour::Body, placed(at, heading, [self.a / 2.0, 0.0]), heading, [0.16, 0.12]);
        for (side, angle) in [(self.b, state.left), (-self.b, state.right)] {
            let wheel = placed(at, heading, [0.0, side]);
            scene.block(Colour::Contact, wheel, heading, [self.r, 0.018]);
            // a mark that goes round
            scene.disk(Colour::Accent, placed(wheel, heading, [self.r * angle.sin(), 0.0]), 0.015);
        }
    }
}

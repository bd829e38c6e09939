//! The sleigh and the robot in single and double precision: a thousand steps of each.
#![no_std]
#![forbid(unsafe_code)]

/// The models over one type of numbers.
macro_rules! models {
    ($module:ident, $float:ident) => {
        /// The models over one type of numbers.
        pub mod $module {
            use core::hint::black_box;

            use nh_runtime::prelude::*;

            /// A rigid body on a plane, carried by a knife edge (Chaplygin sleigh).
            #[nonholonomic(
                base   { theta, x, y }
                basis  { omega, v1, v2 }
                anchor {
                    der(theta) = omega;
                    der(x) = v1 * cos(theta) - v2 * sin(theta);
                    der(y) = v1 * sin(theta) + v2 * cos(theta);
                }
                lagrangian  { (J + m * (a^2 + b^2)) / 2 * omega^2 + m / 2 * (v1^2 + v2^2) - m * b * omega * v1 + m * a * omega * v2 }
                constraints { v2 = 0; }
                forces      { omega: torque - c * omega; }
                inputs      { torque }
            )]
            #[derive(Clone, Copy, Debug)]
            pub struct Sleigh { pub m: $float, pub J: $float, pub a: $float, pub b: $float, pub c: $float }

            /// A robot on two driven wheels, with its centre of mass ahead of the axle.
            #[nonholonomic(
                base { x, y, theta, phi_r, phi_l }
                lagrangian {
                    m / 2 * (der(x)^2 + der(y)^2)
                        + m * d * der(theta) * (cos(theta) * der(y) - sin(theta) * der(x))
                        + (J + m * d^2) / 2 * der(theta)^2
                        + I / 2 * (der(phi_r)^2 + der(phi_l)^2)
                }
                constraints {
                    der(x) = r / 2 * (der(phi_r) + der(phi_l)) * cos(theta);
                    der(y) = r / 2 * (der(phi_r) + der(phi_l)) * sin(theta);
                    der(theta) = r / (2 * b) * (der(phi_r) - der(phi_l));
                }
                forces { phi_r: right; phi_l: left; }
                inputs { right, left }
                assume { m > 0; J > 0; I > 0; b > 0; r > 0; }
            )]
            #[derive(Clone, Copy, Debug)]
            pub struct Robot {
                pub m: $float, pub J: $float, pub I: $float, pub b: $float, pub d: $float, pub r: $float,
            }

            const DT: $float = 0.02;

            /// The sleigh after so many steps; its parameters and start are not known to the compiler.
            #[inline(never)]
            pub fn run_sleigh(sleigh: &Sleigh, start: &SleighState, input: &SleighInput, steps: u32) -> SleighState {
                let mut state = *start;
                for _ in 0..steps {
                    state = Rk4::step(sleigh, 0.0, DT, &state, input);
                }
                state
            }

            /// The robot after so many steps.
            #[inline(never)]
            pub fn run_robot(robot: &Robot, start: &RobotState, input: &RobotInput, steps: u32) -> RobotState {
                let mut state = *start;
                for _ in 0..steps {
                    state = Rk4::step(robot, 0.0, DT, &state, input);
                }
                state
            }

            /// The scene of the sleigh.
            pub fn sleigh(steps: u32) -> [$float; 5] {
                let sleigh = Sleigh { m: 1.0, J: 0.5, a: 0.3, b: 0.1, c: 0.02 };
                let start = SleighState { theta: -0.4, x: 0.0, y: 0.0, omega: 0.15, v1: -1.0 };
                let input = SleighInput { torque: 0.01 };
                run_sleigh(
                    black_box(&sleigh), black_box(&start), black_box(&input), steps,
                )
                .into()
            }

            /// The scene of the robot.
            pub fn robot(steps: u32) -> [$float; 7] {
                let robot = Robot { m: 8.0, J: 0.3, I: 0.02, b: 0.2, d: 0.05, r: 0.1 };
                let start = RobotState::default();
                let input = RobotInput { right: 0.021, left: 0.02 };
                run_robot(
                    black_box(&robot), black_box(&start), black_box(&input), steps,
                )
                .into()
            }
        }
    };
}

models!(single, f32);
models!(double, f64);

/// How many steps the comparison takes.
pub const STEPS: u32 = 1000;

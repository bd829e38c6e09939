//! The sleigh and the robot in single and double precision: a thousand steps of each.
#![no_std]
#![forbid(unsafe_code)]

/// The models over one type of numbers.
macro_rules! models {
    ($module:ident, $float:ident) => {
        /// The models over one type of numbers.
        pub mod $module {
            use core::hint::black_box;

            use nonholonomic::prelude::*;

            nh_models::sleigh! {
                /// A rigid body on a plane, carried by a knife edge (Chaplygin sleigh).
                #[derive(Clone, Copy, Debug)]
                pub struct Sleigh { pub m: $float, pub J: $float, pub a: $float, pub b: $float, pub c: $float }
            }

            nh_models::driven_robot! {
                /// A robot on two driven wheels, with its centre of mass ahead of the axle.
                #[derive(Clone, Copy, Debug)]
                pub struct Robot {
                    pub m: $float, pub J: $float, pub I: $float, pub b: $float, pub d: $float, pub r: $float,
                }
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

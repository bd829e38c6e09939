//! The reference systems, each declared and written by hand. What other crates declare too is in [`nh_models`].
#![allow(non_snake_case, reason = "parameters are written as in mechanics: J, I, R, Omega")]

pub mod arm;
pub mod balancing_robot;
pub mod ball;
pub mod car;
pub mod chaplygin_ball;
pub mod four_bar;
pub mod hitched_trailer;
pub mod pendulum;
pub mod quadrotor;
pub mod robot;
pub mod roller_racer;
pub mod satellite;
pub mod sleigh;
pub mod snakeboard;
pub mod tractor;
pub mod veselova;

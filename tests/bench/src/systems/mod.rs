//! The reference systems, each declared and written by hand. What other crates declare too is in [`nh_models`].
#![allow(non_snake_case, reason = "parameters are written as in mechanics: J, I, R, Omega")]

pub mod arm;
pub mod balancing_robot;
pub mod ball;
pub mod ball_with_rotors;
pub mod car;
pub mod chaplygin_ball;
pub mod disk;
pub mod elbow;
pub mod finned_body;
pub mod five_bar;
pub mod four_bar;
pub mod four_wheels;
pub mod furuta;
pub mod heavy_top;
pub mod hitched_trailer;
pub mod leg;
pub mod off_axle;
pub mod pendulum;
pub mod quadrotor;
pub mod rattleback;
pub mod rear_steered;
pub mod robot;
pub mod roller_racer;
pub mod roller_walker;
pub mod satellite;
pub mod sleigh;
pub mod slider_crank;
pub mod snakeboard;
pub mod tractor;
pub mod veselova;

//! The reference systems in the declaration language, one file per mechanical system.
#![allow(non_snake_case, reason = "parameters are written as in mechanics: J, I, R, M")]

use crate::catalogue::{Entry, entry};
use crate::values::Values;

pub mod chaplygin_gyro;
pub mod chaplygin_sphere;
pub mod charged_particle;
pub mod frames;
pub mod free_rigid_body;
pub mod mobile_robot;
pub mod moving_constraints;
pub mod nonlinear;
pub mod particles;
pub mod rigid_body_rotor;
pub mod rolling_ball;
pub mod rotating_table;
pub mod sleigh;
pub mod snakeboard;
pub mod suslov;
pub mod vertical_disk;
pub mod veselova;

/// Every declared system that the reference data cover.
#[must_use]
pub fn catalogue() -> Vec<Box<dyn Entry>> {
    vec![
        entry::<free_rigid_body::FreeRigidBody>(),
        entry::<free_rigid_body::FreeRigidBodyByEntries>(),
        entry::<suslov::Suslov>(),
        entry::<suslov::SuslovAlongAxis>(),
        entry::<sleigh::Sleigh>(),
        entry::<sleigh::ReducedSleigh>(),
        entry::<sleigh::SleighOnThePlane>(),
        entry::<veselova::Veselova>(),
        entry::<veselova::VeselovaInEulerAngles>(),
        entry::<mobile_robot::MobileRobot>(),
        entry::<mobile_robot::MobileRobotOnThePlane>(),
        entry::<vertical_disk::VerticalDisk>(),
        entry::<vertical_disk::VerticalDiskMovingFrame>(),
        entry::<snakeboard::Snakeboard>(),
        entry::<snakeboard::SnakeboardOnThePlane>(),
        entry::<chaplygin_sphere::ChaplyginSphere>(),
        entry::<chaplygin_sphere::ChaplyginSphereWithAttitude>(),
        entry::<chaplygin_gyro::ChaplyginGyro>(),
        entry::<rigid_body_rotor::RigidBodyRotor>(),
        entry::<rigid_body_rotor::RigidBodyRotorAbsolute>(),
        entry::<particles::ParticleYCoframe>(),
        entry::<particles::ParticleY>(),
        entry::<particles::ParticleXCoframe>(),
        entry::<particles::ParticleX>(),
        entry::<particles::CentralForceAreal>(),
        entry::<particles::CentralForceCartesian>(),
        entry::<charged_particle::ChargedParticle>(),
        entry::<charged_particle::ChargedParticleCoframe>(),
        entry::<charged_particle::ChargedParticleOnTheBundle>(),
        entry::<rolling_ball::RollingBall>(),
        entry::<rotating_table::BallOnRotatingTable>(),
        entry::<rotating_table::BallOnRotatingTableCoframe>(),
        entry::<frames::SnakeboardBySpan>(),
        entry::<frames::ChargedParticleByConnection>(),
        entry::<frames::VeselovaOnSphere>(),
        entry::<frames::VeselovaOnRotations>(),
        entry::<frames::ChaplyginSphereOnSphere>(),
        entry::<moving_constraints::SleighOnBelt>(),
        entry::<moving_constraints::SteeredSleigh>(),
        entry::<moving_constraints::SteeredSleighOnThePlane>(),
        entry::<moving_constraints::PrescribedRobot>(),
        entry::<nonlinear::ParallelVelocities>(),
        entry::<nonlinear::ConstantSpeed>(),
        entry::<nonlinear::GrowingSpeed>(),
    ]
}

/// The inertia tensor from its six entries.
fn inertia(p: &Values) -> [[f64; 3]; 3] {
    [[p["I11"], p["I12"], p["I13"]], [p["I12"], p["I22"], p["I23"]], [p["I13"], p["I23"], p["I33"]]]
}

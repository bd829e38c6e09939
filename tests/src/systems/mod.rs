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

/// Hands every declared system that the reference data cover to a macro of the caller's, by modules: as `Name;`, or
/// as `Name, Twin;` where the adapted formulation has a projected twin.
#[macro_export]
macro_rules! every_system {
    ($each:ident) => {
        $each! {
            free_rigid_body {
                FreeRigidBody;
                FreeRigidBodyByEntries;
            }
            suslov {
                Suslov, ProjectedSuslov;
                SuslovAlongAxis, ProjectedSuslovAlongAxis;
            }
            sleigh {
                Sleigh, ProjectedSleigh;
                ReducedSleigh, ProjectedReducedSleigh;
                SleighOnThePlane;
            }
            veselova {
                Veselova;
                VeselovaInEulerAngles, ProjectedVeselovaInEulerAngles;
            }
            mobile_robot {
                MobileRobot, ProjectedMobileRobot;
                MobileRobotOnThePlane, ProjectedMobileRobotOnThePlane;
            }
            vertical_disk {
                VerticalDisk, ProjectedVerticalDisk;
                VerticalDiskMovingFrame, ProjectedVerticalDiskMovingFrame;
            }
            snakeboard {
                Snakeboard;
                SnakeboardOnThePlane;
            }
            chaplygin_sphere {
                ChaplyginSphere, ProjectedChaplyginSphere;
                ChaplyginSphereWithAttitude, ProjectedChaplyginSphereWithAttitude;
            }
            chaplygin_gyro {
                ChaplyginGyro, ProjectedChaplyginGyro;
            }
            rigid_body_rotor {
                RigidBodyRotor;
                RigidBodyRotorAbsolute;
            }
            particles {
                ParticleYCoframe, ProjectedParticleYCoframe;
                ParticleY, ProjectedParticleY;
                ParticleXCoframe, ProjectedParticleXCoframe;
                ParticleX, ProjectedParticleX;
                CentralForceAreal;
                CentralForceCartesian;
            }
            charged_particle {
                ChargedParticle;
                ChargedParticleCoframe;
                ChargedParticleOnTheBundle;
            }
            rolling_ball {
                RollingBall, ProjectedRollingBall;
            }
            rotating_table {
                BallOnRotatingTable, ProjectedBallOnRotatingTable;
                BallOnRotatingTableCoframe, ProjectedBallOnRotatingTableCoframe;
            }
            frames {
                SnakeboardBySpan;
                ChargedParticleByConnection;
                VeselovaOnSphere;
                VeselovaOnRotations;
                ChaplyginSphereOnSphere, ProjectedChaplyginSphereOnSphere;
            }
            moving_constraints {
                SleighOnBelt, ProjectedSleighOnBelt;
                SteeredSleigh, ProjectedSteeredSleigh;
                SteeredSleighOnThePlane;
                PrescribedRobot, ProjectedPrescribedRobot;
            }
            nonlinear {
                ParallelVelocities;
                ConstantSpeed;
                GrowingSpeed;
            }
        }
    };
}

/// Every declared system that the reference data cover.
#[must_use]
pub fn catalogue() -> Vec<Box<dyn Entry>> {
    macro_rules! entries {
        ($($module:ident { $($name:ident $(, $twin:ident)?;)* })*) => { vec![$($(entry::<$module::$name>(),)*)*] };
    }
    every_system!(entries)
}

/// The inertia tensor from its six entries.
fn inertia(p: &Values) -> [[f64; 3]; 3] {
    [[p["I11"], p["I12"], p["I13"]], [p["I12"], p["I22"], p["I23"]], [p["I13"], p["I23"], p["I33"]]]
}

//! What accuracy costs for every reference system, in both formulations where there are two:
//! `cargo run --release -p nh-work-precision --features catalogue --bin catalogue [name …]`.
//!
//! Each runs from the start of a trajectory of the reference data to its end; systems with inputs get those
//! of the data. A name is that of a declaration in `tests/src/systems`.

use std::any::type_name;
use std::rc::Rc;

use nh_runtime::Dim;
use nh_runtime::prelude::*;
use nh_tests::catalogue::{Catalogued, Values};
use nh_tests::reference::{ParameterSet, System};
use nh_tests::systems::{
    chaplygin_gyro, chaplygin_sphere, charged_particle, frames, free_rigid_body, mobile_robot,
    moving_constraints, nonlinear, particles, rigid_body_rotor, rolling_ball, rotating_table, sleigh,
    snakeboard, suslov, vertical_disk, veselova,
};
use nh_work_precision::Study;

/// A system whose inputs are the reference data's functions of time.
#[derive(Clone)]
struct Driven<S> {
    system: S,
    values: Rc<Values>,
}

impl<S: Catalogued> Dynamics for Driven<S> {
    type State = S::State;
    type Input = ();

    fn derivative(&self, t: f64, state: &S::State, (): &()) -> S::State {
        self.system.derivative(t, state, &S::input(&self.values, t))
    }

    fn validate(&self) -> Result<(), ParameterError> {
        self.system.validate()
    }
}

/// Adds a declaration to the study of its motion.
fn vary<S: Catalogued + Clone + 'static>(study: &mut Study, formulation: &str, set: &ParameterSet) {
    let driven = Driven { system: S::parameters(&set.values), values: Rc::new(set.values.clone()) };
    let Some(first) = set.trajectories.first().and_then(|samples| samples.first()) else { return };
    let mut start = <<S::State as State>::Dim as Dim>::vec(0.0);
    for (number, component) in start.as_mut().iter_mut().zip(S::state(&first.state)) {
        *number = component.value;
    }
    study.variant(formulation, driven, S::State::from_array(start)).explicit().implicit();
}

/// The study of a declaration's motion with ordinary parameters.
fn motion<S: Catalogued>() -> Option<(Study, ParameterSet)> {
    let set = System::read(S::REFERENCE).parameter_sets.into_iter().find(|set| {
        let has_motion = set.trajectories.first().is_some_and(|samples| samples.len() > 1);
        !set.extreme && S::covers(&set.values) && has_motion
    })?;
    let samples = set.trajectories.first()?;
    let (from, to) = (samples.first()?.t, samples.last()?.t);
    Some((Study::new(name_of::<S>(), from, to), set))
}

fn name_of<S>() -> &'static str {
    let path = type_name::<S>();
    path.rsplit("::").next().unwrap_or(path)
}

/// A declaration's name, and how its study is made.
type Maker = (&'static str, fn() -> Option<Study>);

macro_rules! studies {
    ($($adapted:path $(, $projected:path)?;)*) => {
        [$((name_of::<$adapted>(), || {
            let (mut study, set) = motion::<$adapted>()?;
            vary::<$adapted>(&mut study, "as declared", &set);
            $(vary::<$projected>(&mut study, "projected", &set);)?
            Some(study)
        })),*]
    };
}

/// Every declaration of the catalogue, with its projected twin.
fn all() -> [Maker; 44] {
    studies! {
        free_rigid_body::FreeRigidBody;
        free_rigid_body::FreeRigidBodyByEntries;
        suslov::Suslov, suslov::ProjectedSuslov;
        suslov::SuslovAlongAxis, suslov::ProjectedSuslovAlongAxis;
        sleigh::Sleigh, sleigh::ProjectedSleigh;
        sleigh::ReducedSleigh, sleigh::ProjectedReducedSleigh;
        sleigh::SleighOnThePlane;
        veselova::Veselova;
        veselova::VeselovaInEulerAngles, veselova::ProjectedVeselovaInEulerAngles;
        mobile_robot::MobileRobot, mobile_robot::ProjectedMobileRobot;
        mobile_robot::MobileRobotOnThePlane, mobile_robot::ProjectedMobileRobotOnThePlane;
        vertical_disk::VerticalDisk, vertical_disk::ProjectedVerticalDisk;
        vertical_disk::VerticalDiskMovingFrame, vertical_disk::ProjectedVerticalDiskMovingFrame;
        snakeboard::Snakeboard;
        snakeboard::SnakeboardOnThePlane;
        chaplygin_sphere::ChaplyginSphere, chaplygin_sphere::ProjectedChaplyginSphere;
        chaplygin_sphere::ChaplyginSphereWithAttitude, chaplygin_sphere::ProjectedChaplyginSphereWithAttitude;
        chaplygin_gyro::ChaplyginGyro, chaplygin_gyro::ProjectedChaplyginGyro;
        rigid_body_rotor::RigidBodyRotor;
        rigid_body_rotor::RigidBodyRotorAbsolute;
        particles::ParticleYCoframe, particles::ProjectedParticleYCoframe;
        particles::ParticleY, particles::ProjectedParticleY;
        particles::ParticleXCoframe, particles::ProjectedParticleXCoframe;
        particles::ParticleX, particles::ProjectedParticleX;
        particles::CentralForceAreal;
        particles::CentralForceCartesian;
        charged_particle::ChargedParticle;
        charged_particle::ChargedParticleCoframe;
        charged_particle::ChargedParticleOnTheBundle;
        rolling_ball::RollingBall, rolling_ball::ProjectedRollingBall;
        rotating_table::BallOnRotatingTable, rotating_table::ProjectedBallOnRotatingTable;
        rotating_table::BallOnRotatingTableCoframe, rotating_table::ProjectedBallOnRotatingTableCoframe;
        frames::SnakeboardBySpan;
        frames::ChargedParticleByConnection;
        frames::VeselovaOnSphere;
        frames::VeselovaOnRotations;
        frames::ChaplyginSphereOnSphere, frames::ProjectedChaplyginSphereOnSphere;
        moving_constraints::SleighOnBelt, moving_constraints::ProjectedSleighOnBelt;
        moving_constraints::SteeredSleigh, moving_constraints::ProjectedSteeredSleigh;
        moving_constraints::SteeredSleighOnThePlane;
        moving_constraints::PrescribedRobot, moving_constraints::ProjectedPrescribedRobot;
        nonlinear::ParallelVelocities;
        nonlinear::ConstantSpeed;
        nonlinear::GrowingSpeed;
    }
}

fn main() -> std::io::Result<()> {
    let wanted: Vec<String> = std::env::args().skip(1).collect();
    for (name, make) in all() {
        if (wanted.is_empty() || wanted.iter().any(|one| one == name))
            && let Some(study) = make()
        {
            study.finish()?;
        }
    }
    Ok(())
}

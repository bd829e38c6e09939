//! Reductions between declared systems: proved by `morphism!`, and seen on trajectories.

use nh_runtime::{ByStages, prelude::*};
use nh_tests::systems::sleigh::{ReducedSleigh, SleighOnThePlane};

/// The sleigh in the frame of its body.
#[nonholonomic(
    base   { theta, x, y }
    basis  { omega, v1, v2 }
    anchor {
        der(theta) = omega;
        der(x) = v1 * cos(theta) - v2 * sin(theta);
        der(y) = v1 * sin(theta) + v2 * cos(theta);
    }
    lagrangian  { (J + m * (a^2 + b^2)) / 2 * omega^2 + m / 2 * (v1^2 + v2^2) - m * b * omega * v1 + m * a * omega * v2 }
    constraints { blade: v2 = 0; }
)]
#[derive(Clone, Copy, Debug)]
pub struct SleighInItsFrame {
    pub m: f64,
    pub J: f64,
    pub a: f64,
    pub b: f64,
}

morphism! { nh_tests::systems::sleigh::SleighOnThePlane -> nh_tests::systems::sleigh::ReducedSleigh {
    velocities {
        omega = der(theta);
        v1 = cos(theta) * der(x) + sin(theta) * der(y);
        v2 = -sin(theta) * der(x) + cos(theta) * der(y);
    }
} }

morphism! { nh_tests::systems::sleigh::SleighOnThePlane -> SleighInItsFrame {
    velocities {
        omega = der(theta);
        v1 = cos(theta) * der(x) + sin(theta) * der(y);
        v2 = -sin(theta) * der(x) + cos(theta) * der(y);
    }
} }

morphism! { SleighInItsFrame -> nh_tests::systems::sleigh::ReducedSleigh {} }

#[test]
fn sleigh() {
    println!("{}", <SleighOnThePlane as Reduction<ReducedSleigh>>::REPORT);
}

//! A map from a system that another crate declares.

use nh_tests::systems::{self, sleigh::SleighOnThePlaneState};
use nonholonomic::prelude::*;

use super::support::reconstructs;

/// The sleigh on se(2), with its velocities in another order.
#[nonholonomic(
    basis { v1, v2, omega }
    brackets se(2) { omega, v1, v2 }
    lagrangian  { (J + m * (a^2 + b^2)) / 2 * omega^2 + m / 2 * (v1^2 + v2^2) - m * b * omega * v1 + m * a * omega * v2 }
    constraints { blade: v2 = 0; }
)]
#[derive(Clone, Copy, Debug)]
struct Here {
    m: f64,
    J: f64,
    a: f64,
    b: f64,
}

morphism! { systems::sleigh::SleighOnThePlane -> Here {
    velocities {
        omega = der(theta);
        v1 = cos(theta) * der(x) + sin(theta) * der(y);
        v2 = cos(theta) * der(y) - sin(theta) * der(x);
    }
} }

#[test]
fn a_system_of_another_crate() {
    let sleigh = systems::sleigh::SleighOnThePlane { m: 1.3, J: 0.7, a: 0.4, b: -0.2 };
    let (sin, cos) = 0.6_f64.sin_cos();
    let start = SleighOnThePlaneState {
        theta: 0.6,
        x: 0.3,
        y: -0.2,
        theta_dot: 1.2,
        x_dot: 0.9 * cos,
        y_dot: 0.9 * sin,
    };
    reconstructs::<_, Here>(&sleigh, start, ());
}

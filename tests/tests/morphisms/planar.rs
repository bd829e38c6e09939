//! Bodies on a plane, reduced by its motions.

use nonholonomic::{ByStages, prelude::*};

use super::support::{assert_close, reconstructs, reduces};

/// A sleigh in the coordinates of the plane: no choice of two velocities is good everywhere.
#[nonholonomic(
    base { theta, x, y }
    lagrangian {
        let xc = der(x) - (a * sin(theta) + b * cos(theta)) * der(theta);
        let yc = der(y) + (a * cos(theta) - b * sin(theta)) * der(theta);
        J / 2 * der(theta)^2 + m / 2 * (xc^2 + yc^2)
    }
    constraints { blade: cos(theta) * der(y) - sin(theta) * der(x) = 0; }
    forces { theta: torque - c * der(theta); }
    inputs { torque }
)]
#[derive(Clone, Copy, Debug)]
struct PlaneSleigh<T> {
    m: T,
    J: T,
    a: T,
    b: T,
    c: T,
}

/// In the frame of its body.
#[nonholonomic(
    base   { theta, x, y }
    basis  { omega, v[2] }
    anchor {
        der(theta) = omega;
        der(x) = v[0] * cos(theta) - v[1] * sin(theta);
        der(y) = v[0] * sin(theta) + v[1] * cos(theta);
    }
    lagrangian  { (J + m * (a^2 + b^2)) / 2 * omega^2 + m / 2 * dot(v, v) - m * omega * (b * v[0] - a * v[1]) }
    constraints { v[1] = 0; }
    forces { omega: push / 2 - c * omega; }
    inputs { push }
)]
#[derive(Clone, Copy, Debug)]
struct FramedSleigh<S> {
    m: S,
    J: S,
    a: S,
    b: S,
    c: S,
}

/// On se(2): Euler, Poincaré and Suslov. `I` is about the point of contact.
#[nonholonomic(
    basis { omega, v1, v2 }
    brackets se(2) { omega, v1, v2 }
    lagrangian  { I / 2 * omega^2 + m / 2 * (v1^2 + v2^2) - m * b * omega * v1 + m * a * omega * v2 }
    constraints { v2 = 0; }
    forces { omega: push / 2 - c * omega; }
    inputs { push }
)]
#[derive(Clone, Copy, Debug)]
struct AlgebraSleigh {
    m: f64,
    I: f64,
    a: f64,
    b: f64,
    c: f64,
}

morphism! { PlaneSleigh -> FramedSleigh {
    velocities {
        omega = der(theta);
        v[0] = cos(theta) * der(x) + sin(theta) * der(y);
        v[1] = cos(theta) * der(y) - sin(theta) * der(x);
    }
    inputs { push = 2 * torque; }
} }

morphism! { FramedSleigh -> AlgebraSleigh {
    parameters { I = J + m * (a^2 + b^2); }
    velocities { v1 = v[0]; v2 = v[1]; }
} }

morphism! { PlaneSleigh -> AlgebraSleigh {
    parameters { I = J + m * (a^2 + b^2); }
    velocities {
        omega = der(theta);
        v1 = cos(theta) * der(x) + sin(theta) * der(y);
        v2 = cos(theta) * der(y) - sin(theta) * der(x);
    }
    inputs { push = 2 * torque; }
} }

const SLEIGH: PlaneSleigh<f64> = PlaneSleigh { m: 1.3, J: 0.7, a: 0.4, b: -0.2, c: 0.1 };

fn sleigh_start() -> PlaneSleighState<f64> {
    let (sin, cos) = 0.6_f64.sin_cos();
    PlaneSleighState { theta: 0.6, x: 0.3, y: -0.2, theta_dot: 1.2, x_dot: 0.9 * cos, y_dot: 0.9 * sin }
}

#[test]
fn sleigh_to_its_algebra() {
    let push = PlaneSleighInput { torque: 0.25 };
    reconstructs::<_, FramedSleigh<f64>>(&SLEIGH, sleigh_start(), push);
    reconstructs::<_, AlgebraSleigh>(&SLEIGH, sleigh_start(), push);
    let framed: FramedSleigh<f64> = SLEIGH.reduced();
    let start = Reduction::<FramedSleigh<f64>>::reduce(&SLEIGH, 0.0, &sleigh_start());
    reconstructs::<_, AlgebraSleigh>(&framed, start, FramedSleighInput { push: 0.5 });
}

#[test]
fn sleigh_by_stages() {
    let state = sleigh_start();
    let push = PlaneSleighInput { torque: 0.25 };
    let stages = ByStages::<_, FramedSleigh<f64>>::new(SLEIGH);
    let direct: AlgebraSleigh = SLEIGH.reduced();
    let by_stages: AlgebraSleigh = stages.reduced();
    assert!((direct.I - by_stages.I).abs() < 1e-15);
    let one = Reduction::<AlgebraSleigh>::reduce(&SLEIGH, 0.0, &state);
    let two = Reduction::<AlgebraSleigh>::reduce(&stages, 0.0, &state);
    assert_close(&one, &two, 1e-15);
    let one: AlgebraSleighInput = Reduction::<AlgebraSleigh>::reduce_input(&SLEIGH, 0.0, &state, &push);
    let two: AlgebraSleighInput = Reduction::<AlgebraSleigh>::reduce_input(&stages, 0.0, &state, &push);
    assert_eq!(one, two);
    reduces::<_, AlgebraSleigh>(&stages, state, push);
}

#[test]
fn what_was_proved_is_told() {
    let report = <PlaneSleigh<f64> as Reduction<AlgebraSleigh>>::REPORT;
    assert!(report.contains("an isomorphism on every fibre (rank 3 to 3)"), "{report}");
    assert!(report.contains("v2 = cos(theta)*y_dot - x_dot*sin(theta)"), "{report}");
    assert!(
        report.contains("Dropped coordinates, which follow from the reduced motion: theta, x, y."),
        "{report}"
    );
    assert!(report.contains("x' = cos(theta)*v1"), "{report}");
}

/// A robot with two wheels, in the coordinates of the plane.
#[nonholonomic(
    base { psi1, psi2, x, y, theta }
    lagrangian {
        let lateral = -der(x) * sin(theta) + der(y) * cos(theta);
        m / 2 * (der(x)^2 + der(y)^2) + m0 * l * lateral * der(theta)
            + J / 2 * der(theta)^2 + J2 / 2 * (der(psi1)^2 + der(psi2)^2)
    }
    constraints {
        der(x) = -R / 2 * (der(psi1) + der(psi2)) * cos(theta);
        der(y) = -R / 2 * (der(psi1) + der(psi2)) * sin(theta);
        der(theta) = R / (2 * c) * (der(psi2) - der(psi1));
    }
    forces { psi1: torque[0]; psi2: torque[1]; }
    inputs { torque[2] }
)]
#[derive(Clone, Copy, Debug)]
struct PlaneRobot {
    m: f64,
    m0: f64,
    l: f64,
    J: f64,
    J2: f64,
    c: f64,
    R: f64,
}

/// On TQ/SE(2), the Atiyah algebroid.
#[nonholonomic(
    base  { psi1, psi2 }
    basis { dpsi1, dpsi2, w1, w2, w3 }
    anchor { der(psi1) = dpsi1; der(psi2) = dpsi2; }
    brackets se(2) { w3, w1, w2 }
    lagrangian { m / 2 * (w1^2 + w2^2) + m0 * l * w2 * w3 + J / 2 * w3^2 + J2 / 2 * (dpsi1^2 + dpsi2^2) }
    constraints {
        lateral: w2 = 0;
        wheel1: w1 + c * w3 + R * dpsi1 = 0;
        wheel2: w1 - c * w3 + R * dpsi2 = 0;
    }
    forces { dpsi1: torque[0]; dpsi2: torque[1]; }
    inputs { torque[2] }
)]
#[derive(Clone, Copy, Debug)]
struct AtiyahRobot {
    m: f64,
    m0: f64,
    l: f64,
    J: f64,
    J2: f64,
    c: f64,
    R: f64,
}

/// The wheels alone, in their own velocities: reduced once more, since nothing depends on their angles.
#[nonholonomic(
    basis { dpsi1, dpsi2, w1, w2, w3 }
    brackets se(2) { w3, w1, w2 }
    lagrangian { m / 2 * (w1^2 + w2^2) + m0 * l * w2 * w3 + J / 2 * w3^2 + J2 / 2 * (dpsi1^2 + dpsi2^2) }
    distribution { left, right }
    frame {
        left = dpsi1 - R / 2 * w1 - R / (2 * c) * w3;
        right = dpsi2 - R / 2 * w1 + R / (2 * c) * w3;
    }
    forces { left: torque[0]; right: torque[1]; }
    inputs { torque[2] }
)]
#[derive(Clone, Copy, Debug)]
struct SpannedRobot {
    m: f64,
    m0: f64,
    l: f64,
    J: f64,
    J2: f64,
    c: f64,
    R: f64,
}

morphism! { PlaneRobot -> AtiyahRobot {
    velocities {
        dpsi1 = der(psi1);
        dpsi2 = der(psi2);
        w1 = cos(theta) * der(x) + sin(theta) * der(y);
        w2 = -sin(theta) * der(x) + cos(theta) * der(y);
        w3 = der(theta);
    }
} }

morphism! { AtiyahRobot -> SpannedRobot {} }

#[test]
fn robot() {
    let robot = PlaneRobot { m: 3.0, m0: 2.5, l: 0.2, J: 0.9, J2: 0.05, c: 0.3, R: 0.15 };
    let start =
        PlaneRobotState { psi1: 0.1, psi2: -0.2, x: 1.0, y: 2.0, theta: 0.7, psi1_dot: 2.0, psi2_dot: -3.0 };
    let drive = PlaneRobotInput { torque: [0.3, -0.1] };
    reconstructs::<_, AtiyahRobot>(&robot, start, drive);
    let atiyah: AtiyahRobot = robot.reduced();
    let drive = AtiyahRobotInput { torque: [0.3, -0.1] };
    reconstructs::<_, SpannedRobot>(&atiyah, robot.reduce(0.0, &start), drive);
}

//! Sleighs that are tilted, carried along or steered; a robot and a bicycle with prescribed rates.
#![allow(non_snake_case, reason = "parameters are written as in mechanics: J, I, R, Omega")]

use nonholonomic::prelude::*;

use super::{check, check_with_multipliers};

/// A skate on an inclined plane.
#[nonholonomic(
    base { x, y, theta }
    lagrangian {
        m/2*((der(x)-a*sin(theta)*der(theta))^2 + (der(y)+a*cos(theta)*der(theta))^2) + J/2*der(theta)^2
            - m*g*sin(al)*(x + a*cos(theta))
    }
    constraints { blade: -der(x)*sin(theta) + der(y)*cos(theta) = 0 }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct Skate {
    m: f64,
    J: f64,
    a: f64,
    g: f64,
    al: f64,
}

/// The same in the frame of the blade.
#[nonholonomic(
    base { x, y, theta }
    basis { v1, v2, omega }
    anchor {
        der(x) = v1*cos(theta) - v2*sin(theta);
        der(y) = v1*sin(theta)+v2*cos(theta);
        der(theta) = omega
    }
    lagrangian { m/2*(v1^2 + (v2 + a*omega)^2) + J/2*omega^2 - m*g*sin(al)*(x + a*cos(theta)) }
    constraints { v2 = 0 }
)]
#[derive(Clone, Copy, Debug)]
struct SkateFrame {
    m: f64,
    J: f64,
    a: f64,
    g: f64,
    al: f64,
}

/// A sleigh on a moving belt: an affine constraint.
#[nonholonomic(
    base { x, y, theta }
    lagrangian {
        m/2*((der(x)-a*sin(theta)*der(theta))^2 + (der(y)+a*cos(theta)*der(theta))^2) + J/2*der(theta)^2
    }
    constraints { blade: -(der(x)-u)*sin(theta) + der(y)*cos(theta) = 0 }
    forces { theta: -c*der(theta) }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct Belt {
    m: f64,
    J: f64,
    a: f64,
    c: f64,
    u: f64,
}

/// The same in the frame of the blade, over any scalar, with friction from a method.
#[nonholonomic(
    base { x, y, theta }
    basis { v1, v2, omega }
    anchor {
        der(x) = v1*cos(theta) - v2*sin(theta);
        der(y) = v1*sin(theta)+v2*cos(theta);
        der(theta) = omega
    }
    lagrangian { m/2*(v1^2 + (v2 + a*omega)^2) + J/2*omega^2 }
    constraints { v2 = -u*sin(theta) }
    forces { omega: self.friction(omega) }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct BeltGeneric<T> {
    m: T,
    J: T,
    a: T,
    c: T,
    u: T,
}

impl<T: Scalar> BeltGeneric<T> {
    fn friction(&self, omega: T) -> T {
        -(self.c * omega)
    }
}

/// A sleigh whose blade is steered in time.
#[nonholonomic(
    base { x, y, theta }
    lagrangian {
        m/2*((der(x)-a*sin(theta)*der(theta))^2 + (der(y)+a*cos(theta)*der(theta))^2) + J/2*der(theta)^2
    }
    constraints { blade: -der(x)*sin(theta + e*sin(2*t)) + der(y)*cos(theta + e*sin(2*t)) = 0 }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct Steered {
    m: f64,
    J: f64,
    a: f64,
    e: f64,
}

/// The same in the frame of the body.
#[nonholonomic(
    base { x, y, theta }
    basis { v1, v2, omega }
    anchor {
        der(x) = v1*cos(theta) - v2*sin(theta);
        der(y) = v1*sin(theta)+v2*cos(theta);
        der(theta) = omega
    }
    lagrangian { m/2*(v1^2 + (v2 + a*omega)^2) + J/2*omega^2 }
    constraints { v2 = tan(e*sin(2*t))*v1 }
)]
#[derive(Clone, Copy, Debug)]
struct SteeredFrame {
    m: f64,
    J: f64,
    a: f64,
    e: f64,
}

/// A robot one of whose wheels turns at a prescribed, varying speed.
#[nonholonomic(
    base { x, y, theta, psi1, psi2 }
    lagrangian {
        m/2*((der(x)-a*sin(theta)*der(theta))^2 + (der(y)+a*cos(theta)*der(theta))^2) + J/2*der(theta)^2
            + 1/20*(der(psi1)^2+der(psi2)^2)
    }
    constraints {
        side: -der(x)*sin(theta) + der(y)*cos(theta) = 0;
        left: der(x)*cos(theta)+der(y)*sin(theta) - c*der(theta) - R*der(psi1) = 0;
        right: der(x)*cos(theta)+der(y)*sin(theta) + c*der(theta) - R*der(psi2) = 0;
        motor: der(psi1) = 1 + sin(t)/2;
    }
    forces { psi2: u }
    inputs { u }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct Robot {
    m: f64,
    J: f64,
    a: f64,
    c: f64,
    R: f64,
}

/// The same in the frame of the robot.
#[nonholonomic(
    base { x, y, theta, psi1, psi2 }
    basis { v1, v2, omega, dpsi1, dpsi2 }
    anchor {
        der(x) = v1*cos(theta) - v2*sin(theta);
        der(y) = v1*sin(theta)+v2*cos(theta);
        der(theta) = omega;
        der(psi1) = dpsi1;
        der(psi2) = dpsi2
    }
    lagrangian { m/2*(v1^2 + (v2 + a*omega)^2) + J/2*omega^2 + 1/20*(dpsi1^2+dpsi2^2) }
    constraints { v2 = 0; v1 - c*omega = R*dpsi1; v1 + c*omega = R*dpsi2; dpsi1 = 1 + sin(t)/2; }
    forces { dpsi2: u }
    inputs { u }
)]
#[derive(Clone, Copy, Debug)]
struct RobotFrame {
    m: f64,
    J: f64,
    a: f64,
    c: f64,
    R: f64,
}

/// A planar bicycle whose front wheel is steered at a prescribed rate; the fork has no inertia.
#[nonholonomic(
    base { x, y, theta, delta }
    lagrangian {
        3/4*((der(x)-b*sin(theta)*der(theta))^2 + (der(y)+b*cos(theta)*der(theta))^2) + 1/5*der(theta)^2
    }
    constraints {
        -der(x)*sin(theta) + der(y)*cos(theta) = 0;
        -der(x)*sin(theta+delta) + der(y)*cos(theta+delta) + l*der(theta)*cos(delta) = 0;
        der(delta) = cos(t)/2;
    }
    forces { x: u*cos(theta); y: u*sin(theta) }
    inputs { u }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct Bicycle {
    b: f64,
    l: f64,
}

/// The same in the frame of the bicycle.
#[nonholonomic(
    base { x, y, theta, delta }
    basis { v, v2, omega, rate }
    anchor {
        der(x) = v*cos(theta)-v2*sin(theta);
        der(y) = v*sin(theta)+v2*cos(theta);
        der(theta) = omega;
        der(delta) = rate
    }
    lagrangian { 3/4*(v^2 + (v2 + b*omega)^2) + 1/5*omega^2 }
    constraints { v2 = 0; omega = v*tan(delta)/l; rate = cos(t)/2 }
    forces { v: u }
    inputs { u }
)]
#[derive(Clone, Copy, Debug)]
struct BicycleFrame {
    b: f64,
    l: f64,
}

#[test]
fn sleighs_robots_and_bicycles() {
    let system = Skate { m: 1.3, J: 0.4, a: 0.3, g: 9.81, al: 0.35 };
    check_with_multipliers("skate", &system, (), |t, x| system.multipliers(t, x, &()));
    check("skate", &SkateFrame { m: 1.3, J: 0.4, a: 0.3, g: 9.81, al: 0.35 }, ());
    let system = Belt { m: 1.3, J: 0.4, a: 0.3, c: 0.2, u: 0.6 };
    check_with_multipliers("belt", &system, (), |t, x| system.multipliers(t, x, &()));
    let system = BeltGeneric { m: 1.3, J: 0.4, a: 0.3, c: 0.2, u: 0.6 };
    check_with_multipliers("belt", &system, (), |t, x| system.multipliers(t, x, &()));
    let system = Steered { m: 1.3, J: 0.4, a: 0.3, e: 0.5 };
    check_with_multipliers("steered", &system, (), |t, x| system.multipliers(t, x, &()));
    check("steered", &SteeredFrame { m: 1.3, J: 0.4, a: 0.3, e: 0.5 }, ());
    let system = Robot { m: 1.3, J: 0.4, a: 0.3, c: 0.4, R: 0.2 };
    let input = RobotInput { u: 0.3 };
    check_with_multipliers("robot", &system, input, |t, x| system.multipliers(t, x, &input));
    check("robot", &RobotFrame { m: 1.3, J: 0.4, a: 0.3, c: 0.4, R: 0.2 }, RobotFrameInput { u: 0.3 });
    let system = Bicycle { b: 0.4, l: 1.1 };
    let input = BicycleInput { u: 0.8 };
    check_with_multipliers("bicycle", &system, input, |t, x| system.multipliers(t, x, &input));
    check("bicycle", &BicycleFrame { b: 0.4, l: 1.1 }, BicycleFrameInput { u: 0.8 });
}

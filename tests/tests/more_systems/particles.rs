//! Particles and pendulums: nonlinear constraints, Lagrangians that are not of mechanical type.
#![allow(non_snake_case, reason = "parameters are written as in mechanics: J, I, R, Omega")]

use nonholonomic::prelude::*;

use super::{check, check_with_multipliers};

/// A triple pendulum with damping and torques in its joints.
#[nonholonomic(
    base { theta[3] }
    lagrangian {
        let vx[i in 0..3] = sum(j in 0..i+1: l[j]*cos(theta[j])*der(theta[j]));
        let vy[i in 0..3] = sum(j in 0..i+1: l[j]*sin(theta[j])*der(theta[j]));
        sum(i in 0..3: m[i]/2*(vx[i]^2+vy[i]^2) + m[i]*g*sum(j in 0..i+1: l[j]*cos(theta[j])))
    }
    inputs { u[3] }
    forces {
        theta[0]: u[0] - c*der(theta[0]) - u[1] + c*(der(theta[1])-der(theta[0]));
        theta[1]: u[1] - c*(der(theta[1])-der(theta[0])) - u[2] + c*(der(theta[2])-der(theta[1]));
        theta[2]: u[2] - c*(der(theta[2])-der(theta[1]));
    }
)]
#[derive(Clone, Copy, Debug)]
struct Triple {
    m: [f64; 3],
    l: [f64; 3],
    g: f64,
    c: f64,
}

/// A double pendulum in relative angles.
#[nonholonomic(
    base { q[2] }
    lagrangian {
        let th[i in 0..2] = sum(j in 0..i+1: q[j]);
        let w[i in 0..2] = sum(j in 0..i+1: der(q[j]));
        let vx[i in 0..2] = sum(j in 0..i+1: l[j]*cos(th[j])*w[j]);
        let vy[i in 0..2] = sum(j in 0..i+1: l[j]*sin(th[j])*w[j]);
        sum(i in 0..2: m[i]/2*(vx[i]^2+vy[i]^2) + m[i]*g*sum(j in 0..i+1: l[j]*cos(th[j])))
    }
    inputs { u0, u1 }
    forces { q[0]: u0 - c*der(q[0]); q[1]: u1 - c*der(q[1]) }
)]
#[derive(Clone, Copy, Debug)]
struct DoubleRel {
    m: [f64; 2],
    l: [f64; 2],
    g: f64,
    c: f64,
}

/// A spherical pendulum.
#[nonholonomic(
    base { theta, phi }
    lagrangian { l^2/2*(der(theta)^2 + sin(theta)^2*der(phi)^2) + g*l*cos(theta) }
)]
#[derive(Clone, Copy, Debug)]
struct Spherical {
    l: f64,
    g: f64,
}

/// Appell's machine: a homogeneous quadratic constraint.
#[nonholonomic(
    base { x, y, z }
    lagrangian { m/2*(der(x)^2+der(y)^2) + J/2*der(z)^2 - m*g*z }
    constraints { machine: der(x)^2 + der(y)^2 = a^2*der(z)^2 }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct Appell {
    m: f64,
    J: f64,
    a: f64,
    g: f64,
}

/// A particle of constant speed under forces.
#[nonholonomic(
    base { x, y, z }
    lagrangian { m/2*(der(x)^2+der(y)^2+der(z)^2) - m*g*z }
    constraints { der(x)^2 + der(y)^2 + der(z)^2 = u^2 }
    forces { x: c*y*t; y: -c*x }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct ConstantSpeed {
    m: f64,
    g: f64,
    u: f64,
    c: f64,
}

/// The same by the root of the square.
#[nonholonomic(
    base { x, y, z }
    lagrangian { m/2*(der(x)^2+der(y)^2+der(z)^2) - m*g*z }
    constraints { sqrt(der(x)^2 + der(y)^2 + der(z)^2) = u }
    forces { x: c*y*t; y: -c*x }
)]
#[derive(Clone, Copy, Debug)]
struct ConstantSpeedRoot {
    m: f64,
    g: f64,
    u: f64,
    c: f64,
}

/// Two points with parallel velocities.
#[nonholonomic(
    base { x1, y1, x2, y2 }
    lagrangian {
        m/2*(der(x1)^2+der(y1)^2) + J/2*(der(x2)^2+der(y2)^2) - c/2*((x1-x2)^2+(y1-y2)^2) - m*g*y1
    }
    constraints { der(x1)*der(y2) = der(x2)*der(y1) }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct Parallel {
    m: f64,
    J: f64,
    c: f64,
    g: f64,
}

/// A relativistic charge under a constraint.
#[nonholonomic(
    base { x, y, z }
    lagrangian {
        -m*sqrt(1 - der(x)^2 - der(y)^2 - der(z)^2) + u/sqrt(x^2+y^2+z^2+1)
            + c*(-y*z/2*der(x) + (x + x^3/6)*der(y))
    }
    constraints { der(z) = x*der(y) }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct Relativistic {
    m: f64,
    c: f64,
    u: f64,
}

/// A relativistic particle in a field.
#[nonholonomic(
    base { x, y, z }
    lagrangian { -m*sqrt(1 - der(x)^2 - der(y)^2 - der(z)^2) + u/sqrt(x^2+y^2+z^2+1) }
)]
#[derive(Clone, Copy, Debug)]
struct RelativisticFree {
    m: f64,
    u: f64,
}

/// A Lagrangian that is quartic in the velocities.
#[nonholonomic(
    base { x, y }
    lagrangian { (m+u*cos(x-y)*der(x)^2)/2*(der(x)^2+der(y)^2)+J/4*(der(x)*der(y))^2+der(y)^4/5-c*x*y }
)]
#[derive(Clone, Copy, Debug)]
struct VelMass {
    m: f64,
    c: f64,
    u: f64,
    J: f64,
}

/// A particle in a polar frame, with forces along the base coordinates.
#[nonholonomic(
    base { r, phi }
    basis { vr, vt }
    anchor { der(r) = vr; der(phi) = vt/r }
    lagrangian { m/2*(vr^2+vt^2) }
    forces {
        r: cos(phi)*(-c*r*cos(phi)*(vr*cos(phi)-vt*sin(phi))+u*t)
            + sin(phi)*(-(r*sin(phi))^3 - (vr*cos(phi)-vt*sin(phi))*(vr*sin(phi)+vt*cos(phi)));
        phi: r*(-sin(phi)*(-c*r*cos(phi)*(vr*cos(phi)-vt*sin(phi))+u*t)
            + cos(phi)*(-(r*sin(phi))^3 - (vr*cos(phi)-vt*sin(phi))*(vr*sin(phi)+vt*cos(phi))));
    }
)]
#[derive(Clone, Copy, Debug)]
struct Polar {
    m: f64,
    c: f64,
    u: f64,
}

/// A gearbox of continuously varying ratio, driven by a pendulum.
#[nonholonomic(
    base { x, y, z }
    lagrangian { (der(x)^2+der(y)^2+der(z)^2)/2 - (x^2+y^2)/2 - 3/20*x^2*z^2 - cos(z) }
    constraints { der(x) + y*der(z) = 0 }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct Cvt {}

/// The same by a coframe.
#[nonholonomic(
    base { x, y, z }
    velocities { p = der(x) + y*der(z); q = der(y); s = der(z) - y*der(x) }
    lagrangian { (der(x)^2+der(y)^2+der(z)^2)/2 - (x^2+y^2)/2 - 3/20*x^2*z^2 - cos(z) }
    constraints { p = 0 }
)]
#[derive(Clone, Copy, Debug)]
struct CvtFrame;

/// The nonholonomic integrator with a potential, forces and inputs.
#[nonholonomic(
    base { x, y, z }
    lagrangian { (der(x)^2+2*der(y)^2+3*der(z)^2)/2-x*y*z-z^2/2 }
    constraints { c: der(z)-(y*der(x)-x*der(y)) = 0 }
    forces { x: u1 + der(y)/10; y: u2; z: -der(z)/5 }
    inputs { u1, u2 }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct Brockett;

/// A pendulum in Cartesian coordinates, its rod as a constraint of velocities.
#[nonholonomic(
    base { x, y }
    lagrangian { 3/4*(der(x)^2+der(y)^2) - 9.81*1.5*y }
    constraints { rod: x*der(x) + y*der(y) = 0 }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct CartesianPendulum;

/// The same by a coframe.
#[nonholonomic(
    base { x, y }
    velocities { r = x*der(x)+y*der(y); k = x*der(y) - y*der(x) }
    lagrangian { 3/4*(der(x)^2+der(y)^2) - 9.81*1.5*y }
    constraints { rod: r = 0 }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct CartesianPendulumPolar;

#[test]
fn pendulums_and_nonlinear_constraints() {
    check(
        "pendulum3",
        &Triple { m: [1.0, 0.5, 0.75], l: [1.0, 0.8, 0.6], g: 9.81, c: 0.2 },
        TripleInput { u: [0.2, 0.4, 0.6] },
    );
    check(
        "pendulum2",
        &DoubleRel { m: [1.0, 0.5], l: [1.0, 0.8], g: 9.81, c: 0.2 },
        DoubleRelInput { u0: 0.2, u1: 0.4 },
    );
    check("spherical", &Spherical { l: 1.5, g: 9.81 }, ());
    let system = Appell { m: 1.3, J: 0.4, a: 0.3, g: 9.81 };
    check_with_multipliers("appell", &system, (), |t, x| system.multipliers(t, x, &()));
    let system = ConstantSpeed { m: 1.3, g: 9.81, u: 0.6, c: 0.2 };
    check_with_multipliers("constant_speed", &system, (), |t, x| system.multipliers(t, x, &()));
    check("constant_speed", &ConstantSpeedRoot { m: 1.3, g: 9.81, u: 0.6, c: 0.2 }, ());
    let system = Parallel { m: 1.3, J: 0.4, c: 0.2, g: 9.81 };
    check_with_multipliers("parallel", &system, (), |t, x| system.multipliers(t, x, &()));
    let system = Relativistic { m: 1.3, c: 0.2, u: 0.6 };
    check_with_multipliers("relativistic", &system, (), |t, x| system.multipliers(t, x, &()));
}

#[test]
fn lagrangians_of_any_kind() {
    check("relativistic_free", &RelativisticFree { m: 1.3, u: 0.6 }, ());
    check("velmass", &VelMass { m: 1.3, c: 0.2, u: 0.6, J: 0.4 }, ());
    check("polar", &Polar { m: 1.3, c: 0.2, u: 0.6 }, ());
    let system = Cvt {};
    check_with_multipliers("cvt", &system, (), |t, x| system.multipliers(t, x, &()));
    check("cvt", &CvtFrame, ());
    let system = Brockett;
    let input = BrockettInput { u1: 0.7, u2: -0.3 };
    check_with_multipliers("brockett", &system, input, |t, x| system.multipliers(t, x, &input));
    let system = CartesianPendulum;
    check_with_multipliers("cartesian_pendulum", &system, (), |t, x| system.multipliers(t, x, &()));
    let system = CartesianPendulumPolar;
    check_with_multipliers("cartesian_pendulum", &system, (), |t, x| system.multipliers(t, x, &()));
}

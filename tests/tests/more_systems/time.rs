//! What depends on time.
#![allow(non_snake_case, reason = "parameters are written as in mechanics: J, I, R, Omega")]

use nonholonomic::prelude::*;

use super::{check, check_with_multipliers};

/// A pendulum whose pivot shakes.
#[nonholonomic(
    base { theta }
    lagrangian {
        let vx = cos(theta)*der(theta);
        let vy = sin(theta)*der(theta) - 5*e*sin(5*t);
        m/2*(vx^2+vy^2) - m*g*(e*cos(5*t) - cos(theta))
    }
)]
#[derive(Clone, Copy, Debug)]
struct Kapitsa {
    m: f64,
    g: f64,
    e: f64,
}

/// A charge in a magnetic field that varies in space, and in time.
#[nonholonomic(
    base { x, y, z }
    lagrangian {
        m/2*(der(x)^2+der(y)^2+der(z)^2)
            + c*(-y*z/2*der(x) + (x + x^3/6)*der(y) + (x*y^2/2+sin(t))*der(z)) - u/2*(x^2+y^2)
    }
)]
#[derive(Clone, Copy, Debug)]
struct Magnetic {
    m: f64,
    c: f64,
    u: f64,
}

/// A Lagrangian that is quartic in the velocities, under an affine constraint that depends on time.
#[nonholonomic(
    base { x, y, z }
    lagrangian {
        (m+u*cos(x-y)*der(x)^2)/2*(der(x)^2+der(y)^2)+J/4*(der(x)*der(y))^2+der(z)^2+der(y)^4/5-c*x*y
    }
    constraints { der(z) = y*der(x)*(1+t/5)+x*der(y)-u*sin(x) }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct VelMassCon {
    m: f64,
    c: f64,
    u: f64,
    J: f64,
}

/// Velocity forms whose coefficients depend on time.
#[nonholonomic(
    base { x, y, z }
    lagrangian {
        (der(x) + t*der(y) + sin(x*t)*der(z))^2/2 + (cos(t)*der(x) - sin(t)*der(z))^2/2 + der(y)^2
            + der(z)^2/2 - x*y
    }
)]
#[derive(Clone, Copy, Debug)]
struct TimeForms;

/// The same under an affine constraint.
#[nonholonomic(
    base { x, y, z }
    lagrangian {
        (der(x) + t*der(y) + sin(x*t)*der(z))^2/2 + (cos(t)*der(x) - sin(t)*der(z))^2/2 + der(y)^2
            + der(z)^2/2 - x*y
    }
    constraints { k: der(z) = y*der(x) + t*der(y) - cos(x)/2 }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct TimeFormsCon;

/// The same by a coframe.
#[nonholonomic(
    base { x, y, z }
    velocities { p = der(x) + sin(x)*der(z); q = 2*der(y); s = exp(y/3)*der(z) }
    lagrangian {
        (der(x) + t*der(y) + sin(x*t)*der(z))^2/2 + (cos(t)*der(x) - sin(t)*der(z))^2/2 + der(y)^2
            + der(z)^2/2 - x*y
    }
    constraints { k: der(z) = y*der(x) + t*der(y) - cos(x)/2 }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct TimeFormsFrame;

/// The same under a quadratic constraint.
#[nonholonomic(
    base { x, y, z }
    lagrangian {
        (der(x) + t*der(y) + sin(x*t)*der(z))^2/2 + (cos(t)*der(x) - sin(t)*der(z))^2/2 + der(y)^2
            + der(z)^2/2 - x*y
    }
    constraints { k: der(z) + der(x)^2/3 - t*der(y) = 0 }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct TimeFormsQuad;

/// A pendulum whose length varies in time.
#[nonholonomic(
    base { theta }
    lagrangian {
        let l = 1 + sin(3*t)/4;
        let ld = 3*cos(3*t)/4;
        let vx = l*cos(theta)*der(theta) + ld*sin(theta);
        let vy = l*sin(theta)*der(theta) - ld*cos(theta);
        m/2*(vx^2+vy^2) + m*g*l*cos(theta)
    }
)]
#[derive(Clone, Copy, Debug)]
struct Swing {
    m: f64,
    g: f64,
}

#[test]
fn lagrangians_and_constraints_that_move() {
    check("kapitsa", &Kapitsa { m: 1.3, g: 9.81, e: 0.5 }, ());
    check("magnetic", &Magnetic { m: 1.3, c: 0.2, u: 0.6 }, ());
    let system = VelMassCon { m: 1.3, c: 0.2, u: 0.6, J: 0.4 };
    check_with_multipliers("velmass_con", &system, (), |t, x| system.multipliers(t, x, &()));
    check("swing", &Swing { m: 1.3, g: 9.81 }, ());
}

#[test]
fn velocity_forms_that_depend_on_time() {
    check("time_forms", &TimeForms, ());
    let system = TimeFormsCon;
    check_with_multipliers("time_forms_con", &system, (), |t, x| system.multipliers(t, x, &()));
    let system = TimeFormsFrame;
    check_with_multipliers("time_forms_con", &system, (), |t, x| system.multipliers(t, x, &()));
    let system = TimeFormsQuad;
    check_with_multipliers("time_forms_quad", &system, (), |t, x| system.multipliers(t, x, &()));
}

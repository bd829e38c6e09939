//! Tractors with trailers, and the roller racer.
#![allow(non_snake_case, reason = "parameters are written as in mechanics: J, I, R, Omega")]

use nonholonomic::prelude::*;

use super::{check, check_with_multipliers};

/// A tractor with three trailers in absolute angles; the drive pushes along the tractor.
#[nonholonomic(
    base { x, y, theta[4] }
    lagrangian {
        let vx[i in 0..4] = der(x) + sum(j in 1..i+1: d[j] * sin(theta[j]) * der(theta[j]));
        let vy[i in 0..4] = der(y) - sum(j in 1..i+1: d[j] * cos(theta[j]) * der(theta[j]));
        m[0]/2*((der(x) - a*sin(theta[0])*der(theta[0]))^2 + (der(y) + a*cos(theta[0])*der(theta[0]))^2)
            + sum(i in 0..4: J[i]/2*der(theta[i])^2) + sum(i in 1..4: m[i]/2*(vx[i]^2+vy[i]^2))
    }
    constraints {
        for i in 0..4 { cos(theta[i])*(der(y) - sum(j in 1..i+1: d[j] * cos(theta[j]) * der(theta[j])))
            = sin(theta[i])*(der(x) + sum(j in 1..i+1: d[j] * sin(theta[j]) * der(theta[j]))); }
    }
    inputs { F, tau }
    forces { x: F*cos(theta[0]); y: F*sin(theta[0]); theta[0]: tau }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct Trailers3 {
    m: [f64; 4],
    J: [f64; 4],
    d: [f64; 4],
    a: f64,
}

/// The same in the frame of the tractor.
#[nonholonomic(
    base { x, y, theta[4] }
    basis { v1, v2, om[4] }
    anchor {
        der(x) = v1*cos(theta[0]) - v2*sin(theta[0]);
        der(y) = v1*sin(theta[0]) + v2*cos(theta[0]);
        for i in 0..4 { der(theta[i]) = om[i]; }
    }
    lagrangian {
        let vx[i in 0..4] = der(x) + sum(j in 1..i+1: d[j] * sin(theta[j]) * om[j]);
        let vy[i in 0..4] = der(y) - sum(j in 1..i+1: d[j] * cos(theta[j]) * om[j]);
        m[0]/2*(v1^2+(v2+a*om[0])^2) + sum(i in 0..4: J[i]/2*om[i]^2)
            + sum(i in 1..4: m[i]/2*(vx[i]^2+vy[i]^2))
    }
    constraints {
        v2 = 0;
        for i in 1..4 { d[i]*om[i] = v1*sin(theta[0]-theta[i])
            - sum(j in 1..i: d[j]*cos(theta[i]-theta[j])*om[j]); }
    }
    inputs { F, tau }
    forces { v1: F; om[0]: tau }
    independent { v1, om[0] }
)]
#[derive(Clone, Copy, Debug)]
struct Trailers3Frame {
    m: [f64; 4],
    J: [f64; 4],
    d: [f64; 4],
    a: f64,
}

/// One trailer, by its angle relative to the tractor.
#[nonholonomic(
    base { x, y, th, rel[1] }
    lagrangian {
        let t1 = th + rel[0];
        let w1 = der(th) + der(rel[0]);
        m[0]/2*((der(x) - a*sin(th)*der(th))^2 + (der(y) + a*cos(th)*der(th))^2) + J[0]/2*der(th)^2
            + J[1]/2*w1^2 + m[1]/2*((der(x)+d*sin(t1)*w1)^2+(der(y)-d*cos(t1)*w1)^2)
    }
    constraints {
        cos(th)*der(y) = sin(th)*der(x);
        cos(th+rel[0])*der(y) - d*(der(th)+der(rel[0])) = sin(th+rel[0])*der(x);
    }
    inputs { F, tau }
    forces { x: F*cos(th); y: F*sin(th); th: tau }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct Trailer1Rel {
    m: [f64; 2],
    J: [f64; 2],
    d: f64,
    a: f64,
}

/// Two trailers, by relative angles in the frame of the tractor.
#[nonholonomic(
    base { x, y, th, rel[2] }
    basis { v1, v2, omega, rd[2] }
    anchor {
        der(x) = v1*cos(th) - v2*sin(th);
        der(y) = v1*sin(th)+v2*cos(th);
        der(th) = omega;
        for i in 0..2 { der(rel[i]) = rd[i] }
    }
    lagrangian {
        let ang[i in 0..2] = sum(j in 0..i+1: rel[j]);
        let w[i in 0..2] = omega + sum(j in 0..i+1: rd[j]);
        let px[i in 0..2] = v1 + sum(j in 0..i+1: d[j]*sin(ang[j])*w[j]);
        let py[i in 0..2] = v2 - sum(j in 0..i+1: d[j]*cos(ang[j])*w[j]);
        m[0]/2*(v1^2+(v2+a*omega)^2) + J[0]/2*omega^2
            + sum(i in 0..2: J[i+1]/2*w[i]^2 + m[i+1]/2*(px[i]^2+py[i]^2))
    }
    constraints {
        v2 = 0;
        cos(rel[0])*v2 - d[0]*(omega+rd[0]) = sin(rel[0])*v1;
        cos(rel[0]+rel[1])*(v2 - d[0]*cos(rel[0])*(omega+rd[0])) - d[1]*(omega+rd[0]+rd[1])
            = sin(rel[0]+rel[1])*(v1 + d[0]*sin(rel[0])*(omega+rd[0]));
    }
    inputs { F, tau }
    forces { v1: F; omega: tau }
)]
#[derive(Clone, Copy, Debug)]
struct Trailer2Rel {
    m: [f64; 3],
    J: [f64; 3],
    d: [f64; 2],
    a: f64,
}

/// The roller racer: two bodies on wheels, joined by a pivot that is driven.
#[nonholonomic(
    base { x, y, theta, alpha }
    lagrangian {
        let t2 = theta + alpha;
        let w2 = der(theta) + der(alpha);
        let x2 = der(x) - d1*sin(theta)*der(theta) + d2*sin(t2)*w2;
        let y2 = der(y) + d1*cos(theta)*der(theta) - d2*cos(t2)*w2;
        m1/2*(der(x)^2+der(y)^2) + J1/2*der(theta)^2 + m2/2*(x2^2+y2^2) + J2/2*w2^2
    }
    constraints {
        -der(x)*sin(theta)+der(y)*cos(theta) = 0;
        -(der(x) - d1*sin(theta)*der(theta)
            + d2*sin(theta+alpha)*(der(theta)+der(alpha)))*sin(theta+alpha)
            + (der(y) + d1*cos(theta)*der(theta)
            - d2*cos(theta+alpha)*(der(theta)+der(alpha)))*cos(theta+alpha) = 0;
    }
    forces { alpha: u }
    inputs { u }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct Racer {
    m1: f64,
    m2: f64,
    J1: f64,
    J2: f64,
    d1: f64,
    d2: f64,
}

/// The same in the frame of the first body.
#[nonholonomic(
    base { x, y, theta, alpha }
    basis { v1, v2, omega, dalpha }
    anchor {
        der(x) = v1*cos(theta)-v2*sin(theta);
        der(y) = v1*sin(theta)+v2*cos(theta);
        der(theta) = omega;
        der(alpha) = dalpha
    }
    lagrangian {
        let w2 = omega + dalpha;
        let x2 = v1 + d2*sin(alpha)*w2;
        let y2 = v2 + d1*omega - d2*cos(alpha)*w2;
        m1/2*(v1^2+v2^2) + J1/2*omega^2 + m2/2*(x2^2+y2^2) + J2/2*w2^2
    }
    constraints { v2 = 0; -v1*sin(alpha) + (v2 + d1*omega)*cos(alpha) - d2*(omega+dalpha) = 0; }
    forces { dalpha: u }
    inputs { u }
)]
#[derive(Clone, Copy, Debug)]
struct RacerFrame {
    m1: f64,
    m2: f64,
    J1: f64,
    J2: f64,
    d1: f64,
    d2: f64,
}

/// The same with a second body that has neither mass nor inertia: the mass matrix is singular.
#[nonholonomic(
    base { x, y, theta, alpha }
    basis { v1, v2, omega, dalpha }
    anchor {
        der(x) = v1*cos(theta)-v2*sin(theta);
        der(y) = v1*sin(theta)+v2*cos(theta);
        der(theta) = omega;
        der(alpha) = dalpha
    }
    lagrangian { m1/2*(v1^2+v2^2) + J1/2*omega^2 }
    constraints { v2 = 0; -v1*sin(alpha) + (v2 + d1*omega)*cos(alpha) - d2*(omega+dalpha) = 0; }
    forces { dalpha: u }
    inputs { u }
)]
#[derive(Clone, Copy, Debug)]
struct RacerLight {
    m1: f64,
    J1: f64,
    d1: f64,
    d2: f64,
}

#[test]
fn tractors_and_racers() {
    let (a, m, J, d) = (0.25, [1.5, 0.8, 0.6, 0.5], [0.4, 0.2, 1.0 / 7.0, 1.0 / 9.0], [0.0, 0.9, 0.8, 0.7]);
    let system = Trailers3 { m, J, d, a };
    let input = Trailers3Input { F: 1.3, tau: 0.4 };
    check_with_multipliers("trailers3", &system, input, |t, x| system.multipliers(t, x, &input));
    check("trailers3", &Trailers3Frame { m, J, d, a }, Trailers3FrameInput { F: 1.3, tau: 0.4 });
    let system = Trailer1Rel { m: [1.5, 0.8], J: [0.4, 0.2], d: 0.9, a };
    let input = Trailer1RelInput { F: 1.3, tau: 0.4 };
    check_with_multipliers("trailers1", &system, input, |t, x| system.multipliers(t, x, &input));
    check(
        "trailers2",
        &Trailer2Rel { m: [1.5, 0.8, 0.6], J: [0.4, 0.2, 1.0 / 7.0], d: [0.9, 0.8], a },
        Trailer2RelInput { F: 1.3, tau: 0.4 },
    );
    let system = Racer { m1: 1.2, m2: 0.2, J1: 0.3, J2: 0.05, d1: 0.6, d2: 0.4 };
    let input = RacerInput { u: 0.35 };
    check_with_multipliers("racer", &system, input, |t, x| system.multipliers(t, x, &input));
    check(
        "racer",
        &RacerFrame { m1: 1.2, m2: 0.2, J1: 0.3, J2: 0.05, d1: 0.6, d2: 0.4 },
        RacerFrameInput { u: 0.35 },
    );
    check("racer_light", &RacerLight { m1: 1.2, J1: 0.3, d1: 0.6, d2: 0.4 }, RacerLightInput { u: 0.35 });
}

//! The systems that several of the test crates declare, each written once.
//!
//! A declaration is a macro that puts `#[nonholonomic(…)]` before a struct, which stays with whoever measures
//! or checks it: the numbers (`f64`, `f32`, any `T`), the parameters (at run time, or constants), and whatever
//! sections are wanted in addition.
//!
//! ```
//! # #![allow(non_snake_case)]
//! use nonholonomic::prelude::*;
//!
//! nh_models::sleigh! {
//!     #[derive(Clone, Copy, Debug)]
//!     struct Sleigh<T> { m: T, J: T, a: T, b: T, c: T }
//!     emit { jacobian }
//! }
//!
//! let sleigh = Sleigh { m: 1.0_f32, J: 0.5, a: 0.3, b: 0.1, c: 0.0 };
//! let state = SleighState { theta: 0.0, x: 0.0, y: 0.0, omega: 0.0, v1: 1.0 };
//! assert_eq!(sleigh.derivative(0.0, &state, &SleighInput { torque: 0.0 }).x, 1.0);
//! ```
#![no_std]

/// The Chaplygin sleigh, a rigid body on a plane, carried by a knife edge, with a torque and rotary friction.
///
/// `m`: mass; `J`: moment of inertia about the centre of mass, which lies `a` ahead and `b` to the left of the
/// contact point; `c`: rotary friction.
#[macro_export]
macro_rules! sleigh {
    ($parameters:item $($sections:tt)*) => {
        #[nonholonomic::nonholonomic(
            base   { theta, x, y }
            basis  { omega, v1, v2 }
            anchor {
                der(theta) = omega;
                der(x) = v1 * cos(theta) - v2 * sin(theta);
                der(y) = v1 * sin(theta) + v2 * cos(theta);
            }
            lagrangian  { (J + m * (a^2 + b^2)) / 2 * omega^2 + m / 2 * (v1^2 + v2^2) - m * b * omega * v1 + m * a * omega * v2 }
            constraints { v2 = 0; }
            forces      { omega: torque - c * omega; }
            inputs      { torque }
            $($sections)*
        )]
        $parameters
    };
}

/// Veselova's system in principal axes with a linear potential: a rigid body about a fixed point whose angular
/// velocity stays orthogonal to a vector fixed in space. All velocities are in the state, with a multiplier.
///
/// `I`: moments of inertia; `c`: the potential is `dot(c, g)`.
#[macro_export]
macro_rules! veselova {
    ($parameters:item $($sections:tt)*) => {
        #[nonholonomic::nonholonomic(
            base { g[3] }
            basis { w[3] }
            anchor { der(g) = cross(g, w); }
            brackets so(3) { w }
            lagrangian  { sum(i in 0..3: I[i] * w[i]^2) / 2 - dot(c, g) }
            constraints { dot(g, w) = 0; }
            $($sections)*
        )]
        $parameters
    };
}

/// The snakeboard, in the frame of the board, with torques on its rotor and on its wheels.
///
/// `m`: mass; `l`: half the length, where m l² is the moment of inertia of everything; `J0`: moment of inertia of
/// the rotor; `J1`: that of each pair of wheels.
#[macro_export]
macro_rules! snakeboard {
    ($parameters:item $($sections:tt)*) => {
        #[nonholonomic::nonholonomic(
            base  { x, y, theta, psi, phi }
            basis { u1, u2, dtheta, dpsi, dphi }
            anchor {
                der(x) = u1 * cos(theta) - u2 * sin(theta);
                der(y) = u1 * sin(theta) + u2 * cos(theta);
                der(theta) = dtheta;
                der(psi) = dpsi;
                der(phi) = dphi;
            }
            lagrangian {
                m / 2 * (u1^2 + u2^2) + m * l^2 / 2 * dtheta^2 + J0 / 2 * dpsi^2 + J0 * dpsi * dtheta + J1 * dphi^2
            }
            constraints {
                -sin(phi) * u1 + cos(phi) * u2 - l * cos(phi) * dtheta = 0;
                 sin(phi) * u1 + cos(phi) * u2 + l * cos(phi) * dtheta = 0;
            }
            forces { psi: rotor; phi: steering; }
            inputs { rotor, steering }
            $($sections)*
        )]
        $parameters
    };
}

/// The two-wheeled robot on the plane, CLMM section 6.4: it rolls backwards when its wheels turn forwards.
///
/// `m0`, `m1`: masses of the body and of each wheel; `l`: centre of mass ahead of the axle; `J`: moment of
/// inertia about the vertical through the middle of the axle; `J2`: axial one of each wheel; `c`: half the axle;
/// `R`: radius of the wheels.
#[macro_export]
macro_rules! robot {
    ($parameters:item $($sections:tt)*) => {
        #[nonholonomic::nonholonomic(
            base { psi1, psi2, x, y, theta }
            lagrangian {
                let lateral = -der(x) * sin(theta) + der(y) * cos(theta);
                (m0 + 2 * m1) / 2 * (der(x)^2 + der(y)^2) + m0 * l * lateral * der(theta)
                    + J / 2 * der(theta)^2 + J2 / 2 * (der(psi1)^2 + der(psi2)^2)
            }
            constraints {
                der(x) = -R / 2 * (der(psi1) + der(psi2)) * cos(theta);
                der(y) = -R / 2 * (der(psi1) + der(psi2)) * sin(theta);
                der(theta) = R / (2 * c) * (der(psi2) - der(psi1));
            }
            $($sections)*
        )]
        $parameters
    };
}

/// A robot on two driven wheels, with its centre of mass ahead of the axle.
///
/// `m`: mass; `J`: moment of inertia about the centre of mass; `I`: axial one of each wheel; `b`: half the axle;
/// `d`: centre of mass ahead of the axle; `r`: radius of the wheels.
#[macro_export]
macro_rules! driven_robot {
    ($parameters:item $($sections:tt)*) => {
        #[nonholonomic::nonholonomic(
            base { x, y, theta, phi_r, phi_l }
            lagrangian {
                m / 2 * (der(x)^2 + der(y)^2)
                    + m * d * der(theta) * (cos(theta) * der(y) - sin(theta) * der(x))
                    + (J + m * d^2) / 2 * der(theta)^2
                    + I / 2 * (der(phi_r)^2 + der(phi_l)^2)
            }
            constraints {
                der(x) = r / 2 * (der(phi_r) + der(phi_l)) * cos(theta);
                der(y) = r / 2 * (der(phi_r) + der(phi_l)) * sin(theta);
                der(theta) = r / (2 * b) * (der(phi_r) - der(phi_l));
            }
            forces { phi_r: right; phi_l: left; }
            inputs { right, left }
            assume { m > 0; J > 0; I > 0; b > 0; r > 0; }
            $($sections)*
        )]
        $parameters
    };
}

/// A homogeneous ball that rolls on a rotating table, CLMM section 7.4.
///
/// `m`: mass; `r`: radius; `k2`: square of the radius of gyration; `Omega`: angular velocity of the table.
#[macro_export]
macro_rules! ball {
    ($parameters:item $($sections:tt)*) => {
        #[nonholonomic::nonholonomic(
            base  { x, y }
            basis { dx, dy, wx, wy, wz }
            anchor { der(x) = dx; der(y) = dy; }
            brackets { [wx, wy] = -wz; [wy, wz] = -wx; [wz, wx] = -wy; }
            lagrangian { m / 2 * (dx^2 + dy^2 + k2 * (wx^2 + wy^2 + wz^2)) }
            constraints { dx = r * wy - Omega * y; dy = -r * wx + Omega * x; }
            $($sections)*
        )]
        $parameters
    };
}

/// A tractor that pulls so many trailers, hitched on its axle and on theirs, in relative angles.
///
/// `m`, `J`: masses and moments of inertia, of the tractor first; `d`: the length of each trailer; `a`: the
/// tractor's centre of mass ahead of its axle.
#[macro_export]
macro_rules! tractor {
    ($n:literal trailers: $parameters:item $($sections:tt)*) => {
        #[nonholonomic::nonholonomic(
            base  { x, y, th, rel[$n] }
            basis { v, side, omega, rd[$n] }
            anchor {
                der(x) = v * cos(th) - side * sin(th);
                der(y) = v * sin(th) + side * cos(th);
                der(th) = omega;
                for i in 0..$n { der(rel[i]) = rd[i]; }
            }
            lagrangian {
                let ang[i in 0..$n] = sum(j in 0..i+1: rel[j]);
                let w[i in 0..$n] = omega + sum(j in 0..i+1: rd[j]);
                let px[i in 0..$n] = v + sum(j in 0..i+1: d[j] * sin(ang[j]) * w[j]);
                let py[i in 0..$n] = side - sum(j in 0..i+1: d[j] * cos(ang[j]) * w[j]);
                m[0] / 2 * (v^2 + (side + a * omega)^2) + J[0] / 2 * omega^2
                    + sum(i in 0..$n: J[i+1] / 2 * w[i]^2 + m[i+1] / 2 * (px[i]^2 + py[i]^2))
            }
            constraints {
                let ang[i in 0..$n] = sum(j in 0..i+1: rel[j]);
                let w[i in 0..$n] = omega + sum(j in 0..i+1: rd[j]);
                let px[i in 0..$n] = v + sum(j in 0..i+1: d[j] * sin(ang[j]) * w[j]);
                let py[i in 0..$n] = side - sum(j in 0..i+1: d[j] * cos(ang[j]) * w[j]);
                side = 0;
                for i in 0..$n { cos(ang[i]) * py[i] = sin(ang[i]) * px[i]; }
            }
            inputs { push, steer }
            forces { v: push; omega: steer; }
            $($sections)*
        )]
        $parameters
    };
}

/// A car that is driven and steered at its front wheels, which turn about the vertical axis together.
///
/// `m`: mass; `J`: moment of inertia about the centre of mass; `Js`: that of the front wheels; `a`: centre of mass
/// ahead of the rear axle; `L`: distance of the axles.
#[macro_export]
macro_rules! car {
    ($parameters:item $($sections:tt)*) => {
        #[nonholonomic::nonholonomic(
            base  { x, y, th, delta }
            basis { v, side, omega, turn }
            anchor {
                der(x) = v * cos(th) - side * sin(th);
                der(y) = v * sin(th) + side * cos(th);
                der(th) = omega;
                der(delta) = turn;
            }
            lagrangian { m / 2 * (v^2 + (side + a * omega)^2) + J / 2 * omega^2 + Js / 2 * (omega + turn)^2 }
            constraints { side = 0; (side + L * omega) * cos(delta) = v * sin(delta); }
            independent { v, turn }
            inputs { drive, steer }
            forces { v: drive; turn: steer; }
            $($sections)*
        )]
        $parameters
    };
}

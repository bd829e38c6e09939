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
            units { theta = rad; x, y, a, b = m; m = kg; J = kg m^2; torque = N m; }
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
            units { g = 1; I = kg m^2; c = J; w = rad/s; }
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
            units { x, y, l = m; theta, psi, phi = rad; m = kg; J0, J1 = kg m^2; rotor, steering = N m; }
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
            units { psi1, psi2, theta = rad; x, y, l, c, R = m; m0, m1 = kg; J, J2 = kg m^2; }
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
            units { x, y, d, b, r = m; theta, phi_r, phi_l = rad; m = kg; J, I = kg m^2; right, left = N m; }
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
            units { x, y, r = m; m = kg; k2 = m^2; Omega = rad/s; }
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
            units { x, y, a, d = m; th, rel = rad; m = kg; J = kg m^2; push = N; steer = N m; }
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
            units { x, y, a, L = m; th, delta = rad; m = kg; J, Js = kg m^2; drive = N; steer = N m; }
            $($sections)*
        )]
        $parameters
    };
}

/// The bicycle of Meijaard, Papadopoulos, Ruina, Schwab (Proc. R. Soc. A 463, 2007, 1955–1982), declared by its
/// geometry. Axes as in the paper: x forwards, y to the right, z down. The base has the contact of the rear wheel, yaw,
/// lean, pitch of the rear frame, steer, and the turns of the wheels.
///
/// `w`: wheelbase; `c`: trail; `lambda`: tilt of the steering axis; `g`: gravity; `rR`, `rF`: radii of the wheels; and for
/// rear wheel, body, handlebar and front wheel the masses `m`, places `x`, `z` and moments of inertia `I`. Further fields
/// may stand behind the name, `struct Bicycle<T> with { … };`.
#[macro_export]
macro_rules! bicycle {
    ($(#[$attribute:meta])* $visibility:vis struct $name:ident<$t:ident> $(with { $($fields:tt)* })?; $($sections:tt)*) => {
        #[nonholonomic::nonholonomic(
            base { x, y, yaw, lean, pitch, steer, rear, front }

            let down = [0, 0, 1];
            let roll = rot_z(yaw) * rot_x(lean);
            let frame = roll * rot_y(pitch);
            let tilt = rot_y(lambda);
            let fork = frame * tilt * rot_z(steer) * transpose(tilt);
            let contact = [x, y, 0];
            let hub = contact - rR * (roll * down);
            let head = hub + frame * [w + c, 0, rR];
            let rider = hub + frame * [xB, 0, zB + rR];
            let bars = head + fork * [xH - w - c, 0, zH];
            let axle = head - fork * [c, 0, rF];
            let side = fork * [0, 1, 0];
            let slope = sqrt(1 - side[2]^2);
            let touch = axle + rF / slope * (down - side[2] * side);

            holonomic { ground: axle[2] + rF * slope = 0; }
            constraints {
                rear_rolls: velocity_at(hub, frame * rot_y(rear), contact)[0..2] = 0;
                front_rolls: velocity_at(axle, fork * rot_y(front), touch)[0..2] = 0;
            }
            independent { der(lean), der(steer), der(rear) }
            lagrangian {
                kinetic(mR, [IRx, IRy, IRx], hub, frame * rot_y(rear))
                + kinetic(mB, [[IBx, 0, IBxz], [0, IBy, 0], [IBxz, 0, IBz]], rider, frame)
                + kinetic(mH, [[IHx, 0, IHxz], [0, IHy, 0], [IHxz, 0, IHz]], bars, fork)
                + kinetic(mF, [IFx, IFy, IFx], axle, fork * rot_y(front))
                + g * (mR * hub[2] + mB * rider[2] + mH * bars[2] + mF * axle[2])
            }
            units {
                x, y, w, c, rR, rF, xB, zB, xH, zH = m;
                yaw, lean, pitch, steer, rear, front, lambda = rad;
                mR, mB, mH, mF = kg;
                IRx, IRy, IBx, IBxz, IBy, IBz, IHx, IHxz, IHy, IHz, IFx, IFy = kg m^2;
                g = m/s^2;
            }
            $($sections)*
        )]
        $(#[$attribute])*
        $visibility struct $name<$t> {
            pub w: $t,
            pub c: $t,
            pub lambda: $t,
            pub g: $t,
            pub rR: $t,
            pub mR: $t,
            pub IRx: $t,
            pub IRy: $t,
            pub xB: $t,
            pub zB: $t,
            pub mB: $t,
            pub IBx: $t,
            pub IBxz: $t,
            pub IBy: $t,
            pub IBz: $t,
            pub xH: $t,
            pub zH: $t,
            pub mH: $t,
            pub IHx: $t,
            pub IHxz: $t,
            pub IHy: $t,
            pub IHz: $t,
            pub rF: $t,
            pub mF: $t,
            pub IFx: $t,
            pub IFy: $t,
            $($($fields)*)?
        }
    };
}

/// The published parameters of [`bicycle!`], with gravity `g`, as numbers of the type that `number` makes of an `f64`;
/// further fields with their values.
#[macro_export]
macro_rules! published_bicycle {
    ($name:ident, $g:expr, $number:expr $(, $field:ident: $value:expr)*) => {
        $name {
            w: ($number)(1.02),
            c: ($number)(0.08),
            lambda: ($number)(core::f64::consts::PI / 10.0),
            g: ($number)($g),
            rR: ($number)(0.3),
            mR: ($number)(2.0),
            IRx: ($number)(0.0603),
            IRy: ($number)(0.12),
            xB: ($number)(0.3),
            zB: ($number)(-0.9),
            mB: ($number)(85.0),
            IBx: ($number)(9.2),
            IBxz: ($number)(2.4),
            IBy: ($number)(11.0),
            IBz: ($number)(2.8),
            xH: ($number)(0.9),
            zH: ($number)(-0.7),
            mH: ($number)(4.0),
            IHx: ($number)(0.05892),
            IHxz: ($number)(-0.00756),
            IHy: ($number)(0.06),
            IHz: ($number)(0.00708),
            rF: ($number)(0.35),
            mF: ($number)(3.0),
            IFx: ($number)(0.1405),
            IFy: ($number)(0.28),
            $($field: $value,)*
        }
    };
}

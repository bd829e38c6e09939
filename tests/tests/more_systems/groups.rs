//! Lie algebras and rigid bodies.
#![allow(non_snake_case, reason = "parameters are written as in mechanics: J, I, R, Omega")]

use nonholonomic::prelude::*;

use super::{check, check_with_multipliers};

/// A Suslov problem on so(4).
#[nonholonomic(
    basis { e12, e13, e14, e23, e24, e34 }
    brackets so(4) { e12, e13, e14, e23, e24, e34 }
    lagrangian { let w = [e12, e13, e14, e23, e24, e34]; dot(w, G*w)/2 }
    constraints { sus: e12 + e14/2 - e24 + 2*e34 = 0 }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct So4 {
    G: [[f64; 6]; 6],
}

/// Geodesics of a left-invariant metric on SL(2).
#[nonholonomic(
    basis { h, e, f }
    brackets sl(2) { h, e, f }
    lagrangian { 3/4*h^2 + e^2 + 7/10*f^2 + h*e/5 - 0.3*e*f }
)]
#[derive(Clone, Copy, Debug)]
struct Sl2Free;

/// A Suslov problem on sl(2).
#[nonholonomic(
    basis { h, e, f }
    brackets sl(2) { h, e, f }
    lagrangian { 3/4*h^2 + e^2 + 7/10*f^2 + h*e/5 - 0.3*e*f }
    constraints { f = e/2 + h/4 }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct Sl2;

/// The Heisenberg algebra with a constraint.
#[nonholonomic(
    basis { X, Y, Z }
    brackets heisenberg(1) { X, Y, Z }
    lagrangian { let v = [X,Y,Z]; dot(v, G*v)/2 }
    constraints { c: Z = X/2 }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct Heis {
    G: [[f64; 3]; 3],
}

/// Geodesics of the Heisenberg group.
#[nonholonomic(
    basis { X, Y, Z }
    brackets { [X, Y] = Z; }
    lagrangian { let v = [X,Y,Z]; dot(v, G*v)/2 }
)]
#[derive(Clone, Copy, Debug)]
struct HeisFree {
    G: [[f64; 3]; 3],
}

/// The Heisenberg group with the constraint, in coordinates.
#[nonholonomic(
    base { x, y, z }
    lagrangian { let v = [der(x),der(y),der(z) + (y*der(x) - x*der(y))/2]; dot(v, G*v)/2 }
    constraints { c: der(z) + (y*der(x) - x*der(y))/2 - der(x)/2 = 0 }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct HeisR3 {
    G: [[f64; 3]; 3],
}

/// The same by its invariant coframe.
#[nonholonomic(
    base { x, y, z }
    velocities { X = der(x); Y = der(y); Z = der(z) + (y*der(x) - x*der(y))/2 }
    lagrangian { let v = [X,Y,Z]; dot(v, G*v)/2 }
    constraints { c: Z = X/2 }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct HeisCoframe {
    G: [[f64; 3]; 3],
}

/// A rigid body in a field, with the spin about the vertical claimed.
#[nonholonomic(
    base { g[3] }
    on { dot(g,g) = 1 }
    basis { w[3] }
    anchor { for i in 0..3 { der(g[i]) = cross(g, w)[i] } }
    brackets so(3) { w[0], w[1], w[2] }
    lagrangian { dot(w, I*w)/2 - (3*g[0]-g[1]/2+2*g[2]+g[0]*g[1]^2) }
    conserved { spin = sum(i in 0..3: sum(j in 0..3: (I[i][j]+I[j][i])/2*w[j]*g[i])); }
    outputs { height = g[2]; }
)]
#[derive(Clone, Copy, Debug)]
struct HeavyTop {
    I: [[f64; 3]; 3],
}

/// The Veselova problem in a field.
#[nonholonomic(
    base { g[3] }
    on { dot(g,g) = 1 }
    basis { w[3] }
    anchor { for i in 0..3 { der(g[i]) = cross(g, w)[i] } }
    brackets so(3) { w[0], w[1], w[2] }
    lagrangian { dot(w, I*w)/2 - (3*g[0]-g[1]/2+2*g[2]+g[0]*g[1]^2) }
    constraints { k: dot(w, g) = 0 }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct VeselovaOn {
    I: [[f64; 3]; 3],
}

/// The same with a spin about the vertical that varies in time.
#[nonholonomic(
    base { g[3] }
    on { dot(g,g) = 1 }
    basis { w[3] }
    anchor { for i in 0..3 { der(g[i]) = cross(g, w)[i] } }
    brackets so(3) { w[0], w[1], w[2] }
    lagrangian { dot(w, I*w)/2 - (3*g[0]-g[1]/2+2*g[2]+g[0]*g[1]^2) }
    constraints { k: dot(w, g) = 1/2 + sin(t)/4 }
    emit { multipliers, reactions }
)]
#[derive(Clone, Copy, Debug)]
struct VeselovaAffine {
    I: [[f64; 3]; 3],
}

/// A body whose angular speed is tied to its attitude: a quadratic constraint.
#[nonholonomic(
    base { g[3] }
    on { dot(g,g) = 1 }
    basis { w[3] }
    anchor { for i in 0..3 { der(g[i]) = cross(g, w)[i] } }
    brackets so(3) { w[0], w[1], w[2] }
    lagrangian { dot(w, I*w)/2 - (3*g[0]-g[1]/2+2*g[2]+g[0]*g[1]^2) }
    constraints { k: dot(w, w) = 2 + g[0] }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct BodySpeed {
    I: [[f64; 3]; 3],
}

/// A satellite with two rotors: so(3) times the tangent bundle of a torus.
#[nonholonomic(
    base { al, be }
    basis { w1, w2, w3, dal, dbe }
    anchor { der(al) = dal; der(be) = dbe }
    brackets so(3) { w1, w2, w3 }
    lagrangian {
        let w = [w1, w2, w3];
        dot(w, I*w)/2 + 1/4*(dal^2 + 2*w1*dal) + 2/5*(dbe^2 + 2*dbe*(3/5*w2+4/5*w3)) - cos(al-be)/3
    }
    forces { dal: u1; be: u2 - der(be)/7 }
    inputs { u1, u2 }
)]
#[derive(Clone, Copy, Debug)]
struct Satellite {
    I: [[f64; 3]; 3],
}

/// A spherical pendulum on the sphere.
#[nonholonomic(
    base { g[3] }
    on { dot(g, g) = 1; }
    basis { w[3] }
    anchor { for i in 0..3 { der(g[i]) = cross(w, g)[i]; } }
    brackets { [w[0], w[1]] = -w[2]; [w[1], w[2]] = -w[0]; [w[2], w[0]] = -w[1]; }
    lagrangian { l^2/2*dot(cross(w, g), cross(w, g)) - gr*l*g[2] }
    constraints { dot(w, g) = 0 }
)]
#[derive(Clone, Copy, Debug)]
struct SphericalOnSphere {
    l: f64,
    gr: f64,
}

const INERTIA: [[f64; 3]; 3] = [[1.8, 0.1, -0.2], [0.1, 2.0, 0.3], [-0.2, 0.3, 2.5]];

/// A positive definite metric on so(4) without symmetry.
fn metric(i: usize, j: usize) -> f64 {
    let entries = [0.2, -0.2, 0.0];
    if i == j { [1.5, 2.5, 2.0, 3.0, 3.5, 2.5][i] } else { entries[(i * j + i + j + 1) % 3] }
}

#[test]
fn lie_algebras_and_tops() {
    let G = std::array::from_fn(|i| std::array::from_fn(|j| metric(i, j)));
    let system = So4 { G };
    check_with_multipliers("so4", &system, (), |t, x| system.multipliers(t, x, &()));
    check("sl2_free", &Sl2Free, ());
    let system = Sl2;
    check_with_multipliers("sl2", &system, (), |t, x| system.multipliers(t, x, &()));
    let G = [[2.0, 0.5, 1.0 / 3.0], [0.5, 3.0, -0.25], [1.0 / 3.0, -0.25, 2.5]];
    let system = Heis { G };
    check_with_multipliers("heis", &system, (), |t, x| system.multipliers(t, x, &()));
    check("heis_free", &HeisFree { G }, ());
    let system = HeisR3 { G };
    check_with_multipliers("heis", &system, (), |t, x| system.multipliers(t, x, &()));
    let system = HeisCoframe { G };
    check_with_multipliers("heis", &system, (), |t, x| system.multipliers(t, x, &()));
}

#[test]
fn satellites_and_spheres() {
    check("heavy_top", &HeavyTop { I: INERTIA }, ());
    let system = VeselovaOn { I: INERTIA };
    check_with_multipliers("veselova_pot", &system, (), |t, x| system.multipliers(t, x, &()));
    let system = VeselovaAffine { I: INERTIA };
    check_with_multipliers("veselova_affine", &system, (), |t, x| system.multipliers(t, x, &()));
    let system = BodySpeed { I: INERTIA };
    check_with_multipliers("body_speed", &system, (), |t, x| system.multipliers(t, x, &()));
    check(
        "satellite",
        &Satellite { I: [[3.0, 0.1, 0.0], [0.1, 4.0, -0.2], [0.0, -0.2, 5.0]] },
        SatelliteInput { u1: 0.4, u2: -0.9 },
    );
    check("spherical", &SphericalOnSphere { l: 1.5, gr: 9.81 }, ());
}

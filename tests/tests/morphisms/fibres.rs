//! Quotients by a part of an embedded family: what does not change along the group is written in the
//! coordinates that are left, over the embedded base.

use nonholonomic::prelude::*;

use super::support::reconstructs;

macro_rules! attitude {
    ($(#[$doc:meta])* $name:ident { $($lagrangian:tt)* } { $($more:tt)* }) => {
        $(#[$doc])*
        #[nonholonomic(
            base { R[3][3] }
            on {
                for i in 0..3 { for j in 0..i { sum(k in 0..3: R[k][i] * R[k][j]) = 0; } sum(k in 0..3: R[k][i]^2) = 1; }
            }
            basis { w[3] }
            anchor { for i in 0..3 { der(R[i]) = cross(R[i], w); } }
            brackets so(3) { w }
            lagrangian { $($lagrangian)* }
            $($more)*
        )]
        #[derive(Clone, Copy, Debug)]
        struct $name {
            A: f64,
            m: f64,
            c: [f64; 3],
        }
    };
}

attitude! {
    /// A body whose kinetic energy is written with all rows.
    Rows { A / 2 * w[2]^2 + m / 2 * sum(i in 0..3: dot(R[i], w)^2) - dot(c, R[2]) } {}
}
quotient! { Rows -> #[derive(Clone, Copy, Debug)] struct RowsOnSphere by { R[0], R[1] } }

attitude! {
    /// Roots and products of what is left, a force and a constraint, none of them without the other rows.
    Tangled {
        A / 2 * w[2]^2 + m / 2 * dot(w, w) - m * sqrt(1 + R[0][0]^2 + R[1][0]^2)
            - c[0] * (R[0][1] * R[1][2] - R[0][2] * R[1][1]) / (2 + R[0][2]^2 + R[1][2]^2)
    } {
        constraints { sum(i in 0..3: R[i][1] * dot(R[i], w)) = R[0][0] * R[0][2] + R[1][0] * R[1][2]; }
        forces { w[2]: -c[1] * (R[0][2]^2 + R[1][2]^2) * w[2]; }
    }
}
quotient! { Tangled -> #[derive(Clone, Copy, Debug)] struct TangledOnSphere by { R[0], R[1] } }

/// A particle on a sphere, by the rotations of space; only its height matters.
#[nonholonomic(
    base { x[3] }
    on { dot(x, x) = 1; }
    basis { w[3] }
    anchor { der(x) = cross(w, x); }
    brackets { [w[0], w[1]] = -w[2]; [w[1], w[2]] = -w[0]; [w[2], w[0]] = -w[1]; }
    lagrangian { m / 2 * dot(w, w) + m / 4 * w[2]^2 - g * x[2] }
)]
#[derive(Clone, Copy, Debug)]
struct Particle {
    m: f64,
    g: f64,
}

quotient! {
    Particle -> #[derive(Clone, Copy, Debug)] struct Height by { x[0], x[1] } {
        velocities { u = x[0] * w[0] + x[1] * w[1]; v = x[0] * w[1] - x[1] * w[0]; s = w[2]; }
    }
}

/// An almost Lie algebroid: the kinetic energy is that of a point, the brackets are of no vector fields.
#[nonholonomic(
    base { x, y, q }
    basis { v, w }
    anchor { der(x) = v * cos(q); der(y) = v * sin(q); der(q) = w; }
    brackets { [w, v] = k * w + sin(q) * v; }
    almost;
    lagrangian { m / 2 * (v^2 + w^2) + k / 3 * v * w * cos(q) }
)]
#[derive(Clone, Copy, Debug)]
struct Lawless {
    m: f64,
    k: f64,
}

quotient! { Lawless -> #[derive(Clone, Copy, Debug)] struct LawlessHeading by { x, y } }

#[test]
fn rows_of_a_rotation() {
    let (sin, cos) = 0.5_f64.sin_cos();
    #[allow(non_snake_case, reason = "as the coordinates are called")]
    let R = [[cos, 0.0, sin], [0.0, 1.0, 0.0], [-sin, 0.0, cos]];
    let rows = Rows { A: 0.7, m: 1.2, c: [0.1, 0.2, 0.7] };
    let start = RowsState { R, w: [0.4, 0.7, -0.3] };
    reconstructs::<_, RowsOnSphere>(&rows, start, ());
    // |R[2]| = 1 is an identity of what is left
    let mut off = RowsOnSphereState { R_2_0: 0.6, R_2_1: 0.8, R_2_2: 1e-3, ..Default::default() };
    rows.reduced().normalize(&mut off).unwrap();
    let norm = off.R_2_0.powi(2) + off.R_2_1.powi(2) + off.R_2_2.powi(2);
    assert!((norm - 1.0).abs() < 1e-15, "{norm}");
    let tangled = Tangled { A: 0.7, m: 1.2, c: [0.1, 0.2, 0.7] };
    // the constraint: w₁ = −R[2][0] R[2][2]
    let start = TangledState { R, w: [0.4, 0.0, -0.3] };
    let mut start = start;
    start.w[1] = sin * cos;
    reconstructs::<_, TangledOnSphere>(&tangled, start, ());
}

#[test]
fn the_height_on_a_sphere() {
    let start = ParticleState { x: [0.48, 0.6, 0.64], w: [0.3, -0.5, 0.8] };
    reconstructs::<_, Height>(&Particle { m: 1.3, g: 0.4 }, start, ());
    assert!(Height::REPORT.contains("base of dimension 1"), "{}", Height::REPORT);
}

#[test]
fn almost_lie_algebroids_have_quotients() {
    let start = LawlessState { x: 0.2, y: -0.1, q: 0.4, v: 0.8, w: 0.5 };
    reconstructs::<_, LawlessHeading>(&Lawless { m: 1.2, k: 0.3 }, start, ());
    assert!(LawlessHeading::REPORT.contains("an almost Lie algebroid"), "{}", LawlessHeading::REPORT);
}

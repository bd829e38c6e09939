//! Loops that are closed by more equations than are independent where they hold (`redundant`), and cannot be solved for
//! lengths: points of N are found modulo powers of primes. The motions are those with the one coordinate that there is.

use nonholonomic::prelude::*;

/// Three cranks of one length under a beam: the second loop follows from the first, up to what turns the beam.
#[nonholonomic(
    base { a[3], beam }
    let e(q) = [cos(q), sin(q)];
    let pin[k in 0..3] = [k * l, 0] + r * e(a[k]);
    holonomic {
        for k in 1..3 { closure: pin[0] + k * l * e(beam) - pin[k] = 0; }
        redundant;
    }
    lagrangian {
        sum(k in 0..3: J / 2 * der(a[k])^2) + kinetic(m, I, pin[0] + l * e(beam), beam)
            - m * g * (pin[0] + l * e(beam))[1]
    }
)]
#[derive(Clone, Copy, Debug)]
struct Cranks {
    l: f64,
    r: f64,
    J: f64,
    m: f64,
    I: f64,
    g: f64,
}

const CRANKS: Cranks = Cranks { l: 0.4, r: 0.25, J: 0.01, m: 2.0, I: 0.03, g: 9.81 };

/// Six rods and hinges, each axis at a right angle to the next (Bricard): closed by twelve equations, of which five are
/// independent.
#[nonholonomic(
    base { q[6] }
    let e(a) = [cos(a), sin(a), 0];
    let up(a) = [[cos(a), 0, sin(a)], [sin(a), 0, -cos(a)], [0, 1, 0]];
    let down(a) = [[cos(a), 0, -sin(a)], [sin(a), 0, cos(a)], [0, -1, 0]];
    let A1 = up(q[0]);
    let A2 = A1 * down(q[1]);
    let A3 = A2 * up(q[2]);
    let A4 = A3 * down(q[3]);
    let A5 = A4 * up(q[4]);
    let p1 = l * e(q[0]);
    let p2 = p1 + l * A1 * e(q[1]);
    let p3 = p2 + l * A2 * e(q[2]);
    let p4 = p3 + l * A3 * e(q[3]);
    let p5 = p4 + l * A4 * e(q[4]);
    let rod(u, v) = m / 6 * (dot(der(u), der(u)) + dot(der(u), der(v)) + dot(der(v), der(v))) - m * g * (u + v)[2] / 2;
    holonomic {
        place: p5 + l * A5 * e(q[5]) = 0;
        attitude: A5 * down(q[5]) = identity(3);
        redundant;
    }
    lagrangian { m / 6 * dot(der(p1), der(p1)) - m * g * p1[2] / 2 + rod(p1, p2) + rod(p2, p3) + rod(p3, p4) + rod(p4, p5) }
)]
#[derive(Clone, Copy, Debug)]
struct Bricard {
    l: f64,
    m: f64,
    g: f64,
}

const BRICARD: Bricard = Bricard { l: 1.0, m: 1.0, g: 9.81 };

/// Closed with the angles a, b, a, b, a, b, where cos a cos b + cos a + cos b = 0.
fn trihedral(a: f64, rate: f64) -> BricardState {
    let b = (-a.cos() / (1.0 + a.cos())).acos();
    let slope = -a.sin() * (1.0 + b.cos()) / (b.sin() * (1.0 + a.cos()));
    BricardState {
        q: [a, b, a, b, a, b],
        q_dot: [rate, slope * rate, rate, slope * rate, rate, slope * rate],
    }
}

/// A table on two pairs of bars of one length, one above the other, on a sliding foot; without masses but those two.
#[nonholonomic(
    base { foot, a, b, c, d, height }
    let e(q) = [cos(q), sin(q)];
    let back(q) = [-cos(q), sin(q)];
    holonomic {
        lower: L * e(a) = [foot, 0] + L * back(b);
        upper: L * e(c) = [foot, 0] + L * back(d);
        straight: c = a;
        table: height = L * (sin(a) + sin(c));
        redundant;
    }
    lagrangian { M / 2 * der(height)^2 + m / 2 * der(foot)^2 - M * g * height }
)]
#[derive(Clone, Copy, Debug)]
struct Scissors {
    L: f64,
    M: f64,
    m: f64,
    g: f64,
}

fn are_small<const N: usize>(residual: impl Into<[f64; N]>, within: f64) {
    let left = residual.into();
    assert!(left.iter().all(|left| left.abs() < within), "{left:?}");
}

/// A bar's angle that is also compared as a number, and a foot that is solved for.
#[test]
fn a_lifting_table_falls() {
    let machine = Scissors { L: 0.8, M: 30.0, m: 2.0, g: 9.81 };
    let Scissors { L, M, m, g } = machine;
    let (angle, rate) = (0.6_f64, -0.3);
    let (s, c) = angle.sin_cos();
    let state = ScissorsState {
        foot: 2.0 * L * c,
        a: angle,
        b: angle,
        c: angle,
        d: angle,
        height: 2.0 * L * s,
        foot_dot: -2.0 * L * s * rate,
        a_dot: rate,
        b_dot: rate,
        c_dot: rate,
        d_dot: rate,
        height_dot: 2.0 * L * c * rate,
    };
    let rates = machine.derivative(0.0, &state, &());
    // 2 L (M c^2 + m s^2) a'' = 2 L (M - m) s c a'^2 - M g c
    let expected = ((M - m) * s * c * rate * rate - M * g * c / (2.0 * L)) / (M * c * c + m * s * s);
    for found in [rates.a_dot, rates.b_dot, rates.c_dot, rates.d_dot] {
        assert!((found - expected).abs() < 1e-12 * expected.abs(), "{found} {expected}");
    }
    let table = 2.0 * L * (c * expected - s * rate * rate);
    assert!((rates.height_dot - table).abs() < 1e-12 * table.abs(), "{} {table}", rates.height_dot);
}

#[test]
fn three_cranks_swing_like_one() {
    let Cranks { r, J, m, g, .. } = CRANKS;
    let start = CranksState { a: [0.3; 3], beam: 0.0, a_dot: [1.5; 3], beam_dot: 0.0 };
    let rates = CRANKS.derivative(0.0, &start, &());
    // (3 J + m r^2) a'' = -m g r cos a
    let expected = -m * g * r * 0.3_f64.cos() / (3.0 * J + m * r * r);
    for found in rates.a_dot {
        assert!((found - expected).abs() < 1e-12 * expected.abs(), "{found} {expected}");
    }
    assert!(rates.beam_dot.abs() < 1e-12 * expected.abs(), "{}", rates.beam_dot);
    let mut sim = Integrator::new(CRANKS, Dopri5::new().rtol(1e-9).atol(1e-9), 0.0, start);
    sim.advance_to(1.0).unwrap();
    let end = *sim.state();
    are_small::<7>(CRANKS.constraint_residual(0.0, &end), 1e-12);
    assert!((end.a[0] - 0.3).abs() > 1.0);
    let drift = CRANKS.energy(0.0, &end) - CRANKS.energy(0.0, &start);
    assert!(drift.abs() < 1e-7, "{drift:e}");
}

#[test]
fn a_loop_in_space_moves_by_its_one_coordinate() {
    let start = trihedral(1.2, 0.7);
    are_small::<17>(BRICARD.constraint_residual(0.0, &start), 1e-14);
    // reference/bricard.py
    let expected = [1.188_844_082_560_149, -1.031_124_691_967_907_6];
    for (found, place) in BRICARD.derivative(0.0, &start, &()).q_dot.iter().zip(0..) {
        assert!((found - expected[place % 2]).abs() < 1e-12, "{found} {}", expected[place % 2]);
    }
    let mut sim = Integrator::new(BRICARD, Dopri5::new().rtol(1e-10).atol(1e-10), 0.0, start);
    sim.advance_to(0.4).unwrap();
    let end = *sim.state();
    are_small::<17>(BRICARD.constraint_residual(0.0, &end), 1e-12);
    let expected = trihedral(end.q[0], end.q_dot[0]);
    for (found, expected) in end.to_array().iter().zip(expected.to_array()) {
        assert!((found - expected).abs() < 1e-9, "{end:?}");
    }
    assert!((end.q[0] - 1.2).abs() > 0.3);
    let drift = BRICARD.energy(0.0, &end) - BRICARD.energy(0.0, &start);
    assert!(drift.abs() < 1e-8, "{drift:e}");
}

/// From angles that are off by a tenth, and with one of them held.
#[test]
fn a_loop_in_space_is_assembled() {
    let near = trihedral(1.2, 0.7);
    let mut guess = near;
    for (angle, off) in guess.q.iter_mut().zip([0.06, -0.1, 0.03, 0.08, -0.05, 0.1]) {
        *angle += off;
    }
    let found = BRICARD.assemble(0.0, &guess).unwrap();
    are_small::<17>(BRICARD.constraint_residual(0.0, &found), 1e-14);
    let expected = trihedral(found.q[0], found.q_dot[0]);
    for (found, expected) in found.to_array().iter().zip(expected.to_array()) {
        assert!((found - expected).abs() < 1e-12, "{found} {expected}");
    }
    let held = BRICARD.assemble_holding(0.0, &guess, &[BricardCoordinate::q_0]).unwrap();
    assert_eq!((held.q[0], held.q_dot[0]), (guess.q[0], 0.7));
    assert!((held.q[3] - trihedral(guess.q[0], 0.7).q[3]).abs() < 1e-13);
}

//! Sarrus' linkage: a table on two pairs of plates whose hinges are at right angles stays level. Its angles are zero, in every
//! digit that rounding leaves of them.

use nonholonomic::prelude::*;

#[nonholonomic(
    base { a1, a2, b1, b2, z, tx, ty }
    let table = rot_x(tx) * rot_y(ty);
    holonomic {
        first: [d + l * cos(a1) + l * cos(a2), 0, l * sin(a1) + l * sin(a2) - z] - table * [d, 0, 0] = 0;
        along: (table * [0, 1, 0])[2] = 0;
        second: [0, d + l * cos(b1) + l * cos(b2), l * sin(b1) + l * sin(b2) - z] - table * [0, d, 0] = 0;
        across: (table * [1, 0, 0])[2] = 0;
        redundant;
    }
    lagrangian {
        J / 2 * (der(a1)^2 + der(a2)^2 + der(b1)^2 + der(b2)^2) + kinetic(m, I, [0, 0, z], table) - m * g * z
    }
)]
#[derive(Clone, Copy, Debug)]
struct Table {
    d: f64,
    l: f64,
    J: f64,
    m: f64,
    I: [f64; 3],
    g: f64,
}

const TABLE: Table = Table { d: 0.3, l: 0.5, J: 0.02, m: 1.2, I: [0.1, 0.15, 0.2], g: 9.81 };

/// All links at an angle, rising or falling.
fn at(angle: f64, rate: f64) -> TableState {
    let (other, z, z_dot) = (core::f64::consts::PI - angle, angle.sin(), angle.cos() * rate);
    let turned = TableState { a1: angle, a2: other, b1: angle, b2: other, z, ..TableState::default() };
    TableState { a1_dot: rate, a2_dot: -rate, b1_dot: rate, b2_dot: -rate, z_dot, ..turned }
}

#[test]
fn a_table_that_falls_stays_level() {
    let mut start = at(0.7, 0.15);
    TABLE.project(0.0, &mut start).unwrap();
    let energy = TABLE.energy(0.0, &start);
    let mut by_fixed = Integrator::new(TABLE, Rk4::new(1e-3), 0.0, start);
    by_fixed.advance_to(0.3).unwrap();
    let mut adaptive = Integrator::new(TABLE, Dopri5::new().rtol(1e-9), 0.0, start);
    adaptive.advance_to(0.3).unwrap();
    for state in [by_fixed.state(), adaptive.state()] {
        assert!(state.tx.abs() < 1e-17 && state.ty.abs() < 1e-17, "{state:?}");
        assert!((TABLE.energy(0.0, state) / energy - 1.0).abs() < 1e-8);
        assert!((state.z - state.a1.sin()).abs() < 1e-13);
    }
    assert!((by_fixed.state().z - adaptive.state().z).abs() < 1e-7);
}

#[test]
fn a_table_that_is_askew_is_put_level() {
    let random = |number: u32| 2.0 * (f64::from(number) * 0.754_877_666).fract() - 1.0;
    for number in 0..200 {
        let size = [1e-4, 1e-2, 0.1, 0.3][number as usize % 4];
        let mut guess = at(0.7, 0.15).to_array();
        for (place, x) in (0_u32..).zip(&mut guess) {
            *x += size * random(14 * number + place);
        }
        let found = TABLE.assemble(0.0, &TableState::from_array(guess)).unwrap();
        let left = Constrained::constraint_residual(&TABLE, 0.0, &found);
        assert!(left.iter().all(|left| left.abs() < 1e-14), "{number}: {left:?}");
    }
}

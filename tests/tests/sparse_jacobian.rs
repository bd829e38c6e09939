//! The entries of a Jacobian that are not always zero, beside the matrices.

use nonholonomic::prelude::*;

/// A rolling disk with a driven wheel and a lag: much of the matrix is zero.
#[nonholonomic(
    base   { x, y, theta, phi }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) + I / 2 * der(theta)^2 + J / 2 * der(phi)^2 }
    constraints {
        der(x) = r * cos(theta) * der(phi);
        der(y) = r * sin(theta) * der(phi);
    }
    inputs    { torque, steer }
    auxiliary { der(lag) = k * (torque - lag); }
    forces    { phi: lag; theta: steer * cos(phi); }
    emit      { jacobian, sparse_jacobian }
)]
#[derive(Clone, Copy, Debug)]
#[allow(non_snake_case, reason = "parameters are written as in mechanics: I, J")]
struct Disk<T> {
    m: T,
    I: T,
    J: T,
    r: T,
    k: T,
}

/// Asked for alone, without inputs.
#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 - k / 4 * x^4 }
    emit { sparse_jacobian }
)]
#[derive(Clone, Copy, Debug)]
struct Spring {
    m: f64,
    k: f64,
}

#[test]
fn entries_stand_where_the_pattern_says() {
    let disk = Disk { m: 1.2, I: 0.3, J: 0.2, r: 0.4, k: 5.0 };
    let state = DiskState::from([0.1, -0.2, 0.7, 0.4, 1.3, -0.8, 0.5]);
    let input = DiskInput { torque: 0.3, steer: -0.6 };
    let (a, b) = disk.jacobian(0.0, &state, &input);
    let values = disk.sparse_jacobian(0.0, &state, &input);
    let (rates, with_rates) = disk.sparse_linearized(0.0, &state, &input);
    assert_eq!(rates, disk.derivative(0.0, &state, &input));
    for (with_rates, alone) in with_rates.iter().zip(&values) {
        assert!((with_rates - alone).abs() <= 1e-15 * alone.abs(), "{with_rates} for {alone}");
    }
    let n = a.nrows();
    let mut dense = vec![vec![0.0; n + b.ncols()]; n];
    let mut before = None;
    for ((value, row), column) in
        values.iter().zip(Disk::<f64>::JACOBIAN_ROWS).zip(Disk::<f64>::JACOBIAN_COLUMNS)
    {
        assert!(before < Some((column, row)), "column by column, each once");
        before = Some((column, row));
        dense[row][column] = *value;
    }
    for (row, entries) in dense.iter().enumerate() {
        for (column, entry) in entries.iter().enumerate() {
            let wanted = if column < n { a[(row, column)] } else { b[(row, column - n)] };
            assert!(
                (entry - wanted).abs() <= 1e-15 * wanted.abs(),
                "({row}, {column}): {entry} for {wanted}"
            );
        }
    }
    // 9 columns of 7 entries
    assert!(values.len() <= 16, "{}", values.len());
}

#[test]
fn nothing_else_is_needed() {
    let spring = Spring { m: 2.0, k: 3.0 };
    let state = SpringState { x: 0.5, x_dot: 0.1 };
    let values = spring.sparse_jacobian(0.0, &state, &());
    assert_eq!(spring.sparse_linearized(0.0, &state, &()), (spring.derivative(0.0, &state, &()), values));
    assert_eq!((Spring::JACOBIAN_ROWS, Spring::JACOBIAN_COLUMNS), ([1, 0], [0, 1]));
    assert!(
        (values[0] + 3.0 * 3.0 * 0.25 / 2.0).abs() < 1e-15 && (values[1] - 1.0).abs() < 1e-15,
        "{values:?}"
    );
}

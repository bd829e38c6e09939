//! Quotients that are constructed: the declaration of the reduced system is derived.

use nonholonomic::prelude::*;

use super::support::reconstructs;

/// A sleigh with friction on a plane.
#[nonholonomic(
    base { theta, x, y }
    lagrangian {
        let xc = der(x) - (a * sin(theta) + b * cos(theta)) * der(theta);
        let yc = der(y) + (a * cos(theta) - b * sin(theta)) * der(theta);
        J / 2 * der(theta)^2 + m / 2 * (xc^2 + yc^2)
    }
    constraints { blade: cos(theta) * der(y) - sin(theta) * der(x) = 0; }
    forces { theta: torque - c * der(theta); x: -k * der(x); y: -k * der(y); }
    inputs { torque }
    assume { m > 0; J > 0; }
)]
#[derive(Clone, Copy, Debug)]
struct Sleigh<T> {
    m: T,
    J: T,
    a: T,
    b: T,
    c: T,
    k: T,
}

quotient! {
    Sleigh ->
    /// On se(2).
    #[derive(Clone, Copy, Debug)]
    struct SleighOnAlgebra by { theta, x, y } {
        velocities {
            omega = der(theta);
            v[0] = cos(theta) * der(x) + sin(theta) * der(y);
            v[1] = cos(theta) * der(y) - sin(theta) * der(x);
        }
        emit { multipliers }
        outputs { speed = abs(v[0]); }
    }
}

#[test]
fn sleigh() {
    let sleigh = Sleigh { m: 1.3, J: 0.7, a: 0.4, b: -0.2, c: 0.1, k: 0.05 };
    let (sin, cos) = 0.6_f64.sin_cos();
    let start =
        SleighState { theta: 0.6, x: 0.3, y: -0.2, theta_dot: 1.2, x_dot: 0.9 * cos, y_dot: 0.9 * sin };
    reconstructs::<_, SleighOnAlgebra<f64>>(&sleigh, start, SleighInput { torque: 0.25 });
    let report = SleighOnAlgebra::<f64>::REPORT;
    assert!(report.contains("[omega, v[0]] = v[1]"), "{report}");
    let reduced: SleighOnAlgebra<f64> = sleigh.reduced();
    let state = sleigh.reduce(0.0, &start);
    let input = sleigh.reduce_input(0.0, &start, &SleighInput { torque: 0.25 });
    assert!((reduced.outputs(0.0, &state, &input).speed - 0.9).abs() < 1e-15);
    let wrong = Sleigh { J: -1.0, ..sleigh };
    let wrong: SleighOnAlgebra<f64> = wrong.reduced();
    assert!(wrong.validate().is_err());
}

/// A robot with two wheels: none of its constraints is invariant, what they allow is.
#[nonholonomic(
    base { psi[2], x, y, theta }
    lagrangian {
        let lateral = -der(x) * sin(theta) + der(y) * cos(theta);
        m / 2 * (der(x)^2 + der(y)^2) + m0 * l * lateral * der(theta)
            + J / 2 * der(theta)^2 + J2 / 2 * (der(psi[0])^2 + der(psi[1])^2)
    }
    constraints {
        der(x) = -R / 2 * (der(psi[0]) + der(psi[1])) * cos(theta);
        der(y) = -R / 2 * (der(psi[0]) + der(psi[1])) * sin(theta);
        der(theta) = R / (2 * c) * (der(psi[1]) - der(psi[0]));
    }
    forces { psi[0]: torque[0]; psi[1]: torque[1] * sin(psi[0]); }
    inputs { torque[2] }
)]
#[derive(Clone, Copy, Debug)]
struct Robot {
    m: f64,
    m0: f64,
    l: f64,
    J: f64,
    J2: f64,
    c: f64,
    R: f64,
}

quotient! {
    Robot -> #[derive(Clone, Copy, Debug)] struct AtiyahRobot by { x, y, theta } {
        velocities {
            dpsi = [der(psi[0]), der(psi[1])];
            w1 = cos(theta) * der(x) + sin(theta) * der(y);
            w2 = -sin(theta) * der(x) + cos(theta) * der(y);
            w3 = der(theta);
        }
    }
}

#[test]
fn robot() {
    let robot = Robot { m: 3.0, m0: 2.5, l: 0.2, J: 0.9, J2: 0.05, c: 0.3, R: 0.15 };
    let start = RobotState { psi: [0.1, -0.2], x: 1.0, y: 2.0, theta: 0.7, psi_dot: [2.0, -3.0] };
    reconstructs::<_, AtiyahRobot>(&robot, start, RobotInput { torque: [0.3, -0.1] });
    let report = AtiyahRobot::REPORT;
    assert!(report.contains("adapted"), "{report}");
}

/// A heavy body whose attitude is a rotation matrix: only the vertical matters.
#[nonholonomic(
    base { R[3][3] }
    on { for i in 0..3 { for j in 0..i { sum(k in 0..3: R[k][i] * R[k][j]) = 0; } sum(k in 0..3: R[k][i]^2) = 1; } }
    basis { w[3] }
    anchor { for i in 0..3 { der(R[i]) = cross(R[i], w); } }
    lagrangian { (A * w[0]^2 + B * w[1]^2 + C * w[2]^2) / 2 - dot(c, R[2]) }
    constraints { dot(R[2], w) = rate; }
    brackets so(3) { w }
)]
#[derive(Clone, Copy, Debug)]
struct Heavy {
    A: f64,
    B: f64,
    C: f64,
    c: [f64; 3],
    rate: f64,
}

quotient! {
    Heavy -> #[derive(Clone, Copy, Debug)] struct HeavyOnSphere by { R[0], R[1] } {
        on { R_2_0^2 + R_2_1^2 + R_2_2^2 = 1; }
    }
}

#[test]
fn heavy_body() {
    let heavy = Heavy { A: 1.0, B: 1.6, C: 2.1, c: [0.1, 0.2, 0.7], rate: 0.3 };
    let (sin, cos) = 0.5_f64.sin_cos();
    let start = HeavyState {
        R: [[cos, 0.0, sin], [0.0, 1.0, 0.0], [-sin, 0.0, cos]],
        w: [cos - 0.3 * sin, 0.7, sin + 0.3 * cos],
    };
    reconstructs::<_, HeavyOnSphere>(&heavy, start, ());
}

/// A pendulum on a cart that nothing holds: the place is cyclic in the velocities as they are.
#[nonholonomic(
    base { x, phi }
    lagrangian { M / 2 * der(x)^2 + m / 2 * (der(x)^2 + 2 * l * cos(phi) * der(x) * der(phi) + l^2 * der(phi)^2) + m * g * l * cos(phi) }
)]
#[derive(Clone, Copy, Debug)]
struct Cart {
    M: f64,
    m: f64,
    l: f64,
    g: f64,
}

quotient! { Cart -> #[derive(Clone, Copy, Debug)] struct CartAnywhere by { x } }

#[test]
fn cart() {
    let cart = Cart { M: 2.0, m: 0.5, l: 0.7, g: 9.81 };
    reconstructs::<_, CartAnywhere>(&cart, CartState { x: 1.0, phi: 0.8, x_dot: 0.1, phi_dot: -0.4 }, ());
}

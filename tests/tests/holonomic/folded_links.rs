//! A governor whose links are as long as its arms: they may lie on these, where all of them turn by themselves and one of the
//! constraints says what another says. What is meant is the rest.

use nonholonomic::prelude::*;

/// Two arms hang from the origin and turn about the vertical at the rate w; two links from them carry a load.
#[nonholonomic(
    base { x, z, X, Z, s }
    lagrangian {
        m / 2 * (der(x)^2 + der(z)^2 + der(X)^2 + der(Z)^2) + M / 2 * der(s)^2
        + m / 2 * w^2 * (x^2 + X^2) - g * (m * (z + Z) + M * s)
    }
    holonomic {
        arm: x^2 + z^2 = l^2;
        link: x^2 + (z - s)^2 = l^2;
        other_arm: X^2 + Z^2 = l^2;
        other_link: X^2 + (Z - s)^2 = l^2;
    }
    assume { m > 0; M > 0; g > 0; l > 0; }
)]
#[derive(Clone, Copy, Debug)]
struct ByPoints {
    m: f64,
    M: f64,
    g: f64,
    l: f64,
    w: f64,
}

/// The same by the angles of the arms.
#[nonholonomic(
    base { a, b, s }
    lagrangian {
        m * l^2 / 2 * (der(a)^2 + der(b)^2 + w^2 * (sin(a)^2 + sin(b)^2)) + M / 2 * der(s)^2
        + g * (m * l * (cos(a) + cos(b)) - M * s)
    }
    holonomic {
        link: (l * sin(a))^2 + (s + l * cos(a))^2 = l^2;
        other_link: (l * sin(b))^2 + (s + l * cos(b))^2 = l^2;
    }
    assume { m > 0; M > 0; g > 0; l > 0; }
)]
#[derive(Clone, Copy, Debug)]
struct ByAngles {
    m: f64,
    M: f64,
    g: f64,
    l: f64,
    w: f64,
}

/// And by what is left: x = −X = l sin a, z = Z = −l cos a, s = 2 z.
#[nonholonomic(
    base { a }
    lagrangian {
        (m + 2 * M * sin(a)^2) * l^2 * der(a)^2 + m * l^2 * w^2 * sin(a)^2 + 2 * (m + M) * g * l * cos(a)
    }
)]
#[derive(Clone, Copy, Debug)]
struct ByOneAngle {
    m: f64,
    M: f64,
    g: f64,
    l: f64,
    w: f64,
}

const ONE: ByOneAngle = ByOneAngle { m: 0.7, M: 1.3, g: 9.81, l: 0.4, w: 12.0 };
const POINTS: ByPoints = ByPoints { m: ONE.m, M: ONE.M, g: ONE.g, l: ONE.l, w: ONE.w };
const ANGLES: ByAngles = ByAngles { m: ONE.m, M: ONE.M, g: ONE.g, l: ONE.l, w: ONE.w };

fn by_points(ByOneAngleState { a, a_dot }: ByOneAngleState) -> ByPointsState {
    let [x, z] = [ONE.l * a.sin(), -ONE.l * a.cos()];
    let [x_dot, z_dot] = [-z * a_dot, x * a_dot];
    ByPointsState {
        x,
        z,
        X: -x,
        Z: z,
        s: 2.0 * z,
        x_dot,
        z_dot,
        X_dot: -x_dot,
        Z_dot: z_dot,
        s_dot: 2.0 * z_dot,
    }
}

fn by_angles(one: ByOneAngleState) -> ByAnglesState {
    let ByPointsState { s, s_dot, .. } = by_points(one);
    ByAnglesState { a: one.a, b: one.a, s, a_dot: one.a_dot, b_dot: one.a_dot, s_dot }
}

#[test]
fn the_part_that_is_not_meant_is_told() {
    for report in [ByPoints::REPORT, ByAngles::REPORT] {
        assert!(report.contains("they hold as well "), "{report}");
    }
    // all of them are solved: links less arms say something of two heights alone
    assert!(!ByPoints::REPORT.contains("could not be solved"), "{}", ByPoints::REPORT);
    let place = "they hold as well where s = 0, ";
    assert!(ByPoints::REPORT.contains(place), "{}", ByPoints::REPORT);
    assert!(ByPoints::REPORT.contains("with 3 of the rates independent there"), "{}", ByPoints::REPORT);
}

#[test]
fn the_governor_swings_as_by_one_angle() {
    let begun = ByOneAngleState { a: 0.9, a_dot: 0.5 };
    let method = Dopri5::new().rtol(1e-11).atol(1e-12);
    let mut one = Integrator::new(ONE, method, 0.0, begun);
    let mut points = Integrator::new(POINTS, method, 0.0, by_points(begun));
    let mut angles = Integrator::new(ANGLES, method, 0.0, by_angles(begun));
    for tenth in 1..=50 {
        let time = f64::from(tenth) / 10.0;
        one.advance_to(time).unwrap();
        points.advance_to(time).unwrap();
        angles.advance_to(time).unwrap();
        let state = *one.state();
        for (found, wanted) in [
            (points.state().to_array().to_vec(), by_points(state).to_array().to_vec()),
            (angles.state().to_array().to_vec(), by_angles(state).to_array().to_vec()),
        ] {
            for (found, wanted) in found.iter().zip(wanted) {
                assert!((found - wanted).abs() < 1e-7, "{time}: {found} {wanted}");
            }
        }
    }
}

/// With the links on the arms these are pendulums of their own, which the multipliers do not tell.
#[test]
fn where_links_are_folded_a_run_does_not_begin() {
    let folded = ByPointsState { x: 0.24, z: -0.32, X: -0.32, Z: -0.24, ..ByPointsState::default() };
    let mut run = Integrator::new(POINTS, Dopri5::new(), 0.0, folded);
    let error = run.advance_to(1.0).unwrap_err();
    assert!(matches!(error, IntegrationError::OffConstraints { .. }), "{error:?}");
    let text = error.to_string();
    assert!(
        text.contains("no return to the constraints was found from there: their rates may be dependent"),
        "{text}"
    );
}

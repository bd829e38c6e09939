//! The car axis of the test set for initial value problems (Mazzia, Magherini, release 2.4; Schneider): a bar on two
//! springs, one of which follows a bumpy road, kept by a joint that moves with time. As an equation of index 3 it is
//! published with its multipliers.

use nonholonomic::AssemblyError;
use nonholonomic::prelude::*;

#[nonholonomic(
    base { xl, yl, xr, yr }
    let yb = r * sin(omega * t);
    let xb = sqrt(L^2 - yb^2);
    let left = sqrt(xl^2 + yl^2);
    let right = sqrt((xr - xb)^2 + (yr - yb)^2);
    holonomic {
        joint: xl * xb + yl * yb = 0;
        bar: (xl - xr)^2 + (yl - yr)^2 = L^2;
    }
    lagrangian {
        mu / 2 * (der(xl)^2 + der(yl)^2 + der(xr)^2 + der(yr)^2)
        - (left - L0)^2 / 2 - (right - L0)^2 / 2 - mu * (yl + yr)
    }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct CarAxis {
    L: f64,
    L0: f64,
    mu: f64,
    r: f64,
    omega: f64,
}

/// Two masses of ε² M/2 with ε = 0.01, M = 10.
const AXIS: CarAxis = CarAxis { L: 1.0, L0: 0.5, mu: 5e-4, r: 0.1, omega: 10.0 };

const START: CarAxisState =
    CarAxisState { xl: 0.0, yl: 0.5, xr: 1.0, yr: 0.5, xl_dot: -0.5, yl_dot: 0.0, xr_dot: -0.5, yr_dot: 0.0 };

/// Positions, velocities and multipliers at t = 3, to the digits in which the published solutions agree.
const END: [f64; 10] = [
    0.049_345_578_427_5,
    0.496_989_460_230,
    1.041_742_524_885,
    0.373_911_027_265,
    -0.077_058_368_40,
    0.007_446_866_59,
    0.017_556_815_75,
    0.770_341_043_78,
    -0.004_736_886_7,
    -0.001_104_680_4,
];

#[test]
fn the_end_is_the_published_one() {
    let mut sim = Integrator::new(AXIS, Dop853::new().rtol(1e-12).atol(1e-12), 0.0, START);
    sim.advance_to(3.0).unwrap();
    let state = *sim.state();
    for (found, published) in state.to_array().iter().zip(END) {
        assert!((found - published).abs() < 2e-10, "{found} {published}");
    }
    let lambda = AXIS.multipliers(3.0, &state, &());
    for (found, published) in [lambda.joint, lambda.bar].iter().zip(&END[8..]) {
        assert!((found - published).abs() < 1e-8, "{found} {published}");
    }
    let left: [f64; 4] = AXIS.constraint_residual(3.0, &state).into();
    assert!(left.iter().all(|left| left.abs() < 1e-14), "{left:?}");
}

#[test]
fn a_rough_guess_is_put_on_the_road() {
    use CarAxisCoordinate::{xr, yl};
    let guess = CarAxisState { xl: 0.2, yr: 0.3, xr: 0.95, yl: 0.4, ..START };
    let found = AXIS.assemble_holding(0.1, &guess, &[xr, yl]).unwrap();
    let left: [f64; 4] = AXIS.constraint_residual(0.1, &found).into();
    assert!(left.iter().all(|left| left.abs() < 1e-15), "{left:?}");
    assert_eq!((found.xr, found.yl, found.xr_dot), (0.95, 0.4, -0.5));
    // farther out the bar is too short
    let error = AXIS.assemble_holding(0.1, &CarAxisState { xr: 1.0, ..guess }, &[xr, yl]).unwrap_err();
    assert!(matches!(error, AssemblyError::NoSolution { constraint: "bar", .. }), "{error:?}");
}

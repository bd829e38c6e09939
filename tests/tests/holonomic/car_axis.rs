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

/// Positions, velocities and multipliers at t = 3 as published: subroutine `solut` of `caraxis.f`, revision 1.2, of the
/// test set's release 2.4.
const END: [f64; 10] = [
    0.049_345_578_427_556_29,
    0.496_989_460_230_332_4,
    1.041_742_524_885_4,
    0.373_911_027_265_221_4,
    -0.077_058_368_403_214_85,
    0.007_446_866_596_327_776,
    0.017_556_815_749_428_99,
    0.770_341_043_779_403,
    -0.004_736_886_750_784_63,
    -0.001_104_680_411_345_73,
];

/// Two methods of different kinds agree to 1e-12. What is published is 4e-13 of lengths, 5e-12 of velocities and 2e-10 of
/// multipliers away from both, and so are its velocities from what the bar allows.
#[test]
fn the_end_is_the_published_one() {
    let mut sim = Integrator::new(AXIS, Dop853::new().rtol(1e-14).atol(1e-14), 0.0, START);
    sim.advance_to(3.0).unwrap();
    let state = *sim.state();
    let lambda = AXIS.multipliers(3.0, &state, &());
    let bounds = [[4e-13; 4], [5e-12; 4]].concat().into_iter().chain([2e-10; 2]);
    for ((found, published), bound) in
        state.to_array().iter().chain(&[lambda.joint, lambda.bar]).zip(END).zip(bounds)
    {
        assert!((found - published).abs() < bound, "{found} {published}");
    }
    let mut other = Integrator::new(AXIS, GaussLegendre6::new(6e-4).compensated(), 0.0, START);
    other.advance_to(3.0).unwrap();
    for (one, other) in state.to_array().iter().zip(other.state().to_array()) {
        assert!((one - other).abs() < 1e-12, "{one} {other}");
    }
    let left: [f64; 4] = AXIS.constraint_residual(3.0, &state).into();
    assert!(left.iter().all(|left| left.abs() < 1e-14), "{left:?}");
    let mut published = [0.0; 8];
    published.copy_from_slice(&END[..8]);
    let left: [f64; 4] = AXIS.constraint_residual(3.0, &CarAxisState::from(published)).into();
    assert!(left[3].abs() > 5e-12, "{left:?}");
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

//! Embedded base coordinates: states off their identities are refused, and normalized on request.

use nh_tests::comparison;
use nh_tests::random::Random;
use nonholonomic::prelude::*;

/// Veselova's system: a body that does not turn about a direction fixed in space, with that
/// direction as a unit vector. No velocities are good for every direction.
#[nonholonomic(
    base { g[3] }
    on { dot(g, g) = 1; }
    basis { w[3] }
    anchor {
        der(g[0]) = g[1] * w[2] - g[2] * w[1];
        der(g[1]) = g[2] * w[0] - g[0] * w[2];
        der(g[2]) = g[0] * w[1] - g[1] * w[0];
    }
    brackets so(3) { w[0], w[1], w[2] }
    lagrangian { (A * w[0]^2 + B * w[1]^2 + C * w[2]^2) / 2 - k * g[2] }
    constraints { veselova: dot(g, w) = 0; }
)]
#[derive(Clone, Copy, Debug)]
#[allow(non_snake_case, reason = "as in mechanics")]
struct Unit {
    A: f64,
    B: f64,
    C: f64,
    k: f64,
}

/// A free body with its attitude as a rotation matrix, and all nine identities written down.
#[nonholonomic(
    base { R[3][3] }
    on {
        for i in 0..3 {
            sum(k in 0..3: R[k][i]^2) = 1;
            for j in 0..i { sum(k in 0..3: R[k][i] * R[k][j]) = 0; sum(k in 0..3: R[k][j] * R[k][i]) = 0; }
        }
    }
    basis { w[3] }
    anchor {
        for i in 0..3 {
            der(R[i][0]) = R[i][1] * w[2] - R[i][2] * w[1];
            der(R[i][1]) = R[i][2] * w[0] - R[i][0] * w[2];
            der(R[i][2]) = R[i][0] * w[1] - R[i][1] * w[0];
        }
    }
    brackets so(3) { w[0], w[1], w[2] }
    lagrangian { (A * w[0]^2 + B * w[1]^2 + C * w[2]^2) / 2 }
)]
#[derive(Clone, Copy, Debug)]
#[allow(non_snake_case, reason = "as in mechanics")]
struct Attitude {
    A: f64,
    B: f64,
    C: f64,
}

const UNIT: Unit = Unit { A: 1.0, B: 2.0, C: 2.5, k: 0.7 };
const ATTITUDE: Attitude = Attitude { A: 1.0, B: 2.0, C: 2.5 };

fn largest(x: &[f64]) -> f64 {
    comparison::largest(x.iter().copied())
}

#[test]
fn a_direction_is_normalized_by_the_shortest_way() {
    let mut random = Random::new(11);
    for _ in 0..100 {
        let given: [f64; 3] = std::array::from_fn(|_| random.between(-2.0, 2.0));
        let length = given.iter().map(|g| g * g).sum::<f64>().sqrt();
        if length < 0.2 {
            continue;
        }
        let mut state = UnitState { g: given, w: [1.0, 2.0, 3.0] };
        assert!((UNIT.identity_residual(&state)[0] - (length * length - 1.0)).abs() < 1e-14);
        UNIT.normalize(&mut state).unwrap();
        for (g, given) in state.g.iter().zip(given) {
            assert!((g - given / length).abs() < 4e-16, "{state:?}");
        }
        assert_eq!(state, UnitState { g: state.g, w: [1.0, 2.0, 3.0] });
        let once = state;
        UNIT.normalize(&mut state).unwrap();
        assert!((0..3).all(|i| (state.g[i] - once.g[i]).abs() < 2e-16));
        // and the velocities follow
        UNIT.project(0.0, &mut state).unwrap();
        assert!(largest(&Constrained::constraint_residual(&UNIT, 0.0, &state)) < 2e-15);
    }
    let zero = UnitState { w: [1.0; 3], ..UnitState::default() };
    let mut state = zero;
    let error = UNIT.project(0.0, &mut state).unwrap_err();
    assert_eq!((state, error.residual), (zero, 1.0));
}

#[test]
fn a_state_off_the_identities_is_refused() {
    let start = UnitState { g: [0.6, 0.0, 0.9], ..UnitState::default() };
    let mut sim = Integrator::new(UNIT, Rk4::new(0.1), 0.0, start);
    let error = sim.step().unwrap_err();
    let IntegrationError::InvalidState(fault) = error else { panic!("{error:?}") };
    assert!((fault.residual - 0.17).abs() < 1e-15, "{error}");
    assert!(error.to_string().ends_with("normalize it first"), "{error}");
    let mut near = UnitState { g: [0.6, 0.0, 0.8 + 5e-7], ..UnitState::default() };
    let mut sim = Integrator::new(UNIT, Rk4::new(0.1), 0.0, near);
    sim.step().unwrap();
    near.g[2] = 0.8 + 5e-6;
    sim.reset(0.0, near);
    assert!(matches!(sim.step(), Err(IntegrationError::InvalidState(_))));
    UNIT.normalize(&mut near).unwrap();
    sim.reset(0.0, near);
    sim.step().unwrap();
}

#[test]
fn redundant_identities_do_not_matter() {
    let mut random = Random::new(12);
    for _ in 0..50 {
        let entries = random.rotation();
        let mut moved = entries;
        for entry in &mut moved {
            *entry += random.between(-0.1, 0.1);
        }
        let rows = |e: [f64; 9]| [[e[0], e[1], e[2]], [e[3], e[4], e[5]], [e[6], e[7], e[8]]];
        let mut state = AttitudeState { R: rows(moved), w: [1.0; 3] };
        ATTITUDE.normalize(&mut state).unwrap();
        assert!(largest(&ATTITUDE.identity_residual(&state)) < 1e-15, "{state:?}");
        let change = state.R.iter().flatten().zip(moved).map(|(a, b)| a - b).collect::<Vec<_>>();
        assert!(largest(&change) < 0.25);
    }
}

#[test]
fn integrators_keep_to_the_identities_when_asked() {
    let mut start = UnitState { g: [0.6, 0.0, 0.8], w: [0.3, 1.0, -0.5] };
    UNIT.project(0.0, &mut start).unwrap();
    let mut drifting = Integrator::new(UNIT, Rk4::new(0.02), 0.0, start);
    let mut sim = Integrator::new(UNIT, Projected::new(Rk4::new(0.02), 10), 0.0, start);
    for _ in 0..20_000 {
        drifting.step().unwrap();
        sim.step().unwrap();
    }
    let off = |x: &UnitState| largest(&Constrained::constraint_residual(&UNIT, 0.0, x));
    let (without, with) = (off(drifting.state()), off(sim.state()));
    println!("{without:e} {with:e} {:?}", sim.statistics());
    assert!(with < 1e-15 && with < 1e-2 * without, "{with:e} {without:e}");
    // adapted states too, where only the identities can be lost
    let start = AttitudeState { R: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], w: [0.3, 1.0, -0.5] };
    let mut sim = Integrator::new(ATTITUDE, Projected::new(Dopri5::new().rtol(1e-5), 1), 0.0, start);
    sim.advance_to(50.0).unwrap();
    assert!(largest(&ATTITUDE.identity_residual(sim.state())) < 2e-15);
    assert_eq!(sim.statistics().projections, sim.statistics().steps);
}

//! Claims that are proved when a declaration is compiled, and what the reports say about constraints.

use nh_tests::comparison::{larger, largest};
use nh_tests::random::Random;
use nh_tests::systems::frames::{
    ChaplyginSphereOnSphere, ChaplyginSphereOnSphereState, ChargedParticleByConnection, FreeVeselova,
    FreeVeselovaState, SnakeboardBySpan, VeselovaOnRotations, VeselovaOnRotationsState,
};
use nh_tests::systems::particles::{ParticleX, ParticleXCoframe, ParticleY};
use nh_tests::systems::rotating_table::{BallOnRotatingTable, BallOnRotatingTableState};
use nh_tests::systems::snakeboard::Snakeboard;
use nonholonomic::prelude::*;

#[test]
fn the_moving_energy_is_conserved_where_the_energy_is_not() {
    for claim in ["spin", "contact_x", "contact_y", "moving"] {
        assert!(BallOnRotatingTable::REPORT.contains(&format!("  {claim} (claimed, and proved)\n")));
    }
    let report = BallOnRotatingTable::REPORT;
    assert!(report.contains("the moving energy E - xi.p"), "{report}");
    assert!(!report.contains("\n  the energy"), "{report}");
    assert!(report.contains("affine in the velocities"), "{report}");

    let BallOnRotatingTable { m, k2, Omega, .. } = TABLE;
    let moving = |x: &BallOnRotatingTableState| {
        let y = TABLE.velocity(0.0, x);
        TABLE.energy(0.0, x) - Omega * m * (x.x * y.dy - x.y * y.dx + k2 * y.wz)
    };
    let start = BallOnRotatingTableState { x: 0.4, y: -0.3, wx: 1.2, wy: 0.5, wz: -0.8 };
    let mut sim = Integrator::new(TABLE, Dopri5::new().rtol(1e-12).atol(1e-13), 0.0, start);
    let (mut drift, mut gained) = (0.0_f64, 0.0_f64);
    for k in 1_i32..=200 {
        sim.advance_to(0.25 * f64::from(k)).unwrap();
        drift = larger(drift, moving(sim.state()) - moving(&start));
        gained = larger(gained, TABLE.energy(0.0, sim.state()) - TABLE.energy(0.0, &start));
    }
    println!("moving energy {drift:e}, energy {gained:e}");
    assert!(drift < 1e-10 && gained > 1e-2, "{drift:e} {gained:e}");
}

const TABLE: BallOnRotatingTable = BallOnRotatingTable { m: 1.0, r: 0.5, k2: 0.1, Omega: 1.7 };

#[test]
fn the_table_does_the_work_of_the_literature() {
    // dE/dt = m Ω² k² / (k² + r²) (x ẋ + y ẏ)
    let BallOnRotatingTable { m, r, k2, Omega } = TABLE;
    let mut random = Random::new(3);
    for _ in 0..100 {
        let state = BallOnRotatingTableState::from(std::array::from_fn(|_| random.between(-2.0, 2.0)));
        let rate = TABLE.derivative(0.0, &state, &());
        let BallOnRotatingTableState { x, y, wx, wy, wz } = state;
        // the acceleration of the centre from the constraints
        let (dx, dy) = (r * wy - Omega * y, Omega * x - r * wx);
        let (ddx, ddy) = (r * rate.wy - Omega * dy, Omega * dx - r * rate.wx);
        let power = m * (dx * ddx + dy * ddy + k2 * (wx * rate.wx + wy * rate.wy + wz * rate.wz));
        let expected = m * Omega * Omega * k2 / (k2 + r * r) * (x * dx + y * dy);
        assert!((power - expected).abs() < 1e-13 * power.abs().max(10.0), "{power} {expected}");
        let lambda = TABLE.multipliers(0.0, &state, &());
        let of_the_table = lambda.roll_x * -Omega * y + lambda.roll_y * Omega * x;
        assert!((power - of_the_table).abs() < 1e-13 * power.abs().max(10.0), "{power} {of_the_table}");
    }
}

#[test]
fn claims_hold_on_the_sphere_and_on_the_constraints() {
    for claim in ["momentum", "vertical", "energy"] {
        assert!(FreeVeselova::REPORT.contains(&format!("  {claim} (claimed, and proved)\n")));
    }
    for claim in ["vertical", "square"] {
        assert!(ChaplyginSphereOnSphere::REPORT.contains(&format!("  {claim} (claimed, and proved)\n")));
    }
    assert!(ChargedParticleByConnection::REPORT.contains("  charge (claimed, and proved)\n"));
    // and they are what integration keeps
    let body = FreeVeselova { A: 1.0, B: 1.7, C: 2.3 };
    let mut start = FreeVeselovaState { g: [0.6, 0.1, 0.7], w: [0.9, -1.1, 0.4] };
    body.normalize(&mut start).unwrap();
    body.project(0.0, &mut start).unwrap();
    let momentum = |x: &FreeVeselovaState| {
        let m = [body.A * x.w[0], body.B * x.w[1], body.C * x.w[2]];
        let along: f64 = m.iter().zip(x.g).map(|(m, g)| m * g).sum();
        m.iter().map(|m| m * m).sum::<f64>() - along * along
    };
    let method = Projected::new(Dopri5::new().rtol(1e-12).atol(1e-13), 5);
    let mut sim = Integrator::new(body, method, 0.0, start);
    sim.advance_to(50.0).unwrap();
    let drift = (momentum(sim.state()) - momentum(&start)).abs();
    assert!(drift < 1e-9, "{drift:e}");

    let sphere =
        ChaplyginSphereOnSphere { I: [[1.0, 0.1, 0.0], [0.1, 1.4, -0.2], [0.0, -0.2, 1.9]], m: 1.2, r: 0.5 };
    let mut start = ChaplyginSphereOnSphereState { g: [0.5, -0.4, 0.8], w: [0.9, -1.1, 0.4] };
    sphere.normalize(&mut start).unwrap();
    let length = start.g.iter().map(|g| g * g).sum::<f64>();
    assert!((length - 1.0).abs() < 4e-16);
    let vertical = |x: &ChaplyginSphereOnSphereState| -> f64 {
        // m r γ × v has no part along γ
        (0..3).map(|i| x.g[i] * (0..3).map(|j| sphere.I[i][j] * x.w[j]).sum::<f64>()).sum()
    };
    let mut sim = Integrator::new(sphere, Dopri5::new().rtol(1e-12).atol(1e-13), 0.0, start);
    sim.advance_to(50.0).unwrap();
    let drift = (vertical(sim.state()) - vertical(&start)).abs();
    assert!(drift < 1e-9, "{drift:e}");
}

#[test]
fn a_rotation_matrix_is_restored_with_its_constraint() {
    let body =
        VeselovaOnRotations { I: [[1.0, 0.1, 0.0], [0.1, 1.4, -0.2], [0.0, -0.2, 1.9]], c: [0.3, 0.0, 0.5] };
    let mut random = Random::new(8);
    for _ in 0..50 {
        let mut entries = random.rotation();
        for entry in &mut entries {
            *entry += random.between(-0.05, 0.05);
        }
        let mut state =
            VeselovaOnRotationsState { w: [0.4, -0.7, 1.1], ..VeselovaOnRotationsState::default() };
        for (k, entry) in entries.into_iter().enumerate() {
            state.R[k / 3][k % 3] = entry;
        }
        body.normalize(&mut state).unwrap();
        body.project(0.0, &mut state).unwrap();
        let off = largest(body.identity_residual(&state));
        let constraint = body.constraint_residual(0.0, &state).veselova.abs();
        assert!(off < 2e-15 && constraint < 2e-15, "{off:e} {constraint:e}");
    }
}

/// Two of three coordinates never change: position constraints in disguise.
#[nonholonomic(
    base { x, y, z }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) - k * x * y }
    constraints { der(y) = 0; der(z) = 0; }
)]
#[derive(Clone, Copy, Debug)]
struct OnALine {
    m: f64,
    k: f64,
}

#[test]
fn holonomic_distributions_are_recognised() {
    for report in [ParticleX::REPORT, ParticleXCoframe::REPORT] {
        assert!(report.contains("D is closed under the bracket (holonomic)"), "{report}");
    }
    assert!(ParticleY::REPORT.contains("D is not closed under the bracket (nonholonomic)"));
    assert!(SnakeboardBySpan::REPORT.contains(
        "D is the span of 3 sections; they are dependent where l = 0 and sin(phi) = 0; D is not closed"
    ));
    assert!(
        OnALine::REPORT.contains("D is closed under the bracket (holonomic); constant: y, z\n"),
        "{}",
        OnALine::REPORT
    );
}

#[test]
fn a_drop_of_rank_is_reported_with_its_place() {
    assert!(Snakeboard::REPORT.contains("they are dependent where cos(phi) = 0"), "{}", Snakeboard::REPORT);
    // by the sections that span it, D passes through there
    assert!(!SnakeboardBySpan::REPORT.contains("cos(phi) = 0"), "{}", SnakeboardBySpan::REPORT);
}

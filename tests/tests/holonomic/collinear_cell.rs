//! Peaucellier's cell at the end of its reach: a run ends there, and has lost nothing on its way.

use nonholonomic::Method;
use nonholonomic::prelude::*;

/// A rhombus of four links between two long arms, whose inner corner goes round a circle through the pivot.
#[nonholonomic(
    base { crank, b[2], d[2], p[2] }
    let c = [a + a * cos(crank), a * sin(crank)];
    let inner(q) = q - c;
    let outer(q) = q - p;
    holonomic {
        left: dot(b, b) = L^2;
        right: dot(d, d) = L^2;
        inner_left: dot(inner(b), inner(b)) = s^2;
        inner_right: dot(inner(d), inner(d)) = s^2;
        outer_left: dot(outer(b), outer(b)) = s^2;
        outer_right: dot(outer(d), outer(d)) = s^2;
    }
    lagrangian {
        J / 2 * der(crank)^2 + m / 2 * (dot(der(b), der(b)) + dot(der(d), der(d)) + dot(der(p), der(p)))
            - m * g * (b[1] + d[1] + p[1])
    }
    emit { taylor }
)]
#[derive(Clone, Copy, Debug)]
struct Cell {
    a: f64,
    L: f64,
    s: f64,
    J: f64,
    m: f64,
    g: f64,
}

const CELL: Cell = Cell { a: 0.5, L: 1.5, s: 0.6, J: 0.02, m: 0.4, g: 9.81 };

/// The cell with its crank at this angle, turning.
fn start(crank: f64, rate: f64) -> CellState {
    let reach = 2.0 * CELL.a * (crank / 2.0).cos();
    let (sine, cosine) = (crank / 2.0).sin_cos();
    let along = (CELL.L * CELL.L - CELL.s * CELL.s + reach * reach) / (2.0 * reach);
    let beside = (CELL.L * CELL.L - along * along).sqrt();
    let far = 2.0 * along - reach;
    let mut state = CellState {
        crank,
        b: [along * cosine - beside * sine, along * sine + beside * cosine],
        d: [along * cosine + beside * sine, along * sine - beside * cosine],
        p: [far * cosine, far * sine],
        crank_dot: rate,
        ..CellState::default()
    };
    CELL.project(0.0, &mut state).unwrap();
    state
}

/// A step that comes off the loop by more than the tolerance errs by more: it is not accepted. Where the links come to lie
/// in one line a run passes, or ends.
fn keeps_its_energy<M: Method<Cell>>(name: &str, method: impl Fn(f64) -> M) {
    for tolerance in [1e-6, 1e-8] {
        for rate in [1.0, -3.0, 6.0] {
            let first = start(0.2, rate);
            let mut sim = Integrator::new(CELL, method(tolerance), 0.0, first);
            let end = sim.advance_to(3.0);
            let lost = (CELL.energy(sim.time(), sim.state()) - CELL.energy(0.0, &first)).abs();
            let statistics = sim.statistics();
            let case = format!("{name} at {tolerance:e}, {rate}: {end:?}, lost {lost:e}, {statistics:?}");
            // half a second before the links are in line; some hundred steps, energies of some joules
            assert!(sim.time() > 0.45 && lost < 1000.0 * tolerance, "{case}");
            assert!(statistics.largest_correction < 20.0 * tolerance, "{case}");
            assert!(statistics.steps + statistics.rejected < 2000, "{case}");
            let is_told = matches!(
                end,
                Ok(()) | Err(IntegrationError::StepUnderflow { .. } | IntegrationError::Projection { .. })
            );
            assert!(is_told, "{case}");
        }
    }
}

#[test]
fn no_energy_is_lost_where_links_come_to_lie_in_line() {
    keeps_its_energy("Dopri5", |tolerance| Dopri5::new().rtol(tolerance).atol(tolerance));
    keeps_its_energy("Tsit5", |tolerance| Tsit5::new().rtol(tolerance).atol(tolerance));
    keeps_its_energy("Dop853", |tolerance| Dop853::new().rtol(tolerance).atol(tolerance));
    keeps_its_energy("Bs23", |tolerance| Bs23::new().rtol(tolerance).atol(tolerance));
    keeps_its_energy("Radau5", |tolerance| Radau5::new().rtol(tolerance).atol(tolerance));
    keeps_its_energy("Rodas5P", |tolerance| Rodas5P::new().rtol(tolerance).atol(tolerance));
    keeps_its_energy("Taylor", |tolerance| Taylor::new().rtol(tolerance).atol(tolerance));
    keeps_its_energy("Auto", |tolerance| Auto::new().rtol(tolerance).atol(tolerance));
}

//! Steps of the Taylor method where the last coefficients tell nothing of what is left out.

use nonholonomic::prelude::*;

/// x″ = −x³: from x = 0 or v = 0 two coefficients of four vanish.
#[nonholonomic(
    base       { x }
    lagrangian { der(x)^2 / 2 - x^4 / 4 }
    emit       { taylor }
)]
#[derive(Clone, Copy, Debug)]
struct CubicSpring {}

/// A motion that is given, beside a free one.
#[nonholonomic(
    base        { y, z }
    lagrangian  { (der(y)^2 + der(z)^2) / 2 }
    constraints { der(y) = 5 * t^4 * y^2; }
    emit        { taylor }
)]
#[derive(Clone, Copy, Debug)]
struct Pole {}

#[test]
fn vanishing_coefficients_do_not_lengthen_a_step() {
    for rtol in [1e-3, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-12, 1e-14] {
        for (x, x_dot) in [(0.0, 1.0), (1.0, 0.0), (1e-9, 1.0), (1.0, -1e-12)] {
            let start = CubicSpringState { x, x_dot };
            let system = CubicSpring {};
            let before = system.energy(0.0, &start);
            let mut sim = Integrator::new(system, Taylor::new().rtol(rtol), 0.0, start);
            for _ in 0..200 {
                sim.step().unwrap();
                let drift = (system.energy(sim.time(), sim.state()) / before - 1.0).abs();
                assert!(drift < 100.0 * rtol, "{rtol:e} from {x}, {x_dot}: {drift:e} at {}", sim.time());
            }
        }
    }
}

#[test]
fn a_pole_is_not_stepped_over() {
    // y = 1/(1 − t⁵)
    for rtol in [1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-15] {
        let mut sim = Integrator::new(
            Pole {},
            Taylor::new().rtol(rtol),
            0.0,
            PoleState { y: 1.0, ..PoleState::default() },
        );
        sim.advance_to(0.9).unwrap();
        let exact = 1.0 / (1.0 - 0.9_f64.powi(5));
        assert!((sim.state().y / exact - 1.0).abs() < 1e3 * rtol.max(1e-15), "{rtol:e}: {:?}", sim.state());
        let mut sim = Integrator::new(
            Pole {},
            Taylor::new().rtol(rtol),
            0.0,
            PoleState { y: 1.0, ..PoleState::default() },
        );
        let beyond = sim.advance_to(2.0);
        assert!(beyond.is_err() && sim.time() < 1.0 + 1e-3, "{rtol:e}: {} {:?}", sim.time(), sim.state());
    }
}

#[test]
fn free_motion_is_one_of_few_steps() {
    let start = PoleState { z_dot: 1.0, ..PoleState::default() };
    let mut sim = Integrator::new(Pole {}, Taylor::new().rtol(1e-10).atol(1e-10), 0.0, start);
    sim.advance_to(1e6).unwrap();
    assert!(sim.statistics().steps < 40, "{:?}", sim.statistics());
}

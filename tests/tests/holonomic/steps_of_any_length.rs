//! A step that ends without an error ends on the constraints, however long it is: an iteration that leads elsewhere, or
//! meets a small correction by accident on its way, has not arrived.

use nonholonomic::prelude::*;

/// A mass on a rod; the origin is h below its joint.
#[nonholonomic(
    base { x, y }
    holonomic { rod: x^2 + (y - h)^2 = l^2; }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - m * g * y }
    emit { discrete_gradient, rattle, symmetric_projection }
)]
#[derive(Clone, Copy, Debug)]
struct Swing {
    m: f64,
    g: f64,
    l: f64,
    h: f64,
}

/// Steps until one is refused, two hundred at most, each of which has to end on the constraints but for rounding of where
/// its iterations lead to.
fn steps<M: nonholonomic::Method<Swing>>(
    name: &str,
    swing: Swing,
    method: M,
    start: SwingState,
    permitted: f64,
) -> usize {
    let (length, speed) = (swing.l, (swing.g * swing.l).sqrt());
    let mut sim = Integrator::new(swing, method, 0.0, start).without_return();
    for step in 0..200 {
        if sim.step().is_err() {
            return step;
        }
        let left = swing.constraint_residual(sim.time(), sim.state());
        let open = (left.rod / length.powi(2)).abs().max((left.rod_dot / (length * speed)).abs());
        assert!(open < permitted, "{name} {swing:?}, step {step}: {open:e} at {:?}", sim.state());
    }
    200
}

#[test]
fn every_step_ends_on_the_constraints_or_is_refused() {
    for (size, time) in [(1.0, 1.0), (1e-30, 1e10)] {
        let swing = Swing { m: 0.7, g: 9.81 * size / time / time, l: size, h: 0.0 };
        for (x, y, speed) in [(1.0, 0.0, 0.0), (0.0, 1.0, 0.3), (0.8, 0.6, 2.0)] {
            let rate = speed * size / time;
            let start = SwingState { x: x * size, y: y * size, x_dot: -y * rate, y_dot: x * rate };
            for share in [1e-6, 0.01, 0.05, 0.1, 0.14, 0.2, 0.25, 0.3, 0.4, 1.0, 3.0, 1e9] {
                let step = share * time;
                let symmetric = ImplicitMidpoint::new(step).symmetrically_projected();
                let ended = [
                    steps("symmetric projection", swing, symmetric, start, 1e-10),
                    steps("of order four", swing, symmetric.fourth_order(), start, 1e-10),
                    steps("energy", swing, DiscreteGradient::new(step), start, 1e-10),
                    steps("variational", swing, Rattle::new(step), start, 1e-10),
                ];
                // a swing takes 2 s
                assert!(share > 0.06 || ended == [200; 4], "{share} {start:?} {ended:?}");
            }
        }
    }
}

/// The origin is where the mass hangs: what is left of the equation is rounding of the length inside of it.
#[test]
fn small_swings_about_the_origin_go_on() {
    let swing = Swing { m: 0.7, g: 9.81, l: 0.3, h: 0.3 };
    for size in [0.1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-14, 1e-30] {
        let mut start = SwingState { x: size, y: 0.0, x_dot: 0.0, y_dot: 0.0 };
        swing.project(0.0, &mut start).unwrap();
        let ended = [
            steps("implicit midpoint", swing, ImplicitMidpoint::new(0.02), start, 1e-2),
            steps(
                "symmetric projection",
                swing,
                ImplicitMidpoint::new(0.02).symmetrically_projected(),
                start,
                1e-10,
            ),
            steps("variational", swing, Rattle::new(0.02), start, 1e-10),
            steps("of order four", swing, GaussLegendre4::new(0.02), start, 1e-2),
            steps("of order six", swing, GaussLegendre6::new(0.02), start, 1e-2),
        ];
        assert_eq!(ended, [200; 5], "{size}");
    }
}

/// Explicit steps lead as far away as they are long, and are returned from there.
#[test]
fn every_return_ends_on_the_constraints_or_is_refused() {
    for (size, time) in [(1.0, 1.0), (1e-30, 1e10)] {
        let swing = Swing { m: 0.7, g: 9.81 * size / time / time, l: size, h: 0.0 };
        let start = SwingState { x: size, y: 0.0, x_dot: 0.0, y_dot: size / time };
        for share in [0.1, 0.3, 0.5, 1.0, 2.0, 3.0, 10.0, 1e3, 1e9] {
            let mut sim = Integrator::new(swing, Rk4::new(share * time), 0.0, start);
            for step in 0..50 {
                if sim.step().is_err() {
                    break;
                }
                let (left, state) = (swing.constraint_residual(sim.time(), sim.state()), sim.state());
                let speed = state.x_dot.hypot(state.y_dot);
                let open = (left.rod / size.powi(2)).abs().max((left.rod_dot / (size * speed)).abs());
                assert!(open < 1e-13, "{share}, step {step}: {open:e} at {state:?}");
            }
        }
    }
}

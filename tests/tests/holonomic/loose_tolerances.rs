//! What loose tolerances cost a mass on a rod, and the same pendulum by its angle: the numbers of the guide.

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    holonomic { rod: x^2 + y^2 = l^2; }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - m * g * y }
)]
#[derive(Clone, Copy, Debug)]
struct OnARod {
    m: f64,
    g: f64,
    l: f64,
}

#[nonholonomic(base { a } lagrangian { m / 2 * l^2 * der(a)^2 + m * g * l * cos(a) })]
#[derive(Clone, Copy, Debug)]
struct ByItsAngle {
    m: f64,
    g: f64,
    l: f64,
}

/// The share of the energy above the lowest point that is left after 1000 s of a swing by 0.6 rad.
fn left(tolerance: f64) -> [f64; 2] {
    let (m, g, l) = (1.0, 9.81, 1.0);
    let (sin, cos) = 0.6_f64.sin_cos();
    let all = m * g * l * (1.0 - cos);

    let rod = OnARod { m, g, l };
    let start = OnARodState { x: l * sin, y: -l * cos, ..OnARodState::default() };
    let mut sim = Integrator::new(rod, Dopri5::new().rtol(tolerance), 0.0, start);
    sim.advance_to(1000.0).unwrap();
    let on_the_rod = rod.energy(1000.0, sim.state()) + m * g * l;

    let angle = ByItsAngle { m, g, l };
    let start = ByItsAngleState { a: 0.6, a_dot: 0.0 };
    let mut sim = Integrator::new(angle, Dopri5::new().rtol(tolerance), 0.0, start);
    sim.advance_to(1000.0).unwrap();
    [on_the_rod / all, (angle.energy(1000.0, sim.state()) + m * g * l) / all]
}

#[test]
fn what_the_guide_says_is_lost() {
    // lost on the rod, and by the angle; what is below 0 is won
    for (tolerance, told) in
        [(1e-2, [0.9, -6.0]), (1e-3, [0.75, 0.33]), (1e-4, [0.25, 0.2]), (1e-6, [0.003, 0.002])]
    {
        let lost = left(tolerance).map(|left| 1.0 - left);
        let near = lost.iter().zip(told).all(|(lost, told)| (lost / told - 1.0).abs() < 0.15);
        assert!(near, "{tolerance:e}: {lost:?}");
    }
}

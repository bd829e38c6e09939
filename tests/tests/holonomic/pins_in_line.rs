//! A loop near to where all of its pins lie in line and its equations are dependent: velocities satisfy them, or there are none.

use nonholonomic::prelude::*;

/// Two cranks and a bar, as long as the ground between them.
#[nonholonomic(
    base { x1, y1, x2, y2 }
    holonomic {
        left: x1^2 + y1^2 = a^2;
        bar: (x2 - x1)^2 + (y2 - y1)^2 = b^2;
        right: (x2 - b)^2 + y2^2 = a^2;
    }
    lagrangian { m / 2 * (der(x1)^2 + der(y1)^2 + der(x2)^2 + der(y2)^2) - m * g * (y1 + y2) }
)]
#[derive(Clone, Copy, Debug)]
struct Pins {
    a: f64,
    b: f64,
    m: f64,
    g: f64,
}

#[test]
fn what_is_projected_satisfies_its_rates() {
    let pins = Pins { a: 0.5, b: 1.2, m: 1.3, g: 9.81 };
    let (mut found, mut refused) = (0, 0);
    for case in 0..3200_i32 {
        let near = |power: i32| 10_f64.powf(f64::from(power).mul_add(0.6, -30.0));
        let (y1, y2) = (near(case % 40), near(case / 40 % 40));
        let (y2, y2_dot) = if case < 1600 { (y2, 0.9) } else { (-y2, -0.2) };
        let rates = PinsState { x1_dot: 0.3, y1_dot: 0.7, x2_dot: -0.4, y2_dot, ..PinsState::default() };
        let mut state = PinsState { x1: 0.5, y1, x2: 1.7, y2, ..rates };
        if pins.project(0.0, &mut state).is_err() {
            refused += 1;
            continue;
        }
        found += 1;
        let left = Constrained::constraint_residual(&pins, 0.0, &state);
        assert!(left.iter().all(|left| left.abs() < 1e-7), "{y1:e} {y2:e}: {left:?}");
    }
    assert!(found > 1000 && refused > 100, "{found} {refused}");
}

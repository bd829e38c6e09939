//! Reconstructions where the reduced system alone has position constraints.

use nonholonomic::prelude::*;

/// A bead in a valley by its place across and along: the height is none of its coordinates.
#[nonholonomic(
    base { x, z }
    lagrangian { m / 2 * ((1 + 4 * h^2 * x^2) * der(x)^2 + der(z)^2) - m * g * h * x^2 }
)]
#[derive(Clone, Copy, Debug)]
struct ByPlace {
    m: f64,
    g: f64,
    h: f64,
}

/// The same by its place and height.
#[nonholonomic(
    base { x, y, z }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) - m * g * y }
    holonomic { valley: y = h * x^2; }
)]
#[derive(Clone, Copy, Debug)]
struct ByHeight {
    m: f64,
    g: f64,
    h: f64,
}

morphism! { ByPlace -> ByHeight { base { x = x; y = h * x^2; z = z; } } }

#[test]
fn a_reduced_state_returns_to_constraints_that_the_full_one_does_not_have() {
    let full = ByPlace { m: 1.0, g: 9.81, h: 1.0 };
    let start = ByPlaceState { x: 1.0, z: 0.0, x_dot: 0.3, z_dot: 0.7 };
    let motion = Reconstructed::<ByPlace, ByHeight>::new(full);
    assert!(motion.has_positions());
    let mut joint = Integrator::new(motion, Rk4::new(0.05), 0.0, motion.start(0.0, &start));
    joint.advance_to(20.0).expect("a smooth motion");
    let reduced = ByPlace::reduced_part(joint.state());
    assert!((reduced.y - reduced.x * reduced.x).abs() < 1e-14, "{reduced:?}");
    assert!(joint.statistics().projections > 0, "{:?}", joint.statistics());
    // and it is the motion of the full system
    let precise = || Vern9::new().rtol(1e-12).atol(1e-12);
    let mut joint = Integrator::new(motion, precise(), 0.0, motion.start(0.0, &start));
    let mut whole = Integrator::new(full, precise(), 0.0, start);
    joint.advance_to(20.0).expect("a smooth motion");
    whole.advance_to(20.0).expect("a smooth motion");
    let reached = motion.full_state(20.0, joint.state());
    assert!((whole.state().x - reached.x).abs() < 1e-9, "{reached:?} {:?}", whole.state());
    // a reduced state beside them is refused
    let mut beside = motion.start(0.0, &start);
    beside.reduced.y += 0.1;
    let refused = Integrator::new(motion, Rk4::new(0.05), 0.0, beside).step();
    assert!(
        matches!(refused, Err(IntegrationError::OffConstraints { constraint: "valley", .. })),
        "{refused:?}"
    );
}

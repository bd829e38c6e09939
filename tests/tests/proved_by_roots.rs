//! Declarations whose proofs need roots with their signs: a speed that is held beside a rate that is held,
//! in either order, and maps that are reductions by identities of roots, exponentials and logarithms.

use nonholonomic::prelude::*;

/// A point of constant horizontal speed whose rate along x is held as well.
#[nonholonomic(
    base { x, y, z }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) - m * g * (y + z) }
    constraints { speed: der(x)^2 + der(y)^2 = 1; rate: der(x) = 1/2; }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct SpeedThenRate {
    m: f64,
    g: f64,
}

/// The same with the constraints in the other order.
#[nonholonomic(
    base { x, y, z }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) - m * g * (y + z) }
    constraints { rate: der(x) = 1/2; speed: der(x)^2 + der(y)^2 = 1; }
)]
#[derive(Clone, Copy, Debug)]
struct RateThenSpeed {
    m: ::core::primitive::f64,
    g: ::std::primitive::f64,
}

#[test]
fn a_speed_and_a_rate_are_held_together() {
    let (m, g) = (1.3, 0.7);
    let y_dot = 0.75_f64.sqrt();
    let one = SpeedThenRate { m, g };
    let start = SpeedThenRateState { x: 0.2, y: -0.4, z: 0.1, x_dot: 0.5, y_dot, z_dot: 0.3 };
    let rate = one.derivative(0.0, &start, &());
    assert!(rate.x_dot.abs() < 1e-15 && rate.y_dot.abs() < 1e-15, "{rate:?}");
    assert!((rate.z_dot + g).abs() < 1e-15, "{rate:?}");
    // the weight along y is what the constraints carry: m ÿ = −m g + 2 ẏ λ
    let multipliers = one.multipliers(0.0, &start, &());
    assert!((2.0 * y_dot * multipliers.speed - m * g).abs() < 1e-14, "{multipliers:?}");
    let mut sim = Integrator::new(one, Rk4::new(0.01), 0.0, start);
    sim.advance_to(2.0).unwrap();
    let state = sim.state();
    assert!((state.x - 1.2).abs() < 1e-13 && (state.y - (2.0 * y_dot - 0.4)).abs() < 1e-13, "{state:?}");
    assert!((state.z - (0.1 + 0.6 - 2.0 * g)).abs() < 1e-13, "{state:?}");
    let other = RateThenSpeed { m, g };
    let start = RateThenSpeedState { x: 0.2, y: -0.4, z: 0.1, x_dot: 0.5, y_dot, z_dot: 0.3 };
    let again = other.derivative(0.0, &start, &());
    assert!(again.x_dot.abs() < 1e-15 && again.y_dot.abs() < 1e-15, "{again:?}");
    assert!((again.z_dot + g).abs() < 1e-15, "{again:?}");
}

/// A point in the plane of complex numbers, whose energy is that of its square root.
#[nonholonomic(
    base { x, y }
    lagrangian { 2 * m * (x^2 + y^2) * (der(x)^2 + der(y)^2) - k * (x^2 + y^2) }
)]
#[derive(Clone, Copy, Debug)]
struct RootOfAPoint {
    m: f64,
    k: f64,
}

/// The point itself, drawn to the origin by a constant force.
#[nonholonomic(
    base { u, v }
    lagrangian { m / 2 * (der(u)^2 + der(v)^2) - k * sqrt(u^2 + v^2) }
)]
#[derive(Clone, Copy, Debug)]
struct PointOnAPlane {
    m: f64,
    k: f64,
}

// |z²| = |z|²: √((x² − y²)² + 4 x² y²) = x² + y²
morphism! { RootOfAPoint -> PointOnAPlane {
    base { u = x^2 - y^2; v = 2 * x * y; }
} }

/// A point on a line that is stretched by the hyperbolic sine.
#[nonholonomic(
    base { s }
    lagrangian { m / 2 * cosh(s)^2 * der(s)^2 - k * cosh(s) - k * s }
)]
#[derive(Clone, Copy, Debug)]
struct Stretched {
    m: f64,
    k: f64,
}

/// The same point on the line as it is.
#[nonholonomic(
    base { q }
    lagrangian { m / 2 * der(q)^2 - k * sqrt(1 + q^2) - k * ln(q + sqrt(1 + q^2)) }
)]
#[derive(Clone, Copy, Debug)]
struct AsItIs {
    m: f64,
    k: f64,
}

// √(1 + sinh²) = cosh, and ln(sinh + cosh) is the number itself
morphism! { Stretched -> AsItIs {
    base { q = sinh(s); }
} }

#[test]
fn maps_are_reductions_by_identities_of_roots() {
    let root = RootOfAPoint { m: 1.1, k: 0.6 };
    let start = RootOfAPointState { x: 0.8, y: 0.5, x_dot: -0.2, y_dot: 0.4 };
    let (mapped, point) = (root.reduce(0.0, &start), root.reduced());
    assert!((root.energy(0.0, &start) - point.energy(0.0, &mapped)).abs() < 1e-14);
    let stretched = Stretched { m: 0.9, k: 1.2 };
    let start = StretchedState { s: 0.7, s_dot: -0.3 };
    let (mapped, plain) = (stretched.reduce(0.0, &start), stretched.reduced());
    assert!((stretched.energy(0.0, &start) - plain.energy(0.0, &mapped)).abs() < 1e-14);
}

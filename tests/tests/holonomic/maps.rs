//! Maps between systems of which one or both have position constraints, CLMM Theorem 4.6 on N: mathematics (13), (14)
//! for velocities that are tangent to the positions; and quotients by groups that keep these.

use nonholonomic::State;
use nonholonomic::prelude::*;

/// A spherical pendulum with a blade on its bob, in space.
#[nonholonomic(
    base { x, y, z }
    holonomic { rod: x^2 + y^2 + z^2 = l^2; }
    constraints { blade: x * der(y) - y * der(x) = a * der(z); }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) - m * g * z }
    forces { x: -c * der(x); y: -c * der(y); z: -c * der(z); }
)]
#[derive(Clone, Copy, Debug, PartialEq)]
struct InSpace {
    m: f64,
    l: f64,
    a: f64,
    c: f64,
    g: f64,
}

/// The same with one velocity in the state.
#[nonholonomic(
    base { x, y, z }
    holonomic { rod: x^2 + y^2 + z^2 = l^2; }
    constraints { blade: x * der(y) - y * der(x) = a * der(z); }
    independent { der(z) }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) - m * g * z }
    forces { x: -c * der(x); y: -c * der(y); z: -c * der(z); }
)]
#[derive(Clone, Copy, Debug, PartialEq)]
struct ByHeight {
    m: f64,
    l: f64,
    a: f64,
    c: f64,
    g: f64,
}

/// In angles: from the vertical, and about it.
#[nonholonomic(
    base { theta, phi }
    constraints { blade: l * sin(theta)^2 * der(phi) = -a * sin(theta) * der(theta); }
    lagrangian { m * l^2 / 2 * (der(theta)^2 + sin(theta)^2 * der(phi)^2) - m * g * l * cos(theta) }
    forces { theta: -c * l^2 * der(theta); phi: -c * l^2 * sin(theta)^2 * der(phi); }
)]
#[derive(Clone, Copy, Debug, PartialEq)]
struct InAngles {
    m: f64,
    l: f64,
    a: f64,
    c: f64,
    g: f64,
}

morphism! { InAngles -> InSpace {
    base { x = l * sin(theta) * cos(phi); y = l * sin(theta) * sin(phi); z = l * cos(theta); }
} }

morphism! { InAngles -> ByHeight {
    base { x = l * sin(theta) * cos(phi); y = l * sin(theta) * sin(phi); z = l * cos(theta); }
} }

morphism! { InSpace -> InAngles { base { theta = acos(z / l); phi = atan2(y, x); } } }

morphism! { ByHeight -> InSpace {} }

/// The bob without its rod: a larger system, of which the others are modes.
#[nonholonomic(
    base { x, y, z }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) - m * g * z }
    forces { x: -c * der(x); y: -c * der(y); z: -c * der(z); }
)]
#[derive(Clone, Copy, Debug, PartialEq)]
struct Free {
    m: f64,
    c: f64,
    g: f64,
}

morphism! { InSpace -> Free {} }
morphism! { ByHeight -> Free {} }

const ANGLES: InAngles = InAngles { m: 1.3, l: 0.8, a: 0.3, c: 0.2, g: 9.81 };
const START: InAnglesState = InAnglesState { theta: 1.1, phi: 0.4, theta_dot: 0.7 };

/// A sleigh on the plane that tows a mass on a rod, whose place is told from the sleigh.
#[nonholonomic(
    base { theta, x, y, u, w }
    let tip_x = x + cos(theta) * u - sin(theta) * w;
    let tip_y = y + sin(theta) * u + cos(theta) * w;
    holonomic { rod: u^2 + w^2 = l^2; }
    constraints { blade: cos(theta) * der(y) = sin(theta) * der(x); }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) + J / 2 * der(theta)^2 + M / 2 * (der(tip_x)^2 + der(tip_y)^2) }
    assume { m > 0; J > 0; M > 0; }
)]
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(non_snake_case, reason = "as in mechanics")]
struct Towing {
    m: f64,
    J: f64,
    M: f64,
    l: f64,
}

quotient! {
    Towing ->
    /// On se(2).
    #[derive(Clone, Copy, Debug, PartialEq)]
    #[allow(non_snake_case, reason = "as in mechanics")]
    struct Towed by { theta, x, y } {
        velocities {
            omega = der(theta);
            v1 = cos(theta) * der(x) + sin(theta) * der(y);
            v2 = cos(theta) * der(y) - sin(theta) * der(x);
            du = der(u);
            dw = der(w);
        }
        emit { multipliers }
    }
}

#[test]
fn a_quotient_keeps_its_position_constraints() {
    let full = Towing { m: 1.0, J: 0.3, M: 0.7, l: 0.9 };
    let (angle, turn) = (0.8_f64, 1.3);
    let (theta, theta_dot, speed) = (0.4_f64, 0.5, 1.2);
    let start = TowingState {
        theta,
        x: 0.1,
        y: -0.2,
        u: -0.9 * angle.cos(),
        w: -0.9 * angle.sin(),
        theta_dot,
        x_dot: speed * theta.cos(),
        y_dot: speed * theta.sin(),
        u_dot: 0.9 * angle.sin() * turn,
        w_dot: -0.9 * angle.cos() * turn,
    };
    let reduced: Towed = full.reduced();
    let in_quotient = full.reduce(0.0, &start);
    let left = reduced.constraint_residual(0.0, &in_quotient);
    assert!(left.rod.abs() < 1e-15 && left.rod_dot.abs() < 1e-15 && left.blade.abs() < 1e-15, "{left:?}");
    assert!((reduced.energy(0.0, &in_quotient) - full.energy(0.0, &start)).abs() < 1e-14);
    let mut all = Integrator::new(full, Dop853::new().rtol(1e-12).atol(1e-12), 0.0, start);
    let mut some = Integrator::new(reduced, Dop853::new().rtol(1e-12).atol(1e-12), 0.0, in_quotient);
    all.advance_to(3.0).unwrap();
    some.advance_to(3.0).unwrap();
    assert_near(&full.reduce(3.0, all.state()), some.state(), 1e-9);
    assert!(some.state().u.hypot(some.state().w) - 0.9 < 1e-14);
    assert!((some.state().v1 - speed).abs() > 0.01, "nothing moves");
}

fn assert_near<S: State<Scalar = f64>>(left: &S, right: &S, tolerance: f64) {
    for (a, b) in left.to_array().as_ref().iter().zip(right.to_array().as_ref()) {
        assert!((a - b).abs() < tolerance, "{a} against {b}");
    }
}

#[test]
fn motions_go_to_motions_on_the_positions() {
    let whole = START;
    let space: InSpace = Reduction::<InSpace>::reduced(&ANGLES);
    let there: InSpaceState = Reduction::<InSpace>::reduce(&ANGLES, 0.0, &whole);
    let left = space.constraint_residual(0.0, &there);
    assert!(left.rod.abs() < 1e-15 && left.rod_dot.abs() < 1e-15 && left.blade.abs() < 1e-15, "{left:?}");
    // run here and there
    let run = |state| {
        let mut sim = Integrator::new(ANGLES, Dop853::new().rtol(1e-12).atol(1e-12), 0.0, state);
        sim.advance_to(0.4).unwrap();
        *sim.state()
    };
    let mut sim = Integrator::new(space, Dop853::new().rtol(1e-12).atol(1e-12), 0.0, there);
    sim.advance_to(0.4).unwrap();
    assert_near(&Reduction::<InSpace>::reduce(&ANGLES, 0.4, &run(whole)), sim.state(), 1e-9);
    // and back to the angles
    let back: InAngles = space.reduced();
    assert_eq!(back, ANGLES);
    let angles: InAnglesState = Reduction::<InAngles>::reduce(&space, 0.0, &there);
    assert_near(&angles, &whole, 1e-14);
    // to the state with one velocity, and from it to the one with all
    let by_height: ByHeight = Reduction::<ByHeight>::reduced(&ANGLES);
    let short: ByHeightState = Reduction::<ByHeight>::reduce(&ANGLES, 0.0, &whole);
    let all: InSpaceState = Reduction::<InSpace>::reduce(&by_height, 0.0, &short);
    assert_near(&all, &there, 1e-14);
}

#[test]
fn what_is_on_its_rod_is_a_mode_of_what_is_free() {
    let space: InSpace = Reduction::<InSpace>::reduced(&ANGLES);
    let there: InSpaceState = Reduction::<InSpace>::reduce(&ANGLES, 0.0, &START);
    let free = Inclusion::<Free>::include(&space, 0.0, &there);
    assert_near(&Inclusion::<Free>::restrict(&space, 0.0, &free).unwrap(), &there, 1e-15);
    // all velocities and places of the mode are those of the free bob, which are off
    let inside = FreeState { x: 0.5 * free.x, ..free };
    assert!(Inclusion::<Free>::restrict(&space, 0.0, &inside).is_err());
    let off_the_blade = FreeState { x_dot: free.x_dot + 1.0, ..free };
    assert!(Inclusion::<Free>::restrict(&space, 0.0, &off_the_blade).is_err());
    assert!(Inclusion::<Free>::restrict(&space, 0.0, &FreeState { x: f64::NAN, ..free }).is_err());
    let by_height: ByHeight = Reduction::<ByHeight>::reduced(&ANGLES);
    let short: ByHeightState = Reduction::<ByHeight>::reduce(&ANGLES, 0.0, &START);
    assert_near(&Inclusion::<Free>::include(&by_height, 0.0, &short), &free, 1e-14);
    assert_near(&Inclusion::<Free>::restrict(&by_height, 0.0, &free).unwrap(), &short, 1e-14);
    assert!(Inclusion::<Free>::restrict(&by_height, 0.0, &inside).is_err());
}

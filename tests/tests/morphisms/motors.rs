//! Auxiliary states go along with maps and quotients: motors of a robot that is reduced by the motions of the plane.

use nonholonomic::prelude::*;

/// A robot on two wheels in coordinates of the plane, with the currents of its motors.
#[nonholonomic(
    base { x, y, theta }
    constraints { axle: cos(theta) * der(y) = sin(theta) * der(x); }
    formulation { projected }
    inputs { volts[2] }
    let speed = cos(theta) * der(x) + sin(theta) * der(y);
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) + J / 2 * der(theta)^2 }
    auxiliary {
        der(current[i in 0..2]) = (volts[i] - k * (speed + (2 * i - 1) * b * der(theta)) - R * current[i]) / L;
    }
    forces {
        x: k * (current[0] + current[1]) * cos(theta);
        y: k * (current[0] + current[1]) * sin(theta);
        theta: k * b * (current[1] - current[0]);
    }
)]
#[derive(Clone, Copy, Debug)]
struct Driven {
    m: f64,
    J: f64,
    b: f64,
    k: f64,
    R: f64,
    L: f64,
}

/// The same in its own axes, without its place.
#[nonholonomic(
    basis { v, side, omega }
    brackets { [omega, v] = side; [omega, side] = -v; }
    constraints { side = 0; }
    inputs { volts[2] }
    lagrangian { m / 2 * (v^2 + side^2) + J / 2 * omega^2 }
    auxiliary {
        der(current[0]) = (volts[0] - k * (v - b * omega) - R * current[0]) / L;
        der(current[1]) = (volts[1] - k * (v + b * omega) - R * current[1]) / L;
    }
    forces { v: k * (current[0] + current[1]); omega: k * b * (current[1] - current[0]); }
)]
#[derive(Clone, Copy, Debug)]
struct Reduced {
    m: f64,
    J: f64,
    b: f64,
    k: f64,
    R: f64,
    L: f64,
}

morphism! { Driven -> Reduced {
    velocities {
        v = cos(theta) * der(x) + sin(theta) * der(y);
        side = cos(theta) * der(y) - sin(theta) * der(x);
        omega = der(theta);
    }
} }

quotient! {
    Driven ->
    /// The same, derived.
    #[derive(Clone, Copy, Debug)]
    struct Derived by { x, y, theta } {
        velocities {
            v = cos(theta) * der(x) + sin(theta) * der(y);
            side = cos(theta) * der(y) - sin(theta) * der(x);
            omega = der(theta);
        }
    }
}

const DRIVEN: Driven = Driven { m: 12.0, J: 0.7, b: 0.2, k: 1.4, R: 0.9, L: 0.02 };

fn start() -> DrivenState {
    let mut state = DrivenState {
        x: 0.4,
        y: -0.3,
        theta: 0.8,
        x_dot: 0.5 * 0.8_f64.cos(),
        y_dot: 0.5 * 0.8_f64.sin(),
        theta_dot: -0.4,
        current: [0.3, -0.2],
    };
    DRIVEN.project(0.0, &mut state).unwrap();
    state
}

#[test]
fn motions_with_currents_go_to_motions() {
    let input = DrivenInput { volts: [3.0, 5.0] };
    let mut whole = Integrator::new(DRIVEN, Dop853::new().rtol(1e-12).atol(1e-12), 0.0, start());
    whole.set_input(input);
    whole.advance_to(2.0).unwrap();
    let reduced: Reduced = DRIVEN.reduced();
    let first = Reduction::<Reduced>::reduce(&DRIVEN, 0.0, &start());
    assert_eq!(first.current.map(f64::to_bits), [0.3_f64, -0.2].map(f64::to_bits));
    let mut alone = Integrator::new(reduced, Dop853::new().rtol(1e-12).atol(1e-12), 0.0, first);
    alone.set_input(ReducedInput { volts: input.volts });
    alone.advance_to(2.0).unwrap();
    let image = Reduction::<Reduced>::reduce(&DRIVEN, 2.0, whole.state());
    let derived = Reduction::<Derived>::reduce(&DRIVEN, 2.0, whole.state());
    let pairs = image.to_array().into_iter().zip(alone.state().to_array());
    for (image, alone) in pairs {
        assert!((image - alone).abs() < 1e-10, "{image} {alone}");
    }
    // the derived quotient is the declared one
    let (a, b) = (derived.to_array(), image.to_array());
    assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-15), "{a:?} {b:?}");
    let of_derived: Derived = DRIVEN.reduced();
    let rates = of_derived.derivative(2.0, &derived, &DerivedInput { volts: input.volts });
    let others = reduced.derivative(2.0, &image, &ReducedInput { volts: input.volts });
    let pairs = rates.to_array().into_iter().zip(others.to_array());
    assert!(pairs.into_iter().all(|(a, b)| (a - b).abs() < 1e-11), "{rates:?} {others:?}");
    assert!((image.current[0] - image.current[1]).abs() > 0.1, "the currents matter: {image:?}");
}

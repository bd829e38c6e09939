//! Modes: systems that are a larger one with further constraints, the maps between their states, and what their
//! multipliers say.

// bits are meant
#![allow(clippy::float_cmp)]

use nonholonomic::prelude::*;

/// A wheel whose centre of mass is c from its middle: above the ground, with a pull at its lowest point.
#[nonholonomic(
    base { x, y, phi }
    inputs { pull }
    lagrangian {
        m / 2 * (der(x)^2 + der(y)^2 + c^2 * der(phi)^2 + 2 * c * der(phi) * (der(x) * cos(phi) - der(y) * sin(phi)))
            + J / 2 * der(phi)^2 - m * g * (y + c * cos(phi))
    }
    forces { x: pull; phi: -R * pull; }
    impacts { touch: y >= R; grip: y >= R, der(x) = R * der(phi); }
)]
#[derive(Clone, Copy, Debug, PartialEq)]
struct Flying {
    m: f64,
    J: f64,
    R: f64,
    c: f64,
    g: f64,
}

/// The same wheel, rolling.
#[nonholonomic(
    base { x, phi }
    lagrangian {
        m / 2 * (der(x)^2 + c^2 * der(phi)^2 + 2 * c * der(phi) * der(x) * cos(phi)) + J / 2 * der(phi)^2
            - m * g * (R + c * cos(phi))
    }
    constraints { grip: der(x) = R * der(phi); }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct Rolling {
    m: f64,
    J: f64,
    R: f64,
    c: f64,
    g: f64,
}

morphism! { Rolling -> Flying { base { x = x; y = R; phi = phi; } inputs { pull = 0; } } }

/// The same wheel, sliding over the ground with its lowest point going to the side of s = ±1.
#[nonholonomic(
    base { x, y, phi }
    let arm = R + c * cos(phi);
    let support = g - c * der(phi)^2 * cos(phi);
    let turning = (mu * s * arm * m * support + m * g * c * sin(phi) - m * c^2 * der(phi)^2 * sin(phi) * cos(phi))
        / (J + m * c^2 * sin(phi)^2 + mu * s * arm * m * c * sin(phi));
    let normal = m * support - m * c * sin(phi) * turning;
    lagrangian {
        m / 2 * (der(x)^2 + der(y)^2 + c^2 * der(phi)^2 + 2 * c * der(phi) * (der(x) * cos(phi) - der(y) * sin(phi)))
            + J / 2 * der(phi)^2 - m * g * (y + c * cos(phi))
    }
    constraints { contact: der(y) = 0; }
    forces { x: -mu * s * normal; phi: R * mu * s * normal; }
    outputs { load = normal; slip = der(x) - R * der(phi); }
    emit { multipliers }
)]
#[derive(Clone, Copy, Debug)]
struct Slipping {
    m: f64,
    J: f64,
    R: f64,
    c: f64,
    g: f64,
    mu: f64,
    s: f64,
}

morphism! {
    Slipping -> Flying { base { x = x; y = y; phi = phi; } inputs { pull = -mu * s * normal; } }
}

const FLYING: Flying = Flying { m: 1.3, J: 0.1, R: 0.5, c: 0.2, g: 9.81 };
const ROLLING: Rolling = Rolling { m: 1.3, J: 0.1, R: 0.5, c: 0.2, g: 9.81 };

#[test]
fn a_mode_is_included_and_restricted() {
    assert_eq!(ROLLING.whole(), FLYING);
    assert!(<Rolling as Inclusion<Flying>>::REPORT.contains("Rolling is Flying with further constraints"));
    let rolling = RollingState { x: 1.0, phi: 0.7, phi_dot: 3.0 };
    let wheel = ROLLING.include(0.0, &rolling);
    let wanted = FlyingState { x: 1.0, y: 0.5, phi: 0.7, x_dot: 1.5, y_dot: 0.0, phi_dot: 3.0 };
    assert_eq!(wheel, wanted);
    assert_eq!(ROLLING.restrict(0.0, &wheel), Ok(rolling));
    assert!((ROLLING.energy(0.0, &rolling) - FLYING.energy(0.0, &wheel)).abs() < 1e-14);
    // rounding does no harm, what slips or flies is told
    let nearly = FlyingState { y_dot: 1e-15, x_dot: 1.5 + 1e-14, ..wheel };
    assert_eq!(ROLLING.restrict(0.0, &nearly), Ok(rolling));
    let slipping = FlyingState { phi_dot: 2.5, ..wheel };
    let error = ROLLING.restrict(0.0, &slipping).unwrap_err();
    assert_eq!((error.variable, error.residual, error.residuals.x_dot), ("x_dot", 0.25, 0.25));
    assert_eq!(
        error.to_string(),
        "the state is not in this mode: `x_dot` is off by 0.25; make the jump of an impact first, or stay in the \
         larger system"
    );
    let flying = ROLLING.restrict(0.0, &FlyingState { y: 0.8, ..wheel }).unwrap_err();
    assert_eq!(flying.variable, "y");
    assert!(ROLLING.restrict(0.0, &FlyingState { y: f64::NAN, ..wheel }).is_err());
}

/// What is infinite or no number is off, is what is named, and measures nothing else.
#[test]
fn what_is_no_number_is_in_no_mode() {
    let rolling = RollingState { x: 1.2, phi: 0.4, phi_dot: 3.0 };
    let whole = ROLLING.include(0.0, &rolling).to_array();
    for component in 0..6 {
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut given = whole;
            given[component] = value;
            let error = ROLLING.restrict(0.0, &FlyingState::from(given)).unwrap_err();
            let index = FlyingState::names().iter().position(|name| *name == error.variable).unwrap();
            // what follows from a variable may be named for it
            assert!(
                !error.residual.is_finite() && !error.residuals.to_array()[index].is_finite(),
                "{error:?}"
            );
            let follows = index == component || (component == 5 && index == 3);
            assert!(follows, "{component} {value}: {error:?}");
        }
    }
}

#[test]
fn an_impact_leads_into_a_mode() {
    let falling = FlyingState { x: 0.0, y: 0.5, phi: 0.4, x_dot: 2.0, y_dot: -1.0, phi_dot: -1.0 };
    assert!(ROLLING.restrict(0.0, &falling).is_err());
    let (gripped, impulses) = FLYING.impact_grip(0.0, &falling).unwrap();
    assert!(impulses.grip[0] > 0.0);
    let rolling = ROLLING.restrict(0.0, &gripped).unwrap();
    assert!((gripped.x_dot - 0.5 * rolling.phi_dot).abs() < 1e-15);
    assert!(FLYING.energy(0.0, &gripped) < FLYING.energy(0.0, &falling));
}

/// The multiplier of the ground is the load in the law of friction, and the motion that of the larger system under it.
#[test]
fn friction_by_the_load_is_what_the_multiplier_says() {
    let Flying { m, J, R, c, g } = FLYING;
    for s in [1.0, -1.0] {
        let slipping = Slipping { m, J, R, c, g, mu: 0.3, s };
        let state = SlippingState { x: 0.2, y: 0.5, phi: 0.9, x_dot: 2.0 * s, phi_dot: -1.5 * s };
        let (load, contact) =
            (slipping.outputs(0.0, &state, &()).load, slipping.multipliers(0.0, &state, &()).contact);
        assert!((load - contact).abs() < 1e-12 * load.abs(), "{load} {contact}");
        // the equations of the larger system, with the force of the ground beside the pull
        let whole = slipping.include(0.0, &state);
        let rates = slipping.derivative(0.0, &state, &());
        let free = FLYING.derivative(0.0, &whole, &FlyingInput { pull: -0.3 * s * load });
        assert!((free.x_dot - rates.x_dot).abs() + (free.phi_dot - rates.phi_dot).abs() > 1.0);
        assert_eq!(slipping.restrict(0.0, &whole), Ok(state));
    }
}

/// A body that is blown along by a pressure that builds up, in the air.
#[nonholonomic(
    base { x, y }
    inputs { pump }
    auxiliary { der(pressure) = (pump - pressure) / lag; }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - m * g * y }
    forces { x: area * pressure; }
)]
#[derive(Clone, Copy, Debug)]
struct Blown {
    m: f64,
    g: f64,
    area: f64,
    lag: f64,
}

/// The same on the ground.
#[nonholonomic(
    base { x }
    inputs { pump }
    auxiliary { der(pressure) = (pump - pressure) / lag; }
    lagrangian { m / 2 * der(x)^2 }
    forces { x: area * pressure; }
)]
#[derive(Clone, Copy, Debug)]
struct Gliding {
    m: f64,
    g: f64,
    area: f64,
    lag: f64,
}

morphism! { Gliding -> Blown { base { x = x; y = 0; } } }

/// A pressure in pascals is no measure of speeds.
#[test]
fn auxiliary_states_are_no_measure_of_velocities() {
    let gliding = Gliding { m: 1.0, g: 9.81, area: 1e-6, lag: 1.0 };
    let falling = BlownState { x: 1.0, y: 0.0, x_dot: 1.0, y_dot: -1.0, pressure: 1e9 };
    let refused = gliding.restrict(0.0, &falling).unwrap_err();
    assert_eq!((refused.variable, refused.residual), ("y_dot", -1.0));
    let state = gliding.restrict(0.0, &BlownState { y_dot: 0.0, ..falling }).expect("it glides");
    assert_eq!((state.x_dot, state.pressure), (1.0, 1e9));
    assert!(gliding.restrict(0.0, &BlownState { y_dot: 0.0, pressure: f64::NAN, ..falling }).is_err());
}

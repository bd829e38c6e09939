//! Blades, wheels, limits of joints, and several contacts at once.

use nonholonomic::impacts::ImpactError;
use nonholonomic::prelude::*;

/// A skate above the ice: its centre of mass is `a` before the blade.
#[nonholonomic(
    base { theta, x, y }
    basis { omega, v1, v2 }
    anchor {
        der(theta) = omega;
        der(x) = v1 * cos(theta) - v2 * sin(theta);
        der(y) = v1 * sin(theta) + v2 * cos(theta);
    }
    lagrangian { (J + m * a^2) / 2 * omega^2 + m / 2 * (v1^2 + v2^2) + m * a * omega * v2 }
    impacts { blade: v2 = 0; stop: v1 = 0, omega = 0; }
)]
#[derive(Clone, Copy, Debug)]
struct Skate {
    m: f64,
    J: f64,
    a: f64,
}

#[test]
fn a_blade_set_down_on_ice_turns_the_skate() {
    let skate = Skate { m: 2.0, J: 0.5, a: 0.3 };
    let state = SkateState { theta: 0.4, x: 1.0, y: 2.0, omega: 0.7, v1: 1.1, v2: 0.9 };
    let (after, impulses) = skate.impact_blade(0.0, &state).unwrap();
    // the angular momentum about the blade stays: (J + m a²) ω + m a v2
    let about_blade = (0.5 + 2.0 * 0.09) * 0.7 + 2.0 * 0.3 * 0.9;
    assert!((after.omega - about_blade / 0.68).abs() < 1e-15 && after.v2.abs() < 1e-15 && after.v1 == 1.1);
    assert_eq!((after.theta, after.x, after.y), (0.4, 1.0, 2.0));
    let momentum = |state: &SkateState| 2.0 * (state.v2 + 0.3 * state.omega);
    assert!((impulses.blade - (momentum(&after) - momentum(&state))).abs() < 1e-14);
    assert_eq!(impulses.stop, [0.0; 2]);
    // it loses ½ sᵀK⁻¹s, and a second time nothing
    let lost = skate.energy(0.0, &state) - skate.energy(0.0, &after);
    let mobility = 1.0 / 2.0 + 0.09 / 0.5;
    assert!((lost - 0.5 * 0.81 / mobility).abs() < 1e-14, "{lost}");
    let (again, _) = skate.impact_blade(0.0, &after).unwrap();
    assert!((again.omega - after.omega).abs() < 1e-15);
    let (still, impulses) = skate.impact_stop(0.0, &state).unwrap();
    assert!(still.v1.abs() < 1e-15 && still.omega.abs() < 1e-15 && impulses.blade == 0.0);
}

/// A wheel that falls on the ground and begins to roll there.
#[nonholonomic(
    base { x, y, phi }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) + J / 2 * der(phi)^2 - m * g * y }
    impacts { ground: y >= r, der(x) + r * der(phi) = 0 with restitution e; }
)]
#[derive(Clone, Copy, Debug)]
struct Wheel {
    m: f64,
    J: f64,
    g: f64,
    r: f64,
    e: f64,
}

#[test]
fn a_wheel_that_touches_the_ground_rolls() {
    let wheel = Wheel { m: 3.0, J: 0.2, g: 9.81, r: 0.5, e: 0.6 };
    let state = WheelState { x: 1.0, y: 0.5, phi: 0.0, x_dot: 2.0, y_dot: -1.5, phi_dot: 1.0 };
    let (after, impulses) = wheel.impact_ground(0.0, &state).unwrap();
    // the gap bounces, the slip ends: the angular momentum about the contact stays
    assert!((after.y_dot - 0.6 * 1.5).abs() < 1e-15, "{after:?}");
    assert!((after.x_dot + 0.5 * after.phi_dot).abs() < 1e-15);
    let about = |state: &WheelState| 0.2 * state.phi_dot - 3.0 * 0.5 * state.x_dot;
    assert!((about(&after) - about(&state)).abs() < 1e-14);
    assert!((impulses.ground[0] - 3.0 * 1.6 * 1.5).abs() < 1e-14);
    assert!((impulses.ground[1] - 3.0 * (after.x_dot - 2.0)).abs() < 1e-14);
    // above the ground, or on the way up, nothing holds it
    for state in [WheelState { y: 0.6, ..state }, WheelState { y_dot: 0.1, ..state }] {
        assert_eq!(wheel.impact_ground(0.0, &state).unwrap().0, state);
    }
}

/// An arm of two links whose elbow has a stop on either side.
#[nonholonomic(
    base { shoulder, elbow }
    let upper = [cos(shoulder), sin(shoulder)];
    let lower = upper + [cos(shoulder + elbow), sin(shoulder + elbow)];
    lagrangian { kinetic(m, upper) + kinetic(m, lower) }
    assume { high > low; }
    impacts { stops: elbow >= low, elbow <= high with restitution e; }
)]
#[derive(Clone, Copy, Debug)]
struct Arm {
    m: f64,
    low: f64,
    high: f64,
    e: f64,
}

#[test]
fn joints_turn_back_at_their_limits() {
    let arm = Arm { m: 1.5, low: -0.2, high: 2.0, e: 0.5 };
    let momentum = |state: &ArmState| {
        // p of the shoulder, which no impulse of the elbow changes
        let c = state.elbow.cos();
        1.5 * ((3.0 + 2.0 * c) * state.shoulder_dot + (1.0 + c) * state.elbow_dot)
    };
    for (elbow, rate, row) in [(-0.2, -3.0, 0), (2.0, 1.0, 1)] {
        let state = ArmState { shoulder: 0.3, elbow, shoulder_dot: 0.4, elbow_dot: rate };
        let (after, impulses) = arm.impact_stops(0.0, &state).unwrap();
        assert!((after.elbow_dot + 0.5 * rate).abs() < 1e-14, "{after:?}");
        assert!((momentum(&after) - momentum(&state)).abs() < 1e-14);
        assert!(impulses.stops[row] > 0.0 && impulses.stops[1 - row] == 0.0);
        assert!(arm.energy(0.0, &after) < arm.energy(0.0, &state));
        assert_eq!(arm.event_stops(0.0, &state)[row], 0.0);
    }
}

/// A rod over a table.
#[nonholonomic(
    base { x, y, th }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) + J / 2 * der(th)^2 - m * g * y }
    impacts { ends: y - l * sin(th) >= 0, y + l * sin(th) >= 0 with restitution e; }
)]
#[derive(Clone, Copy, Debug)]
struct Rod {
    m: f64,
    J: f64,
    g: f64,
    l: f64,
    e: f64,
}

#[test]
fn two_ends_at_once_are_a_complementarity() {
    let rod = Rod { m: 1.0, J: 0.2, g: 9.81, l: 1.0, e: 0.0 };
    let flat = RodState { y_dot: -1.0, ..RodState::default() };
    // flat, without turning: both ends push alike
    let (after, impulses) = rod.impact_ends(0.0, &flat).unwrap();
    assert!(after.y_dot.abs() < 1e-15 && after.th_dot.abs() < 1e-15, "{after:?}");
    assert!((impulses.ends[0] - 0.5).abs() < 1e-15 && (impulses.ends[1] - 0.5).abs() < 1e-15);
    // turning, so that one end comes down fast: it alone pushes, since the other is thrown up
    let (after, impulses) = rod.impact_ends(0.0, &RodState { th_dot: 0.9, ..flat }).unwrap();
    let speeds = [after.y_dot - after.th_dot, after.y_dot + after.th_dot];
    for k in 0..2 {
        assert!(impulses.ends[k] >= 0.0 && speeds[k] > -1e-15, "{impulses:?} {speeds:?}");
        assert!(impulses.ends[k] * speeds[k] < 1e-15, "{impulses:?} {speeds:?}");
    }
    assert!(rod.energy(0.0, &after) < rod.energy(0.0, &RodState { th_dot: 0.9, ..flat }));
    // random falls: complementarity, and energy does not grow with one e
    let mut seed = 1_u64;
    let mut random = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from(u32::try_from(seed >> 32).unwrap()) / f64::from(u32::MAX) * 2.0 - 1.0
    };
    let mut settled = 0;
    for _ in 0..500 {
        let rod = Rod { e: random().abs(), J: 0.01 + random().abs(), ..rod };
        let state = RodState { x_dot: random(), y_dot: random(), th_dot: random(), ..RodState::default() };
        // with much restitution the ends may go to and fro without end
        let (after, impulses) = match rod.impact_ends(0.0, &state) {
            Err(ImpactError::Unsettled { jumps: 8, .. }) => continue,
            jump => jump.unwrap(),
        };
        settled += 1;
        let speeds = |state: &RodState| [state.y_dot - state.th_dot, state.y_dot + state.th_dot];
        for k in 0..2 {
            assert!(impulses.ends[k] >= 0.0 && speeds(&after)[k] > -1e-14, "{state:?} {after:?}");
        }
        assert!(rod.energy(0.0, &after) <= rod.energy(0.0, &state) + 1e-14, "{state:?} {after:?}");
    }
    assert!(settled > 450, "{settled}");
}

/// A thigh and a shank in flight, whose foot comes down and grips the ground.
#[nonholonomic(
    base { x, y, hip, knee }
    let down(q) = [sin(q), -cos(q)];
    let thigh = [x, y] + l / 2 * down(hip);
    let shank = [x, y] + l * down(hip) + l / 2 * down(hip + knee);
    let foot = [x, y] + l * down(hip) + l * down(hip + knee);
    lagrangian {
        kinetic(M, [x, y]) + kinetic(m, J, thigh, hip) + kinetic(m, J, shank, hip + knee)
        - g * (M * y + m * (thigh[1] + shank[1]))
    }
    impacts { grip: foot[1] >= 0, der(foot)[0] = 0; }
    assume { M > 0; m > 0; J > 0; l > 0; }
)]
#[derive(Clone, Copy, Debug)]
struct Leg {
    M: f64,
    m: f64,
    J: f64,
    l: f64,
    g: f64,
}

/// A foot that stands and has been moved by next to nothing is struck again: what is left then is round-off of
/// velocities that are large beside the impulse.
#[test]
fn a_foot_that_nearly_stands_is_struck_again() {
    let leg = Leg { M: 10.0, m: 2.0, J: 0.05, l: 0.5, g: 9.81 };
    let mut seed = 9_u64;
    let mut random = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from(u32::try_from(seed >> 32).unwrap()) / f64::from(u32::MAX) * 2.0 - 1.0
    };
    let rates = |s: &LegState| {
        let (thigh, shank) = (s.hip, s.hip + s.knee);
        let (w, o) = (0.5 * s.hip_dot, 0.5 * (s.hip_dot + s.knee_dot));
        [s.y_dot + w * thigh.sin() + o * shank.sin(), s.x_dot + w * thigh.cos() + o * shank.cos()]
    };
    let mut struck = 0;
    for k in 0..400 {
        let (hip, knee) = (0.7 * random(), -0.7 - 0.6 * random());
        let falling = LegState {
            y: 0.5 * (hip.cos() + (hip + knee).cos()),
            hip,
            knee,
            x_dot: random(),
            y_dot: -1.0 - random(),
            hip_dot: 5.0 * random(),
            knee_dot: 5.0 * random(),
            ..LegState::default()
        };
        let (stands, _) = leg.impact_grip(0.0, &falling).unwrap();
        let small = 10_f64.powi(-6 - k % 10);
        let moved = LegState { y_dot: stands.y_dot - small, ..stands };
        let (again, impulses) = leg.impact_grip(0.0, &moved).unwrap();
        let closing = rates(&moved)[0] < -1e-14;
        struck += usize::from(closing);
        let [gap, slip] = rates(&again);
        assert!(!closing || impulses.grip[0] >= 0.0 && gap > -1e-14 && slip.abs() < 1e-14, "{gap} {slip}");
    }
    assert!(struck > 150, "{struck}");
}

//! Routh reduction: the reduced system against the whole one, pointwise and along trajectories.

use std::path::Path;

use nh_tests::random::Random;
use nonholonomic::prelude::*;

/// The whole system and its reduction, from the same sections.
macro_rules! both {
    (
        $(#[$doc:meta])*
        { $($sections:tt)* } routh { $($routh:tt)* } $(emit { $($emit:tt)* })?
        struct $whole:ident, $reduced:ident { $($field:ident),*; $($level:ident),* }
    ) => {
        $(#[$doc])*
        #[nonholonomic($($sections)* $(emit { $($emit)* })?)]
        #[derive(Clone, Copy, Debug)]
        struct $whole { $($field: f64),* }

        $(#[$doc])*
        #[nonholonomic($($sections)* routh { $($routh)* } $(emit { $($emit)* })?)]
        #[derive(Clone, Copy, Debug)]
        struct $reduced { $($field: f64,)* $($level: f64),* }
    };
}

both! {
    /// The last example of CM: the momentum along y is conserved.
    {
        base { x, y, z }
        lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) }
        constraints { der(z) = x * der(x); }
    }
    routh { y = mu; }
    emit { jacobian, multipliers }
    struct Particle, ReducedParticle { m; mu }
}

/// Checks mathematics (22).
#[test]
fn the_example_of_crampin_and_mestdag() {
    let particle = ReducedParticle { m: 1.3, mu: 0.7 };
    let mut random = Random::new(5);
    for _ in 0..20 {
        let [x, z, x_dot] = std::array::from_fn(|_| random.between(-2.0, 2.0));
        let state = ReducedParticleState { x, z, x_dot };
        let rate = particle.derivative(0.0, &state, &());
        // (1 + x²) ẍ + x ẋ² = 0
        let expected = -x * x_dot * x_dot / (1.0 + x * x);
        assert!((rate.x_dot - expected).abs() < 1e-14 * (1.0 + expected.abs()), "{rate:?}");
        assert!((rate.z - x * x_dot).abs() < 1e-15);
        let y_dot = particle.mu / particle.m;
        assert!((particle.velocity(0.0, &state).y_dot - y_dot).abs() < 1e-15);
        assert!((particle.quadratures(0.0, &state).y - y_dot).abs() < 1e-15);
        let whole = Particle { m: 1.3 };
        let full = ParticleState { x, z, x_dot, y: 0.0, y_dot };
        assert!((particle.energy(0.0, &state) - whole.energy(0.0, &full)).abs() < 1e-13);
    }
    let report = ReducedParticle::REPORT;
    for part in
        ["the momentum of y: m*y_dot = mu", "the Routhian: ", "left to quadratures: y", "the energy ("]
    {
        assert!(report.contains(part), "{part}\n{report}");
    }
}

both! {
    /// A spherical pendulum.
    {
        base { theta, phi }
        lagrangian {
            m * l^2 / 2 * (der(theta)^2 + sin(theta)^2 * der(phi)^2) + m * g * l * cos(theta)
        }
    }
    routh { phi = mu; }
    struct Pendulum, ReducedPendulum { m, l, g; mu }
}

both! {
    /// A charged particle by its connection, on a rough surface: a gyroscopic force of the momentum
    /// and one of the constraint; the momentum has velocities of the rest in it.
    {
        base { x, w, z, y }
        lagrangian {
            let along = der(y) + b * x * w * der(x) + b * x^2 / 2 * der(w);
            m / 2 * (der(x)^2 + der(w)^2 + der(z)^2) + along^2 / 2 - k / 2 * (x^2 + w^2)
        }
        constraints { der(z) = x * der(w); }
        symmetries { charge: der(y); }
    }
    routh { charge = e; }
    struct Charged, ReducedCharged { m, b, k; e }
}

both! {
    /// A heavy symmetric top: its axial spin belongs to no coordinate.
    {
        base { g[3] }
        basis { w[3] }
        anchor {
            der(g[0]) = g[1] * w[2] - g[2] * w[1];
            der(g[1]) = g[2] * w[0] - g[0] * w[2];
            der(g[2]) = g[0] * w[1] - g[1] * w[0];
        }
        brackets so(3) { w[0], w[1], w[2] }
        lagrangian { A / 2 * (w[0]^2 + w[1]^2) + C / 2 * w[2]^2 - h * g[2] }
        symmetries { axial: w[2]; }
    }
    routh { axial = spin; }
    struct Top, ReducedTop { A, C, h; spin }
}

both! {
    /// D by sections that span it, with a force along the one that is left.
    {
        base { x, y, z }
        lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) }
        frame { slide = der(x) + x * der(z); across = der(y); }
        distribution { slide, across }
        forces { slide: -c * slide * across; }
        outputs { speed = sqrt(slide^2 + across^2); }
        symmetries { drift: across; }
    }
    routh { drift = mu; }
    struct Spanned, ReducedSpanned { m, c; mu }
}

both! {
    /// Constant speed in the plane: a nonlinear constraint, so that the level is one more of them.
    {
        base { x, y, z }
        lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) + c * der(x) * der(z) - k * x }
        constraints { speed: der(x)^2 + der(y)^2 = c^2; }
    }
    routh { z = mu; }
    emit { multipliers }
    struct ConstantSpeed, ReducedConstantSpeed { m, k, c; mu }
}

both! {
    /// Two levels, which share velocities.
    {
        base { a, b, x, y }
        lagrangian {
            m / 2 * (der(x)^2 + der(y)^2) + m * n / 4 * der(x) * der(y)
                + der(a)^2 / 2 + der(b)^2 / 2 + a * der(b) * der(x) + sin(b) * der(a) * der(y) - n * a * b^2
        }
        constraints { der(b) = a * der(a); }
    }
    routh { x = mu; y = nu; }
    struct Two, ReducedTwo { m, n; mu, nu }
}

/// Compares the rates of a reduced state with those of the whole state that belongs to it.
macro_rules! same_motion {
    ($whole:expr, $reduced:expr, $state:ident => $full:ident { $($name:ident),*; $($lost:ident = $value:expr),* }) => {{
        let (whole, reduced) = ($whole, $reduced);
        let mut random = Random::new(23);
        for _ in 0..50 {
            let mut $state = reduced.derivative(0.0, &Default::default(), &());
            let n = $state.to_array().len();
            let mut array = $state.to_array();
            array.copy_from_slice(&random.list(n, -1.0, 1.0));
            $state = State::from_array(array);
            let full = $full { $($name: $state.$name,)* $($lost: $value),* };
            let (rate, expected) = (reduced.derivative(0.0, &$state, &()), whole.derivative(0.0, &full, &()));
            $(
                let (found, wanted) = (rate.$name, expected.$name);
                assert!((found - wanted).abs() < 1e-12 * (1.0 + wanted.abs()), "{}: {found} {wanted}", stringify!($name));
            )*
        }
    }};
}

#[test]
fn reduced_rates_are_those_of_the_whole() {
    let reduced = ReducedPendulum { m: 1.2, l: 0.7, g: 9.81, mu: 0.4 };
    same_motion!(
        Pendulum { m: 1.2, l: 0.7, g: 9.81 }, reduced,
        state => PendulumState { theta, theta_dot; phi = 0.0, phi_dot = reduced.velocity(0.0, &state).phi_dot }
    );
    let reduced = ReducedCharged { m: 1.2, b: 0.7, k: 1.1, e: 0.4 };
    same_motion!(
        Charged { m: 1.2, b: 0.7, k: 1.1 }, reduced,
        state => ChargedState { x, w, z, x_dot, w_dot; y = 0.0, y_dot = reduced.velocity(0.0, &state).y_dot }
    );
    let reduced = ReducedSpanned { m: 1.2, c: 0.7, mu: 0.4 };
    same_motion!(
        Spanned { m: 1.2, c: 0.7 }, reduced,
        state => SpannedState { x, z, slide; y = 0.0, across = 0.4 / 1.2 }
    );
    let reduced = ReducedTwo { m: 1.9, n: 0.7, mu: 0.4, nu: -0.3 };
    same_motion!(
        Two { m: 1.9, n: 0.7 }, reduced,
        state => TwoState { a, b, a_dot; x = 0.0, y = 0.0,
            x_dot = reduced.velocity(0.0, &state).x_dot, y_dot = reduced.velocity(0.0, &state).y_dot }
    );
}

#[test]
fn a_momentum_that_belongs_to_no_coordinate() {
    let (whole, reduced) = (Top { A: 1.2, C: 0.4, h: 0.7 }, ReducedTop { A: 1.2, C: 0.4, h: 0.7, spin: 0.9 });
    let mut random = Random::new(3);
    for _ in 0..20 {
        let g = std::array::from_fn(|_| random.between(-1.0, 1.0));
        let [w_0, w_1] = std::array::from_fn(|_| random.between(-1.0, 1.0));
        let rate = reduced.derivative(0.0, &ReducedTopState { g, w_0, w_1 }, &());
        let full = TopState { g, w: [w_0, w_1, 0.9 / 0.4] };
        let expected = whole.derivative(0.0, &full, &());
        let found = [rate.g[0], rate.g[1], rate.g[2], rate.w_0, rate.w_1];
        for (found, expected) in found.iter().zip(<[f64; 6]>::from(expected)) {
            assert!((found - expected).abs() < 1e-14, "{found} {expected}");
        }
    }
    // every coordinate is needed
    assert!(!ReducedTop::REPORT.contains("left to quadratures"), "{}", ReducedTop::REPORT);
}

#[test]
fn in_the_projected_formulation_the_level_is_kept_like_a_constraint() {
    let (whole, reduced) =
        (ConstantSpeed { m: 1.2, k: 0.4, c: 0.9 }, ReducedConstantSpeed { m: 1.2, k: 0.4, c: 0.9, mu: 0.3 });
    let mut state = ReducedConstantSpeedState { x: 0.2, y: -0.4, x_dot: 0.5, y_dot: 0.8, z_dot: 0.1 };
    reduced.project(0.0, &mut state).unwrap();
    let residual = reduced.constraint_residual(0.0, &state);
    assert!(residual.speed.abs() < 1e-14 && residual.z.abs() < 1e-14, "{residual:?}");
    let ReducedConstantSpeedState { x, y, x_dot, y_dot, z_dot } = state;
    assert!((1.2 * z_dot + 0.9 * x_dot - 0.3).abs() < 1e-14);
    let full = ConstantSpeedState { x, y, z: 0.0, x_dot, y_dot, z_dot };
    let (rate, expected) = (reduced.derivative(0.0, &state, &()), whole.derivative(0.0, &full, &()));
    let found = [rate.x, rate.y, rate.x_dot, rate.y_dot, rate.z_dot];
    let expected = [expected.x, expected.y, expected.x_dot, expected.y_dot, expected.z_dot];
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-13, "{found} {expected}");
    }
    let (found, expected) = (reduced.multipliers(0.0, &state, &()), whole.multipliers(0.0, &full, &()));
    assert!((found.speed - expected.speed).abs() < 1e-13, "{found:?} {expected:?}");
}

/// In a magnetic field, on a rough slope.
#[nonholonomic(
    base { x, y, z, s }
    lagrangian {
        m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) + (1 + x^2) / 2 * der(s)^2 + y * der(s) * der(x)
            + sin(x) * der(s) * der(y) + B * x * der(y) - k / 2 * x * y^2 - z * x
    }
    constraints { der(z) = y * der(x) + c * der(y); }
    routh { s = mu; }
)]
#[derive(Clone, Copy, Debug)]
struct InField {
    m: f64,
    B: f64,
    k: f64,
    c: f64,
    mu: f64,
}

#[test]
fn numbers_from_unreduced_multipliers() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("reference/splitting.json");
    let all: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let numbers = |name: &str| -> Vec<f64> {
        all["charged"][name].as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
    };
    let (q, v, expected) = (numbers("q"), numbers("v"), numbers("acceleration"));
    let mu = all["charged"]["level"].as_f64().unwrap();
    let system = InField { m: 1.3, B: 0.8, k: 1.1, c: 0.45, mu };
    let state = InFieldState { x: q[0], y: q[1], z: q[2], x_dot: v[0], y_dot: v[1] };
    assert!((system.velocity(0.0, &state).s_dot - v[3]).abs() < 1e-14);
    let rate = system.derivative(0.0, &state, &());
    for (found, expected) in [rate.x_dot, rate.y_dot].into_iter().zip(expected) {
        assert!((found - expected).abs() < 1e-13, "{found} {expected}");
    }
}

#[test]
fn trajectories_and_their_reconstruction() {
    let reduced = ReducedCharged { m: 1.2, b: 0.7, k: 1.1, e: 0.4 };
    let start = ReducedChargedState { x: 0.4, w: -0.3, z: 0.1, x_dot: 0.5, w_dot: 0.6 };
    let full = ChargedState {
        x: 0.4,
        w: -0.3,
        z: 0.1,
        y: 0.0,
        x_dot: 0.5,
        w_dot: 0.6,
        y_dot: reduced.velocity(0.0, &start).y_dot,
    };
    let whole = Charged { m: 1.2, b: 0.7, k: 1.1 };
    assert!((whole.momenta(0.0, &full).charge - 0.4).abs() < 1e-15);
    let method = Dopri5::new().rtol(1e-12).atol(1e-13);
    let mut short = Integrator::new(reduced, method, 0.0, start);
    let mut long = Integrator::new(whole, method, 0.0, full);
    // the quadrature of y by Gauss' formula with two nodes
    let (mut y, steps) = (0.0, 4000);
    let h = 10.0 / f64::from(steps);
    for step in 0..steps {
        for node in [-1.0, 1.0] {
            short.advance_to(h * (f64::from(step) + 0.5 + node / 12.0_f64.sqrt())).unwrap();
            y += h / 2.0 * reduced.quadratures(short.time(), short.state()).y;
        }
    }
    short.advance_to(10.0).unwrap();
    long.advance_to(10.0).unwrap();
    let (found, expected) = (short.state(), long.state());
    let pairs = [
        (found.x, expected.x),
        (found.w, expected.w),
        (found.z, expected.z),
        (y, expected.y),
        (found.x_dot, expected.x_dot),
        (found.w_dot, expected.w_dot),
    ];
    for (found, expected) in pairs {
        assert!((found - expected).abs() < 1e-9, "{pairs:?}");
    }
    let energy = reduced.energy(10.0, short.state()) - reduced.energy(0.0, &start);
    assert!(energy.abs() < 1e-10, "{energy:e}");
}

both! {
    /// A momentum that is not linear in the velocities.
    {
        base { x, y }
        lagrangian { m / 2 * der(x)^2 + (der(y)^2 + der(y)^4) / 2 + x * der(y) * der(x) }
        formulation { projected }
    }
    routh { y = mu; }
    struct Quartic, ReducedQuartic { m; mu }
}

#[test]
fn nonlinear_momenta_have_levels_in_the_projected_formulation() {
    let reduced = ReducedQuartic { m: 1.2, mu: 0.8 };
    let mut state = ReducedQuarticState { x: 0.3, x_dot: -0.4, y_dot: 0.5 };
    reduced.project(0.0, &mut state).unwrap();
    let ReducedQuarticState { x, x_dot, y_dot } = state;
    assert!((y_dot + 2.0 * y_dot.powi(3) + x * x_dot - 0.8).abs() < 1e-14);
    let full = QuarticState { x, y: 0.0, x_dot, y_dot };
    let rate = reduced.derivative(0.0, &state, &());
    let expected = Quartic { m: 1.2 }.derivative(0.0, &full, &());
    assert!((rate.x_dot - expected.x_dot).abs() < 1e-13, "{rate:?} {expected:?}");
    assert!((rate.y_dot - expected.y_dot).abs() < 1e-13, "{rate:?} {expected:?}");
}

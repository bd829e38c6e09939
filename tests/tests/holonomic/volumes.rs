//! Volumes that motions keep where position constraints hold, mathematics (19): densities against the divergence of
//! density times motion in charts of N, by differences, and against declarations in minimal coordinates.
#![allow(non_snake_case, reason = "parameters are written as in mechanics")]

use nh_tests::flux::assert_kept;
use nh_tests::random::Random;
use nonholonomic::prelude::*;

/// A pendulum on a rope that is drawn in and let out.
#[nonholonomic(
    base { x, y }
    holonomic { rope: x^2 + y^2 = (l + a * sin(t))^2; }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - m * g * y }
    volume;
    emit { volume, divergence }
)]
#[derive(Clone, Copy, Debug)]
struct Rope {
    m: f64,
    l: f64,
    a: f64,
    g: f64,
}

/// The same with one velocity in the state.
#[nonholonomic(
    base { x, y }
    holonomic { rope: x^2 + y^2 = (l + a * sin(t))^2; }
    independent { der(x) }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - m * g * y }
    volume;
    emit { volume, divergence }
)]
#[derive(Clone, Copy, Debug)]
struct RopeByX {
    m: f64,
    l: f64,
    a: f64,
    g: f64,
}

/// Place and velocity of the rope's end below its pivot, from t, x and ẋ.
fn below((l, a): (f64, f64), &[t, x, x_dot]: &[f64; 3]) -> (f64, f64) {
    let (length, rate) = (l + a * t.sin(), a * t.cos());
    let y = -(length * length - x * x).sqrt();
    (y, (length * rate - x * x_dot) / y)
}

#[test]
fn of_a_moving_constraint() {
    let mut random = Random::new(31);
    for _ in 0..10 {
        let mut draw = || random.between(0.2, 0.9);
        let (m, l, a, g) = (draw(), 1.5 + draw(), 0.5 * draw(), 9.81);
        let at: [f64; 3] = std::array::from_fn(|_| draw());
        // dx dy dẋ dẏ / (df dφ) = dx dẋ / det ∂(f, φ)/∂(y, ẏ), and dx dy dẋ / df = dx dẋ / ∂f/∂y
        let rope = Rope { m, l, a, g };
        let flux = |point: &[f64; 3]| {
            let (y, y_dot) = below((l, a), point);
            let state = RopeState { x: point[1], y, x_dot: point[2], y_dot };
            let rate = rope.derivative(point[0], &state, &());
            let density = rope.volume_density(point[0], &state) / (4.0 * y * y);
            [density, density * rate.x, density * rate.x_dot]
        };
        assert_kept(flux, at);
        let rope = RopeByX { m, l, a, g };
        let flux = |point: &[f64; 3]| {
            let (y, _) = below((l, a), point);
            let state = RopeByXState { x: point[1], y, x_dot: point[2] };
            let rate = rope.derivative(point[0], &state, &());
            let density = rope.volume_density(point[0], &state) / y.abs();
            [density, density * rate.x, density * rate.x_dot]
        };
        assert_kept(flux, at);
    }
}

/// A particle on a ramp over the plane, whose blade lets it move in one direction at each height. A force acts off the
/// ramp, and the volume is kept on it alone.
#[nonholonomic(
    base { x, y, z, w }
    holonomic { ramp: l * w = y^2; }
    constraints { blade: der(z) = w * der(x); }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2 + der(w)^2) - k / 2 * x^2 }
    forces { x: k * (l * w - y^2) * der(x)^2; }
    volume;
    emit { volume, divergence }
)]
#[derive(Clone, Copy, Debug)]
struct Ramp {
    m: f64,
    l: f64,
    k: f64,
}

/// The same with two velocities in the state, and a claimed density, which is one on the ramp alone.
#[nonholonomic(
    base { x, y, z, w }
    holonomic { ramp: l * w = y^2; }
    constraints { blade: der(z) = w * der(x); }
    independent { der(x), der(y) }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2 + der(w)^2) - k / 2 * x^2 }
    forces { x: k * (l * w - y^2) * der(x)^2; }
    volume { sqrt(1 + y^4 / l^2) * (l^2 + 4 * w * l); }
    emit { volume, divergence }
)]
#[derive(Clone, Copy, Debug)]
struct RampByY {
    m: f64,
    l: f64,
    k: f64,
}

/// The same in coordinates that need no position constraint.
#[nonholonomic(
    base { x, y, z }
    constraints { blade: der(z) = y^2 / l * der(x); }
    lagrangian { m / 2 * (der(x)^2 + (1 + 4 * y^2 / l^2) * der(y)^2 + der(z)^2) - k / 2 * x^2 }
    emit { volume, divergence }
)]
#[derive(Clone, Copy, Debug)]
struct Minimal {
    m: f64,
    l: f64,
    k: f64,
}

#[test]
fn of_a_nonholonomic_system_on_a_surface() {
    let mut random = Random::new(32);
    let mut draw = || random.between(0.2, 0.9);
    let (m, l, k) = (draw(), draw(), draw());
    let (full, kept, minimal) = (Ramp { m, l, k }, RampByY { m, l, k }, Minimal { m, l, k });
    let mut ratios = Vec::new();
    for _ in 0..10 {
        let [x, y, z, x_dot, y_dot]: [f64; 5] = std::array::from_fn(|_| draw());
        let w = y * y / l;
        let in_minimal = MinimalState { x, y, z, x_dot, y_dot };
        let in_kept = RampByYState { x, y, z, w, x_dot, y_dot };
        let in_full = RampState { x, y, z, w, x_dot, y_dot, z_dot: w * x_dot, w_dot: 2.0 * y * y_dot / l };
        // dw, dẇ and dż are divided out with constant factors
        let densities = [
            full.volume_density(0.0, &in_full),
            kept.volume_density(0.0, &in_kept),
            minimal.volume_density(0.0, &in_minimal),
        ];
        ratios.push([densities[0] / densities[2], densities[1] / densities[2]]);
        // so that the divergences are the same, too
        let divergences = [
            full.divergence(0.0, &in_full, &()),
            kept.divergence(0.0, &in_kept, &()),
            minimal.divergence(0.0, &in_minimal, &()),
        ];
        assert!(divergences[2].abs() > 1e-3);
        assert!((divergences[0] - divergences[2]).abs() < 1e-14 * (1.0 + divergences[2].abs()));
        assert!((divergences[1] - divergences[2]).abs() < 1e-14 * (1.0 + divergences[2].abs()));
        let flux = |point: &[f64; 5]| {
            let state = MinimalState::from(*point);
            let rate: [f64; 5] = minimal.derivative(0.0, &state, &()).into();
            let [x, y, z, x_dot, y_dot] = *point;
            let on_ramp = RampByYState { x, y, z, w: y * y / l, x_dot, y_dot };
            rate.map(|rate| rate * kept.volume_density(0.0, &on_ramp))
        };
        assert_kept(flux, in_minimal.into());
    }
    for ratio in &ratios {
        for (value, first) in ratio.iter().zip(&ratios[0]) {
            assert!((value / first - 1.0).abs() < 1e-14, "{ratios:?}");
        }
    }
}

/// A crank, a coupler and a rocker.
#[nonholonomic(
    base { crank, coupler, rocker }
    holonomic {
        closure: [
            a * cos(crank) + b * cos(coupler) - c * cos(rocker) - d,
            a * sin(crank) + b * sin(coupler) - c * sin(rocker)
        ] = 0;
    }
    lagrangian { (J * der(crank)^2 + K * der(coupler)^2 + L * der(rocker)^2) / 2 - k * cos(coupler) }
    emit { volume }
)]
#[derive(Clone, Copy, Debug)]
struct Linkage {
    a: f64,
    b: f64,
    c: f64,
    d: f64,
    J: f64,
    K: f64,
    L: f64,
    k: f64,
}

/// The same with the crank's velocity in the state.
#[nonholonomic(
    base { crank, coupler, rocker }
    holonomic {
        closure: [
            a * cos(crank) + b * cos(coupler) - c * cos(rocker) - d,
            a * sin(crank) + b * sin(coupler) - c * sin(rocker)
        ] = 0;
    }
    independent { der(crank) }
    lagrangian { (J * der(crank)^2 + K * der(coupler)^2 + L * der(rocker)^2) / 2 - k * cos(coupler) }
    emit { volume }
)]
#[derive(Clone, Copy, Debug)]
struct ByCrank {
    a: f64,
    b: f64,
    c: f64,
    d: f64,
    J: f64,
    K: f64,
    L: f64,
    k: f64,
}

#[test]
fn of_a_loop() {
    let (a, b, c, d) = (1.0, 3.0, 2.5, 3.0);
    let (J, K, L, k) = (0.3, 0.7, 0.5, 0.4);
    let (full, kept) = (Linkage { a, b, c, d, J, K, L, k }, ByCrank { a, b, c, d, J, K, L, k });
    let mut random = Random::new(33);
    for _ in 0..10 {
        let at = [random.between(0.3, 2.0), random.between(0.5, 2.0)];
        // coupler and rocker by Newton's method, with the determinant of ∂f/∂(coupler, rocker)
        let closed = |crank: f64, crank_dot: f64| {
            let (mut coupler, mut rocker) = (0.8_f64, 1.8_f64);
            let det = |coupler: f64, rocker: f64| b * c * (coupler - rocker).sin();
            for _ in 0..40 {
                let f = a * crank.cos() + b * coupler.cos() - c * rocker.cos() - d;
                let g = a * crank.sin() + b * coupler.sin() - c * rocker.sin();
                let det = det(coupler, rocker);
                coupler -= (-c * rocker.cos() * f - c * rocker.sin() * g) / det;
                rocker -= (-b * coupler.sin() * g - b * coupler.cos() * f) / det;
            }
            let state = ByCrankState { crank, coupler, rocker, crank_dot };
            (state, det(coupler, rocker))
        };
        let flux = |point: &[f64; 2]| {
            let (state, det) = closed(point[0], point[1]);
            let rate = kept.derivative(0.0, &state, &());
            let density = kept.volume_density(0.0, &state) / det;
            [density * rate.crank, density * rate.crank_dot]
        };
        assert_kept(flux, at);
        let flux = |point: &[f64; 2]| {
            let (state, det) = closed(point[0], point[1]);
            let ByCrankVelocity { crank_dot, coupler_dot, rocker_dot } = kept.velocity(0.0, &state);
            let ByCrankState { crank, coupler, rocker, .. } = state;
            let state = LinkageState { crank, coupler, rocker, crank_dot, coupler_dot, rocker_dot };
            let rate = full.derivative(0.0, &state, &());
            let density = full.volume_density(0.0, &state) / (det * det);
            [density * rate.crank, density * rate.crank_dot]
        };
        assert_kept(flux, at);
    }
}

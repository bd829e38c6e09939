//! Splittings by the declared group and over embedded bases: a sphere, a circle. Where coordinates are
//! embedded, every one of them has its lift, and (25) holds in all of them.

use nh_tests::random::Random;
use nonholonomic::prelude::*;

/// A group that is not made of translations: p ↦ p + a, (q, p) ↦ (q + b, e^b p).
#[nonholonomic(
    base { q, p, z, w }
    lagrangian { (der(q)^2 + exp(-2 * q) * der(p)^2 + der(z)^2 + der(w)^2) / 2 }
    constraints { der(w) = z^2 * der(z); }
    symmetries { shift: der(p); stretch: der(q) + p * der(p); }
    emit { splitting }
)]
#[derive(Clone, Copy, Debug)]
struct Affine;

#[test]
fn the_declared_group_is_the_one_that_splits() {
    let state =
        AffineState { q: 0.3, p: -0.2, z: 0.7, q_dot: 0.4, p_dot: 0.6, z_dot: -0.5, ..Default::default() };
    let sections = Affine.vertical_sections(0.0, &state);
    assert_eq!(sections.len(), 2);
    // along the invariant fields: p̂ = e^{−q} ṗ is the velocity along e^q ∂_p
    let first = sections[0].iter().zip([1.0, 0.0, 0.0, 0.0]);
    assert!(first.map(|(found, expected)| (found - expected).abs()).sum::<f64>() < 1e-15, "{sections:?}");
    assert!((sections[1][1] - 0.3_f64.exp()).abs() < 1e-15, "{sections:?}");
    let momenta = Affine.vertical_momenta(0.0, &state);
    assert!((momenta[1] - 0.6 * (-0.3_f64).exp()).abs() < 1e-15, "{momenta:?}");
    assert!(Affine::REPORT.contains("V along the group, has rank 2"), "{}", Affine::REPORT);
}

macro_rules! on_the_sphere {
    ($(#[$doc:meta])* $name:ident { $($more:tt)* }) => {
        $(#[$doc])*
        #[nonholonomic(
            base { g[3] }
            on { dot(g, g) = 1; }
            basis { w[3] }
            anchor {
                der(g[0]) = g[1] * w[2] - g[2] * w[1];
                der(g[1]) = g[2] * w[0] - g[0] * w[2];
                der(g[2]) = g[0] * w[1] - g[1] * w[0];
            }
            brackets so(3) { w[0], w[1], w[2] }
            lagrangian { A / 2 * w[0]^2 + B / 2 * w[1]^2 + C / 2 * w[2]^2 - g[0] * g[2] }
            $($more)*
        )]
        #[derive(Clone, Copy, Debug)]
        struct $name {
            A: f64,
            B: f64,
            C: f64,
        }
    };
}

on_the_sphere! { /// A heavy top in a field: the kernel of γ × ω is spanned by γ.
Top { emit { splitting } } }
on_the_sphere! { /// Veselova's system, a Chaplygin system over the sphere.
Veselova { constraints { dot(g, w) = 0; } emit { splitting, gyroscopic } } }

/// A rolling penny with its heading on a circle.
#[nonholonomic(
    base { c, s, x, y, psi }
    on { c^2 + s^2 = 1; }
    basis { om, vx, vy, spin }
    anchor { der(c) = -s * om; der(s) = c * om; der(x) = vx; der(y) = vy; der(psi) = spin; }
    lagrangian { m / 2 * (vx^2 + vy^2) + J / 2 * om^2 + I / 2 * spin^2 + k * c * om * spin - c }
    constraints { vx = r * c * spin; vy = r * s * spin; }
    emit { splitting }
)]
#[derive(Clone, Copy, Debug)]
struct Penny {
    m: f64,
    J: f64,
    I: f64,
    r: f64,
    k: f64,
}

/// The same with its whole group.
#[nonholonomic(
    base { c, s, x, y, psi }
    on { c^2 + s^2 = 1; }
    basis { om, vx, vy, spin }
    anchor { der(c) = -s * om; der(s) = c * om; der(x) = vx; der(y) = vy; der(psi) = spin; }
    lagrangian { m / 2 * (vx^2 + vy^2) + J / 2 * om^2 + I / 2 * spin^2 }
    constraints { vx = r * c * spin; vy = r * s * spin; }
    symmetries { turn: om + x * vy - y * vx; roll: spin; }
    emit { splitting }
)]
#[derive(Clone, Copy, Debug)]
struct Turned {
    m: f64,
    J: f64,
    I: f64,
    r: f64,
}

/// The derivative of a function of one number, by differences of sixth order.
fn slope(f: impl Fn(f64) -> f64) -> f64 {
    let h = 1e-2;
    let pair = |k: f64| f(k * h) - f(-k * h);
    (45.0 * pair(1.0) - 9.0 * pair(2.0) + pair(3.0)) / (60.0 * h)
}

/// Proves (25) by differences: y = h_κ ẋ^κ + S_ρ v^ρ, and d/dt p(h_κ) = ρ(h_κ) l_c + the force.
macro_rules! splits {
    ($system:expr, $state:ident, $n:literal, $x:expr, $rho:expr, $lagrangian:expr, [$($i:literal),*], $vertical:expr) => {{
        let system = $system;
        let (x, rho, lagrangian): ([f64; $n], fn([f64; $n], &[f64]) -> [f64; $n], fn([f64; $n], &[f64]) -> f64) =
            ($x, $rho, $lagrangian);
        let mut random = Random::new(3);
        for _ in 0..5 {
            // a state on the base, with velocities in D
            let mut array = $state::default().to_array();
            let velocities = random.list(array.len() - $n, -1.0, 1.0);
            array[..$n].copy_from_slice(&x);
            array[$n..].copy_from_slice(&velocities);
            let state = $vertical(&system, State::from_array(array));
            let rate = system.derivative(0.0, &state, &()).to_array();
            let y = system.velocity(0.0, &state);
            let y: Vec<f64> = <[f64; _]>::from(y).to_vec();
            let kept = [$($i),*];
            let speeds = kept.map(|i: usize| rate[i]);
            // the sections, as functions of the base
            let at = |x: [f64; $n]| {
                let mut array = state.to_array();
                array[..$n].copy_from_slice(&x);
                State::from_array(array)
            };
            let lifts = |x: [f64; $n]| system.horizontal_lifts(0.0, &at(x)).map(|lift| lift.to_vec());
            let inner = |x: [f64; $n]| vertical!(system, at(x), $state);
            let along = vertical_velocities!(system, state, $state);
            let combined = |x: [f64; $n]| -> Vec<f64> {
                let mut y = vec![0.0; y.len()];
                let lifts = lifts(x).into_iter().zip(speeds);
                for (section, speed) in lifts.chain(inner(x).into_iter().zip(along.iter().copied())) {
                    y.iter_mut().zip(section).for_each(|(y, component)| *y += component * speed);
                }
                y
            };
            for (found, expected) in combined(x).iter().zip(&y) {
                assert!((found - expected).abs() < 1e-12, "{:?} {y:?}", combined(x));
            }
            let momentum = |x: [f64; $n], y: &[f64], section: &[f64]| {
                slope(|e| {
                    let y: Vec<f64> = y.iter().zip(section).map(|(y, s)| y + e * s).collect();
                    lagrangian(x, &y)
                })
            };
            let moved = |direction: &[f64], e: f64| -> [f64; $n] {
                std::array::from_fn(|i| x[i] + e * direction[i])
            };
            let force = system.horizontal_force(0.0, &state);
            for (k, force) in force.iter().enumerate() {
                // d/dt p(h_k) along the motion
                let left = slope(|e| {
                    let mut array = state.to_array();
                    array.iter_mut().zip(&rate).for_each(|(z, rate)| *z += e * rate);
                    let there = State::from_array(array);
                    let y = <[f64; _]>::from(system.velocity(e, &there));
                    let x: [f64; $n] = std::array::from_fn(|i| there.to_array()[i]);
                    momentum(x, &y, &lifts(x)[k])
                });
                let direction = rho(x, &lifts(x)[k]);
                let right = slope(|e| {
                    let there = moved(&direction, e);
                    lagrangian(there, &combined(there))
                });
                assert!((left - right - force).abs() < 1e-8, "{k}: {left} {right} {force}");
            }
        }
    }};
}

macro_rules! vertical {
    ($system:ident, $state:expr, VeselovaState) => {{
        _ = $state;
        Vec::<Vec<f64>>::new()
    }};
    ($system:ident, $state:expr, $other:ident) => {
        $system.vertical_sections(0.0, &$state).map(|section| section.to_vec()).to_vec()
    };
}

macro_rules! vertical_velocities {
    ($system:ident, $state:ident, VeselovaState) => {
        Vec::<f64>::new()
    };
    ($system:ident, $state:ident, $other:ident) => {
        $system.vertical_velocities(0.0, &$state).to_vec()
    };
}

fn cross([a, b, c]: [f64; 3], w: &[f64]) -> [f64; 3] {
    [b * w[2] - c * w[1], c * w[0] - a * w[2], a * w[1] - b * w[0]]
}

fn heavy(g: [f64; 3], w: &[f64]) -> f64 {
    0.6 * w[0] * w[0] + 0.4 * w[1] * w[1] + 0.25 * w[2] * w[2] - g[0] * g[2]
}

#[test]
fn over_the_sphere_and_the_circle() {
    // on the equator, where a chart by the first two coordinates would break down, and elsewhere
    for g in [[0.6, 0.8, 0.0], [0.48, 0.6, 0.64], [0.0, 0.0, 1.0]] {
        let top = Top { A: 1.2, B: 0.8, C: 0.5 };
        splits!(top, TopState, 3, g, cross, heavy, [0, 1, 2], |_: &Top, state| state);
        let sections = top.vertical_sections(0.0, &TopState { g, w: [0.0; 3] });
        assert_eq!(sections, [g]);
        let veselova = Veselova { A: 1.2, B: 0.8, C: 0.5 };
        splits!(veselova, VeselovaState, 3, g, cross, heavy, [0, 1, 2], |system: &Veselova, mut state| {
            system.project(0.0, &mut state).unwrap();
            state
        });
    }
    let penny = Penny { m: 1.3, J: 0.4, I: 0.6, r: 0.3, k: 0.2 };
    let rho = |[c, s, ..]: [f64; 5], y: &[f64]| [-s * y[0], c * y[0], y[1], y[2], y[3]];
    let lagrangian = |[c, ..]: [f64; 5], y: &[f64]| {
        0.65 * (y[1] * y[1] + y[2] * y[2]) + 0.2 * y[0] * y[0] + 0.3 * y[3] * y[3] + 0.2 * c * y[0] * y[3] - c
    };
    for heading in [0.0_f64, 1.0, 2.5] {
        let x = [heading.cos(), heading.sin(), 0.4, -0.7, 0.2];
        splits!(penny, PennyState, 5, x, rho, lagrangian, [0, 1], |_: &Penny, state| state);
    }
    for part in ["S = D ∩ V, V along the group, has rank 1", "the group: translations"] {
        assert!(Penny::REPORT.contains(part), "{part}\n{}", Penny::REPORT);
    }
    let report = Veselova::REPORT;
    let told = "of a Chaplygin system: the anchor maps D one to one onto the rates of g[0], g[1], g[2]\n";
    assert!(report.contains(told), "{report}");
    let report = Turned::REPORT;
    assert!(report.contains("momentum equations of rank 2 alone: D lies in V along the group"), "{report}");
}

#[test]
fn the_gyroscopic_force_over_the_sphere() {
    let system = Veselova { A: 1.2, B: 0.8, C: 0.5 };
    let g = [0.48, 0.6, 0.64];
    let mut state = VeselovaState { g, w: [0.3, -0.8, 0.5] };
    system.project(0.0, &mut state).unwrap();
    let lifts = |g: [f64; 3]| system.horizontal_lifts(0.0, &VeselovaState { g, ..state });
    let field = |g: [f64; 3], i: usize| cross(g, &lifts(g)[i]);
    let speeds = cross(g, &state.w);
    let p = [1.2 * state.w[0], 0.8 * state.w[1], 0.5 * state.w[2]];
    let brackets = system.horizontal_force(0.0, &state);
    let force = <[f64; 3]>::from(system.gyroscopic(0.0, &state));
    for i in 0..3 {
        // K = [h, h] − h[X, X]: the force of the brackets and p(h[X_i, X_j]) ẋ^j
        let mut expected = brackets[i];
        for (j, speed) in speeds.into_iter().enumerate() {
            let moved = |by: [f64; 3], e: f64| -> [f64; 3] { std::array::from_fn(|k| g[k] + e * by[k]) };
            let (first, second) = (field(g, i), field(g, j));
            for k in 0..3 {
                let bracket =
                    slope(|e| field(moved(first, e), j)[k]) - slope(|e| field(moved(second, e), i)[k]);
                let lifted: f64 = lifts(g)[k].iter().zip(p).map(|(h, p)| h * p).sum();
                expected += lifted * bracket * speed;
            }
        }
        assert!((force[i] - expected).abs() < 1e-9, "{force:?} {expected}");
    }
    let power: f64 = force.iter().zip(speeds).map(|(f, v)| f * v).sum();
    assert!(power.abs() < 1e-14, "{power:e}");
}

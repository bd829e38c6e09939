//! Densities that the macro finds, against the divergence of density times motion in coordinates of the
//! phase space, by differences: nothing that the search uses takes part.
#![allow(non_snake_case, reason = "parameters are written as in mechanics")]

use nh_tests::flux::assert_kept;
use nh_tests::random::Random;
use nonholonomic::State;
use nonholonomic::prelude::*;

/// A two-wheeled robot, its centre of mass off the axle: the exponent depends on the parameters.
#[nonholonomic(
    base { x, y, th, p1, p2 }
    lagrangian {
        m / 2 * (der(x)^2 + der(y)^2) + m * l * der(th) * (cos(th) * der(y) - sin(th) * der(x))
            + J / 2 * der(th)^2 + K / 2 * (der(p1)^2 + der(p2)^2)
    }
    constraints {
        der(x) = R / 2 * cos(th) * (der(p1) + der(p2));
        der(y) = R / 2 * sin(th) * (der(p1) + der(p2));
        der(th) = R / (2 * b) * (der(p1) - der(p2));
    }
    emit { volume }
)]
#[derive(Clone, Copy, Debug)]
struct Robot {
    m: f64,
    l: f64,
    J: f64,
    b: f64,
    R: f64,
    K: f64,
}

/// Forces that make three exponents out of parameters.
#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) }
    forces {
        x: -a * der(x) * der(y) + b * der(x)^2 / (x + c) + a * der(x)^2;
        y: 2 * b * der(y) * der(x) / (x + c) - m * der(y)^2 / y / c;
    }
    emit { volume }
)]
#[derive(Clone, Copy, Debug)]
struct Driven {
    m: f64,
    a: f64,
    b: f64,
    c: f64,
}

/// A fast particle: the density in the velocities contains the determinant of the Hessian.
#[nonholonomic(
    base { x, y, z }
    lagrangian { -m * c^2 * sqrt(1 - (der(x)^2 + der(y)^2 + der(z)^2) / c^2) - k * x^2 / 2 }
    constraints { der(z) = y * der(x); }
    emit { volume }
)]
#[derive(Clone, Copy, Debug)]
struct Fast {
    m: f64,
    c: f64,
    k: f64,
}

/// A disk that may fall, in Euler angles.
#[nonholonomic(
    base { x, y, phi, theta, psi }
    lagrangian {
        m / 2 * (der(x)^2 + der(y)^2 + r^2 * cos(theta)^2 * der(theta)^2) + A / 2 * (der(theta)^2 + der(phi)^2 * sin(theta)^2)
            + C / 2 * (der(psi) + der(phi) * cos(theta))^2 - m * g * r * sin(theta)
    }
    constraints { der(x) = -r * cos(phi) * der(psi); der(y) = -r * sin(phi) * der(psi); }
    emit { volume }
)]
#[derive(Clone, Copy, Debug)]
struct Disk {
    m: f64,
    A: f64,
    C: f64,
    r: f64,
    g: f64,
}

/// Veselova's system on so(4), with the inertia for which Fedorov and Jovanović found a measure.
#[nonholonomic(
    base { g[4] }
    on { dot(g, g) = 1; }
    basis { w01, w02, w03, w12, w13, w23 }
    anchor {
        der(g[0]) = -w01 * g[1] - w02 * g[2] - w03 * g[3];
        der(g[1]) = w01 * g[0] - w12 * g[2] - w13 * g[3];
        der(g[2]) = w02 * g[0] + w12 * g[1] - w23 * g[3];
        der(g[3]) = w03 * g[0] + w13 * g[1] + w23 * g[2];
    }
    brackets so(4) { w01, w02, w03, w12, w13, w23 }
    lagrangian {
        (A[0] * A[1] * w01^2 + A[0] * A[2] * w02^2 + A[0] * A[3] * w03^2 + A[1] * A[2] * w12^2 + A[1] * A[3] * w13^2
            + A[2] * A[3] * w23^2) / 2 - g[0] * g[1] * k
    }
    constraints {
        g[0] * w12 - g[1] * w02 + g[2] * w01 = 0;
        g[0] * w13 - g[1] * w03 + g[3] * w01 = 0;
        g[0] * w23 - g[2] * w03 + g[3] * w02 = 0;
    }
    independent { w01, w02, w03 }
    emit { volume }
)]
#[derive(Clone, Copy, Debug)]
struct Veselova {
    A: [f64; 4],
    k: f64,
}

/// Routh's sphere: a ball whose centre of mass lies on its axis, claimed.
#[nonholonomic(
    base { g[3] }
    on { dot(g, g) = 1; }
    basis { w[3], u[3] }
    anchor { der(g) = cross(g, w); }
    brackets se(3) { w, u }
    lagrangian { (A * (w[0]^2 + w[1]^2) + C * w[2]^2) / 2 + m / 2 * dot(u, u) - m * a * g[2] }
    constraints {
        u[0] = w[1] * (r * g[2] + a) - w[2] * r * g[1];
        u[1] = w[2] * r * g[0] - w[0] * (r * g[2] + a);
        u[2] = r * (w[0] * g[1] - w[1] * g[0]);
    }
    volume { sqrt(A * C + A * m * r^2 * (1 - g[2]^2) + C * m * (r * g[2] + a)^2) * (A + m * (r^2 + 2 * a * r * g[2] + a^2)); }
    emit { volume }
)]
#[derive(Clone, Copy, Debug)]
struct RouthSphere {
    A: f64,
    C: f64,
    m: f64,
    a: f64,
    r: f64,
}

/// A particle kept at one speed (Gauss's thermostat), whose density has to be claimed: the constraint is
/// not linear.
#[nonholonomic(
    base { x, y }
    lagrangian { (der(x)^2 + der(y)^2) / 2 - g * y }
    constraints { der(x)^2 + der(y)^2 = u^2; }
    volume { exp(-g * y / u^2); }
    emit { volume }
)]
#[derive(Clone, Copy, Debug)]
struct Thermostat {
    g: f64,
    u: f64,
}

/// The same without gravity: nothing diverges, which needs no search.
#[nonholonomic(
    base { x, y }
    lagrangian { (der(x)^2 + der(y)^2) / 2 }
    constraints { der(x)^2 + der(y)^2 = u^2; }
    emit { volume }
)]
#[derive(Clone, Copy, Debug)]
struct Coasting {
    u: f64,
}

/// Asserts that a system whose state has no identities keeps a density.
fn assert_density<S, const N: usize>(system: &S, density: impl Fn(&S::State) -> f64, at: [f64; N])
where
    S: Dynamics<Input = ()>,
    S::State: State<Scalar = f64> + From<[f64; N]> + Into<[f64; N]>,
{
    let flux = |point: &[f64; N]| {
        let state = S::State::from(*point);
        let rate: [f64; N] = system.derivative(0.0, &state, &()).into();
        rate.map(|rate| rate * density(&state))
    };
    assert_kept(flux, at);
}

/// The point of a sphere that stereographic coordinates name, and the density of the sphere in them.
fn sphere<const N: usize, const M: usize>(u: &[f64; M]) -> ([f64; N], f64) {
    let square: f64 = u.iter().map(|u| u * u).sum();
    let point = std::array::from_fn(|i| {
        if i < M { 2.0 * u[i] / (square + 1.0) } else { (square - 1.0) / (square + 1.0) }
    });
    (point, (2.0 / (1.0 + square)).powi(i32::try_from(M).unwrap_or(0)))
}

/// The rates of the stereographic coordinates.
fn rates<const N: usize, const M: usize>(g: &[f64; N], rate: &[f64; N]) -> [f64; M] {
    let left = 1.0 - g[M];
    std::array::from_fn(|i| rate[i] / left + g[i] * rate[M] / (left * left))
}

#[test]
fn of_systems_without_identities() {
    let mut random = Random::new(11);
    let mut draw = || random.between(0.2, 0.9);
    for _ in 0..20 {
        let robot = Robot { m: draw(), l: draw(), J: 1.0 + draw(), b: draw(), R: draw(), K: draw() };
        assert_density(
            &robot,
            |state| robot.volume_density(0.0, state),
            std::array::from_fn::<_, 7, _>(|_| draw()),
        );
        let driven = Driven { m: draw(), a: draw(), b: draw(), c: draw() };
        assert_density(
            &driven,
            |state| driven.volume_density(0.0, state),
            std::array::from_fn::<_, 4, _>(|_| draw()),
        );
        let fast = Fast { m: draw(), c: 3.0, k: draw() };
        assert_density(
            &fast,
            |state| fast.volume_density(0.0, state),
            std::array::from_fn::<_, 5, _>(|_| draw()),
        );
        let disk = Disk { m: draw(), A: draw(), C: draw(), r: draw(), g: 9.81 };
        assert_density(
            &disk,
            |state| disk.volume_density(0.0, state),
            std::array::from_fn::<_, 8, _>(|_| draw()),
        );
        let at: [f64; 4] = std::array::from_fn(|_| draw());
        let thermostat = Thermostat { g: draw(), u: at[2].hypot(at[3]) };
        assert_density(&thermostat, |state| thermostat.volume_density(0.0, state), at);
        let density = Coasting { u: thermostat.u }.volume_density(0.0, &CoastingState::from(at));
        assert_eq!(density.to_bits(), 1.0_f64.to_bits());
    }
    assert!(
        Robot::REPORT.contains("; the density is not periodic in th, p1: no function of an angle"),
        "{}",
        Robot::REPORT
    );
}

#[test]
fn on_spheres() {
    let mut random = Random::new(12);
    let mut draw = || random.between(0.2, 0.9);
    for _ in 0..20 {
        let veselova = Veselova { A: std::array::from_fn(|_| draw()), k: draw() };
        let flux = |point: &[f64; 6]| {
            let [a, b, c, w01, w02, w03] = *point;
            let (g, chart) = sphere::<4, 3>(&[a, b, c]);
            let state = VeselovaState { g, w01, w02, w03 };
            let rate = veselova.derivative(0.0, &state, &());
            let [a, b, c] = rates::<4, 3>(&g, &rate.g);
            [a, b, c, rate.w01, rate.w02, rate.w03]
                .map(|rate| rate * chart * veselova.volume_density(0.0, &state))
        };
        assert_kept(flux, std::array::from_fn(|_| draw()));
        let ball = RouthSphere { A: draw(), C: draw(), m: draw(), a: draw(), r: draw() };
        let flux = |point: &[f64; 5]| {
            let [a, b, w @ ..] = *point;
            let (g, chart) = sphere::<3, 2>(&[a, b]);
            let state = RouthSphereState { g, w };
            let rate = ball.derivative(0.0, &state, &());
            let [a, b] = rates::<3, 2>(&g, &rate.g);
            [a, b, rate.w[0], rate.w[1], rate.w[2]]
                .map(|rate| rate * chart * ball.volume_density(0.0, &state))
        };
        assert_kept(flux, std::array::from_fn(|_| draw()));
    }
}

//! Brackets, momenta, volumes and connections as a user meets them, against the equations of motion.
#![allow(non_snake_case, reason = "parameters are written as in mechanics: J, I")]

use nh_tests::random::Random;
use nonholonomic::AlmostPoisson;
use nonholonomic::prelude::*;

/// The sleigh with its centre of mass beside the point of contact: it keeps a volume.
#[nonholonomic(
    base   { theta, x, y }
    basis  { omega, v1, v2 }
    anchor {
        der(theta) = omega;
        der(x) = v1 * cos(theta) - v2 * sin(theta);
        der(y) = v1 * sin(theta) + v2 * cos(theta);
    }
    lagrangian  { (J + m * b^2) / 2 * omega^2 + m / 2 * (v1^2 + v2^2) - m * b * omega * v1 }
    constraints { v2 = 0; }
    outputs     { heading = theta; east = x; spin = omega; }
    volume;
    emit { hamiltonian, bracket, discrete_gradient, divergence, volume, connection }
)]
#[derive(Clone, Copy, Debug)]
struct SideSleigh {
    m: f64,
    J: f64,
    b: f64,
}

/// The same with the centre of mass ahead, driven.
#[nonholonomic(
    base   { theta, x, y }
    basis  { omega, v1, v2 }
    anchor {
        der(theta) = omega;
        der(x) = v1 * cos(theta) - v2 * sin(theta);
        der(y) = v1 * sin(theta) + v2 * cos(theta);
    }
    lagrangian  { J / 2 * omega^2 + m / 2 * (v1^2 + (v2 + a * omega)^2) }
    constraints { v2 = 0; }
    forces      { omega: torque - c * omega; }
    inputs      { torque }
    emit { hamiltonian, divergence }
)]
#[derive(Clone, Copy, Debug)]
struct DrivenSleigh<T> {
    m: T,
    J: T,
    a: T,
    c: T,
}

/// A heavy rigid body in Veselova's constraint: D has no global basis.
#[nonholonomic(
    base { g[3] }
    on { dot(g, g) = 1; }
    basis { w[3] }
    anchor { der(g) = cross(g, w); }
    brackets so(3) { w }
    lagrangian  { sum(i in 0..3: I[i] * w[i]^2) / 2 - dot(c, g) }
    constraints { dot(g, w) = 0; }
    outputs { e[i in 0..3] = g[i]; k[i in 0..3] = I[i] * w[i]; }
    volume { sqrt(g[0]^2 / I[0] + g[1]^2 / I[1] + g[2]^2 / I[2]); }
    emit { bracket, discrete_gradient, divergence, volume, connection }
)]
#[derive(Clone, Copy, Debug)]
struct Veselova {
    I: [f64; 3],
    c: [f64; 3],
}

/// The Chaplygin sphere reduced to the angular velocity and the vertical in the body.
#[nonholonomic(
    base { g[3] }
    on { dot(g, g) = 1; }
    basis { w[3], v[3] }
    anchor { der(g) = cross(g, w); }
    brackets se(3) { w[0], w[1], w[2], v[0], v[1], v[2] }
    lagrangian  { sum(i in 0..3: I[i] * w[i]^2) / 2 + m / 2 * dot(v, v) }
    constraints { v = r * cross(w, g); }
    volume;
    assume { m > 0; r > 0; I[0] > 0; I[1] > 0; I[2] > 0; }
    emit { hamiltonian, discrete_gradient, divergence, volume }
)]
#[derive(Clone, Copy, Debug)]
struct ChaplyginSphere {
    I: [f64; 3],
    m: f64,
    r: f64,
}

/// A disk on a horizontal plane that rolls on its rim upright: constant momenta solve the
/// Hamilton–Jacobi equation.
#[nonholonomic(
    base { x, y, theta, phi }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) + K / 2 * der(phi)^2 + J / 2 * der(theta)^2 }
    constraints { der(x) = R * cos(theta) * der(phi); der(y) = R * sin(theta) * der(phi); }
    hamilton_jacobi { der(theta): turn; der(phi): roll; }
    emit { hamiltonian }
)]
#[derive(Clone, Copy, Debug)]
struct Disk {
    m: f64,
    J: f64,
    K: f64,
    R: f64,
    turn: f64,
    roll: f64,
}

fn close(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-11 * (1.0 + expected.abs()), "{found} is not {expected}");
}

const SIDE: SideSleigh = SideSleigh { m: 1.3, J: 0.7, b: 0.4 };
const VESELOVA: Veselova = Veselova { I: [1.3, 0.8, 2.1], c: [0.2, -0.5, 0.9] };
const SPHERE: ChaplyginSphere = ChaplyginSphere { I: [1.3, 0.8, 2.1], m: 0.9, r: 0.6 };

fn veselova_state(random: &mut Random) -> VeselovaState {
    let [g, w] = [(); 2].map(|()| [(); 3].map(|()| random.between(-1.0, 1.0)));
    let mut state = VeselovaState { g, w };
    let norm = g.iter().map(|x| x * x).sum::<f64>().sqrt();
    state.g.iter_mut().for_each(|x| *x /= norm);
    VESELOVA.project(0.0, &mut state).expect("near the constraint");
    state
}

/// Checks mathematics (15) and (16).
#[test]
fn hamilton_is_derivative() {
    let sleigh = DrivenSleigh { m: 1.3_f64, J: 0.7, a: 0.4, c: 0.2 };
    let input = DrivenSleighInput { torque: 0.3 };
    let mut random = Random::new(7);
    for _ in 0..20 {
        let values: [f64; 5] = std::array::from_fn(|_| random.between(-2.0, 2.0));
        let state = DrivenSleighState::from(values);
        let phase = sleigh.legendre(0.0, &state);
        let back = sleigh.inverse_legendre(0.0, &phase);
        close(back.omega, state.omega);
        close(sleigh.hamiltonian(0.0, &phase), sleigh.energy(0.0, &state));
        let (rates, found) = (sleigh.derivative(0.0, &state, &input), sleigh.hamilton(0.0, &phase, &input));
        close(found.x, rates.x);
        // constant mass matrix: the momenta are linear in the velocities
        close(found.p_omega, (0.7 + 1.3 * 0.16) * rates.omega);
        close(found.p_v1, 1.3 * rates.v1);
        // the force is what the bracket with the energy does not give
        let drift = sleigh.drift(0.0, &phase, &input);
        close(drift.p_omega, 0.3 - 0.2 * state.omega);
        close(drift.p_v1 + drift.x + drift.y + drift.theta, 0.0);
        // {p_omega, p_v1} = −p([B_omega, B_v1]) = −m a omega
        close(sleigh.poisson(0.0, &phase)[(3, 4)], -1.3 * 0.4 * state.omega);
        // friction, and −M(v) with M = a m (b, −1) / (J + m a²) on (omega, v1)
        let mass = 0.7 + 1.3 * 0.16;
        close(sleigh.divergence(0.0, &state, &input), (-0.2 - 0.4 * 1.3 * state.v1) / mass);
    }
}

#[test]
fn the_almost_poisson_form_is_the_derivative() {
    fn check<S: AlmostPoisson<State: State<Scalar = f64>, Input = ()>>(system: &S, state: &S::State) {
        let gradient = system.energy_gradient(0.0, state);
        let found = system.almost_poisson(0.0, state, &gradient);
        let expected = system.derivative(0.0, state, &()).to_array();
        for (found, expected) in found.as_ref().iter().zip(expected.as_ref()) {
            close(*found, *expected);
        }
    }
    let mut random = Random::new(11);
    for _ in 0..20 {
        check(&VESELOVA, &veselova_state(&mut random));
        let values: [f64; 5] = std::array::from_fn(|_| random.between(-2.0, 2.0));
        check(&SIDE, &SideSleighState::from(values));
        let mut state = ChaplyginSphereState::from(std::array::from_fn(|_| random.between(-1.0, 1.0)));
        SPHERE.normalize(&mut state).expect("a direction");
        check(&SPHERE, &state);
    }
}

/// ⟨e, ·⟩ of the Veselova system: {g_i, (Iw)_j} projected to D, worked out by hand.
#[test]
fn brackets_of_outputs() {
    let mut random = Random::new(5);
    let state = veselova_state(&mut random);
    let bracket = VESELOVA.bracket(0.0, &state, &());
    let (g, inertia) = (state.g, VESELOVA.I);
    for i in 0..3 {
        for j in 0..3 {
            close(bracket[(i, j)], 0.0);
            // {g_i, k_j} = I_j {g_i, w_j} = ρ(I_j S e_j)_i, S = I⁻¹ − I⁻¹g gᵀI⁻¹ / ⟨g, I⁻¹g⟩
            let norm: f64 = (0..3).map(|k| g[k] * g[k] / inertia[k]).sum();
            let u: [f64; 3] =
                std::array::from_fn(|k| f64::from(u8::from(k == j)) - g[k] / inertia[k] * g[j] / norm);
            let cross = [g[1] * u[2] - g[2] * u[1], g[2] * u[0] - g[0] * u[2], g[0] * u[1] - g[1] * u[0]];
            close(bracket[(i, 3 + j)], cross[i]);
        }
    }
    let heading = SIDE.bracket(0.0, &SideSleighState { theta: 0.3, ..Default::default() }, &());
    // {theta, omega} = (C⁻¹)^{omega omega}
    let (m, j, b) = (1.3, 0.7, 0.4);
    close(heading[(0, 2)], m / ((j + m * b * b) * m - m * m * b * b));
}

/// div(μ Γ) = 0 along trajectories: d/dt log μ = −div Γ.
#[test]
fn densities_are_kept() {
    fn check<S: Dynamics<State: State<Scalar = f64>, Input = ()>>(
        system: &S,
        state: S::State,
        density: impl Fn(&S::State) -> f64,
        divergence: impl Fn(&S::State) -> f64,
    ) {
        // the rate of log μ by differences of fourth order along the motion
        let h = 1e-3;
        let at = |t: f64| Rk4::step(system, 0.0, t, &state, &());
        let value = |t: f64| density(&at(t)).ln();
        let rate = (8.0 * (value(h) - value(-h)) - (value(2.0 * h) - value(-2.0 * h))) / (12.0 * h);
        assert!((rate + divergence(&state)).abs() < 1e-9, "{rate} {}", divergence(&state));
    }
    let mut random = Random::new(3);
    for _ in 0..10 {
        let state = veselova_state(&mut random);
        check(&VESELOVA, state, |s| VESELOVA.volume_density(0.0, s), |s| VESELOVA.divergence(0.0, s, &()));
        let mut state = ChaplyginSphereState::from(std::array::from_fn(|_| random.between(-1.0, 1.0)));
        SPHERE.normalize(&mut state).expect("a direction");
        check(&SPHERE, state, |s| SPHERE.volume_density(0.0, s), |s| SPHERE.divergence(0.0, s, &()));
        // √(1/(m r²) − ⟨g, (I + m r²)⁻¹ g⟩) up to a constant
        let mr2 = SPHERE.m * SPHERE.r * SPHERE.r;
        let known = |g: [f64; 3]| {
            let sum: f64 = (0..3).map(|i| g[i] * g[i] / (SPHERE.I[i] + mr2)).sum();
            (1.0 / mr2 - sum).sqrt()
        };
        let reference = ChaplyginSphereState { g: [0.0, 0.0, 1.0], ..Default::default() };
        close(
            SPHERE.volume_density(0.0, &state) / SPHERE.volume_density(0.0, &reference),
            known(state.g) / known(reference.g),
        );
    }
    assert!(SideSleigh::REPORT.contains("invariant: (1)"), "{}", SideSleigh::REPORT);
}

#[test]
fn the_geodesic_form() {
    let mut random = Random::new(13);
    let free = Veselova { c: [0.0; 3], ..VESELOVA };
    for _ in 0..10 {
        let state = veselova_state(&mut random);
        let (symbols, rates) = (free.connection(0.0, &state), free.derivative(0.0, &state, &()));
        let values: [f64; 5] = std::array::from_fn(|_| random.between(-2.0, 2.0));
        let sleigh = SideSleighState::from(values);
        let (of_sleigh, sleigh_rates) = (SIDE.connection(0.0, &sleigh), SIDE.derivative(0.0, &sleigh, &()));
        for (c, rate) in rates.w.into_iter().enumerate() {
            let sum: f64 = (0..9).map(|k| symbols[k / 3][k % 3][c] * state.w[k / 3] * state.w[k % 3]).sum();
            close(rate, -sum);
        }
        let v = [sleigh.omega, sleigh.v1];
        for (c, rate) in [sleigh_rates.omega, sleigh_rates.v1].into_iter().enumerate() {
            let sum: f64 = (0..4).map(|k| of_sleigh[k / 2][k % 2][c] * v[k / 2] * v[k % 2]).sum();
            close(rate, -sum);
        }
        // without torsion: Γ_ab − Γ_ba = C_ab
        let free_symbols = free.christoffel(0.0, &state);
        close(free_symbols[0][1][2] - free_symbols[1][0][2], 1.0);
        close(free_symbols[1][2][0] - free_symbols[2][1][0], 1.0);
    }
}

#[test]
fn integral_curves_of_a_solution_are_motions() {
    let disk = Disk { m: 1.1, J: 0.3, K: 0.5, R: 0.7, turn: 0.4, roll: -0.9 };
    let start = DiskState { theta: 0.2, ..Default::default() };
    let lifted = disk.hamilton_jacobi(0.0, &start);
    let momenta = disk.legendre(0.0, &lifted);
    close(momenta.p_theta_dot, 0.4);
    close(momenta.p_phi_dot, -0.9);
    let mut sim = Integrator::new(disk, Dopri5::new().rtol(1e-11).atol(1e-12), 0.0, lifted);
    sim.advance_to(10.0).expect("a smooth motion");
    let end = *sim.state();
    let again = disk.hamilton_jacobi(10.0, &end);
    close(again.theta_dot, end.theta_dot);
    close(again.phi_dot, end.phi_dot);
}

//! Almost Lie algebroids, whose brackets break the Jacobi identity or whose anchor is no homomorphism: the
//! equations are (6)–(8) of what is declared, evaluated here by differences from the anchor, the brackets,
//! the Lagrangian and the constraints.

use nh_tests::linear::solved;
use nh_tests::random::Random;
use nonholonomic::prelude::*;

/// A knife edge on the plane, by D alone with the bracket projected along the kinetic metric (M 1.1): the
/// blade is a behind the centre of mass.
#[nonholonomic(
    base { x, y, theta }
    basis { omega, v }
    anchor { der(x) = v * cos(theta); der(y) = v * sin(theta); der(theta) = omega; }
    brackets { [omega, v] = m * a / (J + m * a^2) * omega; }
    almost;
    lagrangian { (J + m * a^2) / 2 * omega^2 + m / 2 * v^2 - k / 2 * (x^2 + y^2) }
    outputs { heading = theta; speed = v; }
    emit { hamiltonian, bracket, discrete_gradient, connection, divergence, gibbs_appell, jacobian }
)]
#[derive(Clone, Copy, Debug)]
struct Projected {
    m: f64,
    J: f64,
    a: f64,
    k: f64,
}

/// The same with the constraint, on the tangent bundle.
#[nonholonomic(
    base { x, y, theta }
    velocities {
        omega = der(theta);
        v = cos(theta) * der(x) + sin(theta) * der(y);
        u = cos(theta) * der(y) - sin(theta) * der(x);
    }
    lagrangian { (J + m * a^2) / 2 * omega^2 + m / 2 * (v^2 + u^2) + m * a * omega * u - k / 2 * (x^2 + y^2) }
    constraints { u = 0; }
)]
#[derive(Clone, Copy, Debug)]
struct KnifeEdge {
    m: f64,
    J: f64,
    a: f64,
    k: f64,
}

#[test]
fn a_distribution_with_the_projected_bracket_moves_like_the_constrained_system() {
    let (m, a, k) = (1.3, 0.4, 0.9);
    let (projected, constrained) = (Projected { m, J, a, k }, KnifeEdge { m, J, a, k });
    let mut random = Random::new(11);
    for _ in 0..20 {
        let [x, y, theta, omega, v] = std::array::from_fn(|_| random.between(-2.0, 2.0));
        let state = ProjectedState { x, y, theta, omega, v };
        let expected = constrained.derivative(0.0, &KnifeEdgeState { x, y, theta, omega, v }, &());
        let expected = <[f64; 5]>::from(expected);
        close(&<[f64; 5]>::from(projected.derivative(0.0, &state, &())), &expected, 1e-13);
        close(&<[f64; 5]>::from(projected.gibbs_appell(0.0, &state, &())), &expected, 1e-13);
        // ḟ = {f, E}: the observables are components of the state
        let rates = projected.bracket_with_energy(0.0, &state, &());
        close(&[rates.heading, rates.speed], &[expected[2], expected[4]], 1e-13);
        // Hamilton's equations, by the momenta along the motion
        let phase = projected.legendre(0.0, &state);
        let rates = projected.hamilton(0.0, &phase, &());
        close(&[rates.p_omega, rates.p_v], &[(J + m * a * a) * expected[3], m * expected[4]], 1e-13);
    }
    // no sum of squares of velocities is lost
    let start = ProjectedState { x: 0.3, y: -0.2, theta: 0.4, omega: 0.8, v: 0.5 };
    let mut run = Integrator::new(projected, DiscreteGradient::new(0.05), 0.0, start);
    run.advance_to(20.0).unwrap();
    let lost = projected.energy(20.0, run.state()) - projected.energy(0.0, &start);
    assert!(lost.abs() < 1e-12, "{lost:e}");
    let report = Projected::REPORT;
    for part in [
        "algebroid: an almost Lie algebroid, rank 2",
        "declared almost: (2) does not hold: the anchor is not a homomorphism of brackets on the pair [omega, v]",
        "declared almost: the Jacobi identity, (3), holds for the sections of the basis, not for all",
    ] {
        assert!(report.contains(part), "{part}\n{report}");
    }
}

fn close(found: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(found.len(), expected.len());
    for (f, e) in found.iter().zip(expected) {
        assert!((f - e).abs() <= tolerance * (1.0 + e.abs()), "{found:?}\n{expected:?}");
    }
}

/// What is declared, as functions of (t, x) and (t, x, y).
struct Declared<const N: usize, const S: usize, const K: usize> {
    anchor: fn([f64; N]) -> [[f64; S]; N],
    /// [e_α, e_β] for α < β.
    bracket: fn([f64; N], usize, usize) -> [f64; S],
    lagrangian: fn(f64, [f64; N], [f64; S]) -> f64,
    force: fn([f64; S]) -> [f64; S],
    /// Rows Φ, b.
    constraints: fn(f64, [f64; N]) -> [Row<S>; K],
}

/// A row of Φ, and its b.
type Row<const S: usize> = ([f64; S], f64);

/// The derivative of a function of one number, by differences of sixth order.
fn slope(f: impl Fn(f64) -> f64) -> f64 {
    let h = 1e-2;
    let pair = |k: f64| f(k * h) - f(-k * h);
    (45.0 * pair(1.0) - 9.0 * pair(2.0) + pair(3.0)) / (60.0 * h)
}

impl<const N: usize, const S: usize, const K: usize> Declared<N, S, K> {
    fn momentum(&self, t: f64, x: [f64; N], y: [f64; S], alpha: usize) -> f64 {
        slope(|e| {
            let mut y = y;
            y[alpha] += e;
            (self.lagrangian)(t, x, y)
        })
    }

    /// ẏ from (7): W ẏ + h = Υ + λ Φ, with the constraints differentiated along the motion.
    fn acceleration(&self, t: f64, x: [f64; N], y: [f64; S]) -> Vec<f64> {
        let rho = (self.anchor)(x);
        let field = |section: [f64; S]| -> [f64; N] {
            std::array::from_fn(|i| (0..S).map(|alpha| rho[i][alpha] * section[alpha]).sum())
        };
        let moved = |v: [f64; N], e: f64| -> [f64; N] { std::array::from_fn(|i| x[i] + e * v[i]) };
        let rates = field(y);
        let p: [f64; S] = std::array::from_fn(|alpha| self.momentum(t, x, y, alpha));
        let bracket = |alpha: usize, beta: usize| -> [f64; S] {
            match alpha.cmp(&beta) {
                std::cmp::Ordering::Less => (self.bracket)(x, alpha, beta),
                std::cmp::Ordering::Equal => [0.0; S],
                std::cmp::Ordering::Greater => (self.bracket)(x, beta, alpha).map(|c| -c),
            }
        };
        let force = (self.force)(y);
        let size = S + K;
        let mut matrix = vec![vec![0.0; size]; size];
        let mut right = vec![0.0; size];
        for alpha in 0..S {
            for beta in 0..S {
                matrix[alpha][beta] = slope(|e| {
                    let mut y = y;
                    y[beta] += e;
                    self.momentum(t, x, y, alpha)
                });
            }
            // h of (6)
            let carried = slope(|e| self.momentum(t + e, moved(rates, e), y, alpha));
            let turned: f64 = (0..S)
                .map(|beta| y[beta] * bracket(alpha, beta).iter().zip(&p).map(|(c, p)| c * p).sum::<f64>())
                .sum();
            let mut unit = [0.0; S];
            unit[alpha] = 1.0;
            let pulled = slope(|e| (self.lagrangian)(t, moved(field(unit), e), y));
            right[alpha] = force[alpha] - carried - turned + pulled;
        }
        for (a, (row, _)) in (self.constraints)(t, x).iter().enumerate() {
            for alpha in 0..S {
                matrix[S + a][alpha] = row[alpha];
                matrix[alpha][S + a] = -row[alpha];
            }
            let value = |t: f64, x: [f64; N]| {
                let (row, b) = (self.constraints)(t, x)[a];
                row.iter().zip(&y).map(|(phi, y)| phi * y).sum::<f64>() + b
            };
            right[S + a] = -slope(|e| value(t + e, moved(rates, e)));
        }
        solved(matrix, right)[..S].to_vec()
    }
}

/// A system of points and a rotor on a bundle that breaks both laws; the velocities of the points are no
/// rates of functions.
macro_rules! lawless {
    ($(#[$doc:meta])* $name:ident { $($more:tt)* }) => {
        $(#[$doc])*
        #[nonholonomic(
            base { x, y, q }
            basis { u, v, w, s }
            anchor {
                der(x) = u * cos(q) - v * sin(q) + x * w;
                der(y) = u * sin(q) + v * cos(q) + s * x^2;
                der(q) = w + y * u / 3;
            }
            brackets {
                [u, v] = x * w + s;
                [u, w] = c * v - y * u;
                [v, w] = sin(q) * u + y * s;
                [w, s] = x * u + v;
                [u, s] = w / 2;
            }
            almost;
            lagrangian {
                let north = der(y) + l * cos(q) * w;
                let east = der(x) - l * sin(q) * w;
                m / 2 * (east^2 + north^2) + J / 2 * w^2 + (1 + x^2) / 2 * s^2 + m / 2 * (u^2 + v^2) + l * u * s * y
                    - c * cos(q) * x
            }
            forces { u: -c * v; s: w * u; }
            $($more)*
        )]
        #[derive(Clone, Copy, Debug)]
        struct $name {
            m: f64,
            J: f64,
            l: f64,
            c: f64,
        }
    };
}

lawless! { /// Free.
Free { emit { gibbs_appell } } }
lawless! { /// With a constraint that can be solved for a velocity, a drift and the time.
Solved { constraints { s = x * u + c * sin(t); } emit { gibbs_appell } } }
lawless! { /// With a wheel.
Wheel { constraints { cos(q) * v = sin(q) * u; } } }
lawless! { /// With all velocities kept.
Kept { constraints { s = x * u + c * sin(t); cos(q) * v = sin(q) * u; } formulation { projected } } }

const M: f64 = 1.3;
const J: f64 = 0.6;
const L: f64 = 0.45;
const C: f64 = 0.8;

fn anchor([x, y, q]: [f64; 3]) -> [[f64; 4]; 3] {
    let (sin, cos) = q.sin_cos();
    [[cos, -sin, x, 0.0], [sin, cos, 0.0, x * x], [y / 3.0, 0.0, 1.0, 0.0]]
}

fn bracket([x, y, q]: [f64; 3], alpha: usize, beta: usize) -> [f64; 4] {
    match (alpha, beta) {
        (0, 1) => [0.0, 0.0, x, 1.0],
        (0, 2) => [-y, C, 0.0, 0.0],
        (1, 2) => [q.sin(), 0.0, 0.0, y],
        (2, 3) => [x, 1.0, 0.0, 0.0],
        (0, 3) => [0.0, 0.0, 0.5, 0.0],
        _ => [0.0; 4],
    }
}

fn lagrangian(_: f64, at: [f64; 3], velocity: [f64; 4]) -> f64 {
    let ([x, y, q], [u, v, w, s]) = (at, velocity);
    let [x_dot, y_dot, _]: [f64; 3] =
        std::array::from_fn(|i| anchor(at)[i].iter().zip(velocity).map(|(a, y)| a * y).sum());
    let (north, east) = (y_dot + L * q.cos() * w, x_dot - L * q.sin() * w);
    M / 2.0 * (east * east + north * north)
        + J / 2.0 * w * w
        + s * s * (1.0 + x * x) / 2.0
        + M / 2.0 * (u * u + v * v)
        + L * u * s * y
        - C * q.cos() * x
}

fn force([u, v, w, _]: [f64; 4]) -> [f64; 4] {
    [-C * v, 0.0, 0.0, w * u]
}

fn slider(t: f64, [x, ..]: [f64; 3]) -> ([f64; 4], f64) {
    ([-x, 0.0, 0.0, 1.0], -C * t.sin())
}

fn wheel([.., q]: [f64; 3]) -> ([f64; 4], f64) {
    ([-q.sin(), q.cos(), 0.0, 0.0], 0.0)
}

/// Compares accelerations at states that satisfy the constraints.
macro_rules! compare {
    ($name:ident, $state:ident, $constraints:expr) => {{
        let declared = Declared { anchor, bracket, lagrangian, force, constraints: $constraints };
        let system = $name { m: M, J, l: L, c: C };
        let mut random = Random::new(5);
        for _ in 0..10 {
            let t = random.between(-1.0, 1.0);
            let n = $state::default().to_array().len();
            let mut state = $state::default();
            let mut array = state.to_array();
            array.copy_from_slice(&random.list(n, -1.0, 1.0));
            state = State::from_array(array);
            random_to_constraints!($name, system, t, state);
            let velocity = <[f64; 4]>::from(system.velocity(t, &state));
            let at = [state.x, state.y, state.q];
            let expected = declared.acceleration(t, at, velocity);
            // the derivative of the velocity along the motion, by differences of the emitted functions
            let rate = system.derivative(t, &state, &()).to_array();
            let found: Vec<f64> = (0..4)
                .map(|k| {
                    slope(|e| {
                        let mut array = state.to_array();
                        array.iter_mut().zip(&rate).for_each(|(x, rate)| *x += e * rate);
                        <[f64; 4]>::from(system.velocity(t + e, &State::from_array(array)))[k]
                    })
                })
                .collect();
            close(&found, &expected, 1e-8);
            let rates = anchor(at).map(|row| row.iter().zip(velocity).map(|(a, y)| a * y).sum::<f64>());
            close(&rate[..3], &rates, 1e-12);
        }
        system
    }};
}

/// The projected formulation has states off the constraints.
macro_rules! random_to_constraints {
    (Kept, $system:ident, $t:ident, $state:ident) => {
        $system.project($t, &mut $state).unwrap();
    };
    (Wheel, $system:ident, $t:ident, $state:ident) => {
        $system.project($t, &mut $state).unwrap();
    };
    ($name:ident, $system:ident, $t:ident, $state:ident) => {};
}

/// Checks mathematics (6), (7) and (8).
#[test]
fn equations_are_those_of_the_declared_data() {
    let free = compare!(Free, FreeState, |_, _| []);
    compare!(Solved, SolvedState, |t, x| [slider(t, x)]);
    compare!(Wheel, WheelState, |_, x| [wheel(x)]);
    compare!(Kept, KeptState, |t, x| [slider(t, x), wheel(x)]);
    let state = FreeState { x: 0.3, y: -0.4, q: 0.7, u: 0.5, v: -0.2, w: 0.9, s: 0.1 };
    let (found, expected) = (free.gibbs_appell(0.0, &state, &()), free.derivative(0.0, &state, &()));
    close(&<[f64; 7]>::from(found), &<[f64; 7]>::from(expected), 1e-12);
    let report = Free::REPORT;
    for part in ["an almost Lie algebroid, rank 4", "(2) does not hold", "(3) does not hold"] {
        assert!(report.contains(part), "{part}\n{report}");
    }
    assert!(!Solved::REPORT.contains("holonomic"), "{}", Solved::REPORT);
}

/// Brackets that are in order all the same.
#[nonholonomic(
    basis { a, b, c }
    brackets so(3) { a, b, c }
    almost;
    lagrangian { I / 2 * a^2 + b^2 + c^2 / 3 }
)]
#[derive(Clone, Copy, Debug)]
struct InOrder {
    I: f64,
}

/// Brackets without the Jacobi identity, and nothing else to break.
#[nonholonomic(
    basis { a, b, c }
    brackets { [a, b] = c; [b, c] = a + b; [c, a] = b + c; }
    almost;
    lagrangian { I / 2 * a^2 + b^2 + c^2 / 3 }
    conserved { twice = I * a^2 + 2 * b^2 + 2 * c^2 / 3; }
)]
#[derive(Clone, Copy, Debug)]
struct WithoutJacobi {
    I: f64,
}

/// Checks mathematics (2) and (3).
#[test]
fn the_report_says_which_laws_hold() {
    let report = InOrder::REPORT;
    assert!(
        report.contains("it is a Lie algebroid all the same") && report.contains("a Lie algebra, rank 3"),
        "{report}"
    );
    let report = WithoutJacobi::REPORT;
    assert!(report.contains("declared almost: (3) does not hold: the brackets of a, b"), "{report}");
    assert!(report.contains("an almost Lie algebra, rank 3"), "{report}");
    let rate = WithoutJacobi { I: 0.8 }.derivative(0.0, &WithoutJacobiState { a: 0.3, b: 0.5, c: -0.7 }, &());
    // ẏ_α p-rates: ṗ_α = −C^γ_{αβ} y^β p_γ with p = (0.24, 1, −1.4/3)
    let (p, y) = ([0.24, 1.0, -1.4 / 3.0], [0.3, 0.5, -0.7]);
    let ab = p[2];
    let bc = p[0] + p[1];
    let ca = p[1] + p[2];
    let expected = [
        -(y[1] * ab - y[2] * ca) / 0.8,
        -(-y[0] * ab + y[2] * bc) / 2.0,
        -(y[0] * ca - y[1] * bc) / (2.0 / 3.0),
    ];
    close(&[rate.a, rate.b, rate.c], &expected, 1e-14);
}

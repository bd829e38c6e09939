//! The derivative of a step, from the emitted Jacobian, against jets through the step and against
//! difference quotients.

use nalgebra::SMatrix;
use nonholonomic::methods::{Fixed, Tableau, Transition};
use nonholonomic::prelude::*;
use nonholonomic::{D, Jet, methods};

/// A sleigh whose brake and engine make everything depend on everything, time included.
#[nonholonomic(
    base   { theta, x, y }
    basis  { omega, v1, v2 }
    anchor {
        der(theta) = omega;
        der(x) = v1 * cos(theta) - v2 * sin(theta);
        der(y) = v1 * sin(theta) + v2 * cos(theta);
    }
    lagrangian  { J / 2 * omega^2 + m / 2 * (v1^2 + (v2 + a * omega)^2) - m * exp(-x^2) * sin(y + t) }
    constraints { v2 = 0; }
    forces      { omega: torque * cos(theta) - omega^3; v1: push - atan(v1) * sqrt(1 + y^2) + torque * push; }
    inputs      { torque, push }
    emit        { jacobian }
)]
#[derive(Clone, Copy, Debug)]
struct Sleigh<T> {
    m: T,
    J: T,
    a: T,
}

const SLEIGH: Sleigh<f64> = Sleigh { m: 1.3, J: 0.4, a: 0.35 };
const START: [f64; 5] = [0.4, -0.3, 0.8, 1.1, -0.9];
const INPUT: [f64; 2] = [0.7, -0.2];
const TIME: f64 = 0.6;
const STEP: f64 = 0.05;

type Number = Jet<f64, 7>;

/// The step in jets: the sleigh over jets, its emitted Jacobian unused.
fn by_jets<P: Tableau>() -> [Number; 5] {
    let all = Number::variables([START.as_slice(), INPUT.as_slice()].concat().try_into().unwrap());
    let [theta, x, y, omega, v1, torque, push] = all;
    let sleigh =
        Sleigh { m: Jet::constant(SLEIGH.m), J: Jet::constant(SLEIGH.J), a: Jet::constant(SLEIGH.a) };
    let start = SleighState { theta, x, y, omega, v1 };
    let input = SleighInput { torque, push };
    let end = Fixed::<P, Number>::step(&sleigh, Jet::constant(TIME), Jet::constant(STEP), &start, &input);
    end.to_array()
}

fn agrees<P: Tableau>(name: &str) {
    let (start, input) = (SleighState::from(START), SleighInput::from(INPUT));
    let step: Transition<_, f64, 5, 2> =
        Fixed::<P, f64>::linearized_step(&SLEIGH, TIME, STEP, &start, &input);
    // the derivative comes from one program with its Jacobians, which rounds in an order of its own
    let expected = Fixed::<P, f64>::step(&SLEIGH, TIME, STEP, &start, &input).to_array();
    for (ours, expected) in step.state.to_array().iter().zip(expected) {
        assert!((ours - expected).abs() <= 4.0 * f64::EPSILON, "{name}: {ours} {expected}");
    }
    for (i, jet) in by_jets::<P>().into_iter().enumerate() {
        for (j, expected) in jet.by.into_iter().enumerate() {
            let ours = if j < 5 { step.by_state[(i, j)] } else { step.by_input[(i, j - 5)] };
            // entries are of order one, sums of a few dozen terms
            assert!((ours - expected).abs() < 2e-15, "{name}, ({i}, {j}): {ours} {expected}");
        }
    }
}

#[test]
fn explicit_steps_are_differentiated_exactly() {
    agrees::<methods::Euler1>("Euler");
    agrees::<methods::Heun2>("Heun");
    agrees::<methods::Kutta4>("Rk4");
    agrees::<methods::DormandPrince5>("Dopri5");
    agrees::<methods::Verner9>("Vern9");
}

type Differentiated = Transition<SleighState<f64>, f64, 5, 2>;

/// A step with its derivatives agrees with quotients of such steps.
fn agrees_with_quotients(
    name: &str,
    step: impl Fn(&SleighState<f64>, &SleighInput<f64>) -> Result<Differentiated, IntegrationError>,
) {
    let end = |x: [f64; 5], u: [f64; 2]| {
        step(&SleighState::from(x), &SleighInput::from(u)).unwrap().state.to_array()
    };
    let ours = step(&SleighState::from(START), &SleighInput::from(INPUT)).unwrap();
    let delta = 1e-4;
    for j in 0..7 {
        let at = |shift: f64| {
            let (mut x, mut u) = (START, INPUT);
            if j < 5 {
                x[j] += shift;
            } else {
                u[j - 5] += shift;
            }
            end(x, u)
        };
        // the quotient of order four: its error is some 1e-12
        let ([a, b], [c, d]) = ([at(2.0 * delta), at(delta)], [at(-delta), at(-2.0 * delta)]);
        for i in 0..5 {
            let quotient = (8.0 * (b[i] - c[i]) - (a[i] - d[i])) / (12.0 * delta);
            let ours = if j < 5 { ours.by_state[(i, j)] } else { ours.by_input[(i, j - 5)] };
            assert!((ours - quotient).abs() < 2e-11, "{name}, ({i}, {j}): {ours} {quotient}");
        }
    }
}

#[test]
fn steps_of_no_length_and_of_one_that_is_no_number() {
    let (x, u) = (SleighState::from(START), SleighInput::from(INPUT));
    let is_tiny = |x: f64| x.abs() < 1e-300;
    macro_rules! check {
        ($($method:ident)*) => {$(
            let of = |dt: f64, x: &SleighState<f64>| $method::linearized_step(&SLEIGH, TIME, dt, x, &u);
            for dt in [0.0, -0.0, 5e-324, -5e-324, 1e-310, f64::MIN_POSITIVE] {
                let step: Differentiated = of(dt, &x).unwrap();
                let ends = step.state.to_array().into_iter().zip(START);
                assert!(ends.into_iter().all(|(end, start)| is_tiny(end - start)), "{dt:e}: {:?}", step.state);
                assert!((step.by_state - nalgebra::SMatrix::identity()).iter().all(|x| is_tiny(*x)), "{dt:e}");
                assert!(step.by_input.iter().all(|x| is_tiny(*x)), "{dt:e}");
                let spoiled = SleighState { theta: f64::NAN, ..x };
                let refused: Result<Differentiated, _> = of(dt, &spoiled);
                assert!(matches!(refused, Err(IntegrationError::NonFiniteDerivative { .. })), "{refused:?}");
            }
            for dt in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                let refused: Result<Differentiated, _> = of(dt, &x);
                assert!(matches!(refused, Err(IntegrationError::Setting { setting: "dt", .. })), "{refused:?}");
            }
        )*};
    }
    check! { ImplicitMidpoint GaussLegendre4 GaussLegendre6 Radau5 }
}

#[test]
fn implicit_steps_are_differentiated_by_their_equations() {
    macro_rules! check {
        ($($method:ident)*) => {$(
            agrees_with_quotients(stringify!($method), |x, u| $method::linearized_step(&SLEIGH, TIME, STEP, x, u));
            agrees_with_quotients("back", |x, u| $method::linearized_step(&SLEIGH, TIME, -STEP, x, u));
        )*};
    }
    check! { ImplicitMidpoint GaussLegendre4 GaussLegendre6 Radau5 }
    // the steps are those of the methods
    let (start, input) = (SleighState::from(START), SleighInput::from(INPUT));
    let ours = ImplicitMidpoint::linearized_step(&SLEIGH, TIME, STEP, &start, &input).unwrap();
    let step = ImplicitMidpoint::step_with_jacobian(&SLEIGH, TIME, STEP, &start, &input).unwrap();
    assert_eq!(ours.state, step);
    let ours = GaussLegendre6::linearized_step(&SLEIGH, TIME, STEP, &start, &input).unwrap().state;
    let mut sim = Integrator::new(SLEIGH, GaussLegendre6::new(STEP).with_jacobian(), TIME, start);
    sim.set_input(input);
    sim.step().unwrap();
    assert_eq!(ours, *sim.state());
    let ours = Radau5::linearized_step(&SLEIGH, TIME, STEP, &start, &input).unwrap().state;
    let loose = Radau5::new().rtol(1e-14).atol(1.0).first_step(STEP).with_jacobian();
    let mut sim = Integrator::new(SLEIGH, loose, TIME, start);
    sim.set_input(input);
    sim.step().unwrap();
    let pairs = ours.to_array().into_iter().zip(sim.state().to_array());
    assert!(pairs.fold(0.0, |most: f64, (a, b)| most.max((a - b).abs())) < 1e-5, "{:?}", sim.state());
}

#[test]
fn linear_systems_give_the_rational_approximations_of_the_exponential() {
    /// x' = −λ x + u.
    #[nonholonomic(
        base { q }
        lagrangian { der(q)^2 / 2 }
        forces { q: u - lambda * der(q); }
        inputs { u }
        emit { jacobian }
    )]
    #[derive(Clone, Copy, Debug)]
    struct Decay {
        lambda: f64,
    }
    let (z, start) = (0.3, DecayState { q: 0.0, q_dot: 1.0 });
    let decay = Decay { lambda: z };
    let explicit = Rk4::linearized_step(&decay, 0.0, 1.0, &start, &DecayInput::default());
    let series = 1.0 - z + z * z / 2.0 - z * z * z / 6.0 + z * z * z * z / 24.0;
    assert!((explicit.by_state[(1, 1)] - series).abs() < 1e-15);
    let implicit =
        ImplicitMidpoint::linearized_step(&decay, 0.0, 1.0, &start, &DecayInput::default()).unwrap();
    assert!((implicit.by_state[(1, 1)] - (1.0 - z / 2.0) / (1.0 + z / 2.0)).abs() < 1e-15);
    assert!((implicit.by_input[(1, 0)] - 1.0 / (1.0 + z / 2.0)).abs() < 1e-15);
    for z in [0.3, 1e3, 1e9] {
        let decay = Decay { lambda: z };
        let damping = |by_state: f64, expected: f64| {
            assert!((by_state - expected).abs() < 1e-14, "{z}: {by_state} {expected}");
        };
        let (u, quadratic) = (DecayInput::default(), z * z / 12.0);
        let gauss = GaussLegendre4::linearized_step(&decay, 0.0, 1.0, &start, &u).unwrap();
        damping(gauss.by_state[(1, 1)], (1.0 - z / 2.0 + quadratic) / (1.0 + z / 2.0 + quadratic));
        let (even, odd) = (1.0 + z * z / 10.0, z / 2.0 + z * z * z / 120.0);
        let gauss = GaussLegendre6::linearized_step(&decay, 0.0, 1.0, &start, &u).unwrap();
        damping(gauss.by_state[(1, 1)], (even - odd) / (even + odd));
        let radau = Radau5::linearized_step(&decay, 0.0, 1.0, &start, &u).unwrap();
        let below = 1.0 + 0.6 * z + 0.15 * z * z + z * z * z / 60.0;
        damping(radau.by_state[(1, 1)], (1.0 - 0.4 * z + z * z / 20.0) / below);
    }
}

#[test]
fn jets_know_the_derivatives_of_all_functions() {
    type Single = Jet<f64, 1>;
    type Function = (&'static str, fn(Single) -> Single, fn(f64) -> f64);
    macro_rules! both {
        ($($text:literal $function:expr;)*) => { [$(($text, $function as fn(Single) -> Single, $function as fn(f64) -> f64)),*] };
    }
    let functions: &[Function] = &both! {
        "sqrt" Scalar::sqrt;
        "cbrt" Scalar::cbrt;
        "sin" Scalar::sin;
        "cos" Scalar::cos;
        "tan" Scalar::tan;
        "asin" Scalar::asin;
        "acos" Scalar::acos;
        "atan" Scalar::atan;
        "sinh" Scalar::sinh;
        "cosh" Scalar::cosh;
        "tanh" Scalar::tanh;
        "exp" Scalar::exp;
        "ln" Scalar::ln;
        "recip" Scalar::recip;
        "abs" Scalar::abs;
        "sign" Scalar::sign;
        "powi" |x| Scalar::powi(x, -3);
        "powf" |x| Scalar::powf(x, Scalar::from_f64(2.3));
        "powf of the exponent" |x| Scalar::powf(Scalar::from_f64(2.3), x);
        "atan2" |x| Scalar::atan2(x, x * x);
        "sin_cos" |x| { let (s, c) = Scalar::sin_cos(x); s / c - s * c };
        "mul_add" |x| Scalar::mul_add(x, x, -x);
        "min" |x| Scalar::min(x, Scalar::from_f64(0.6));
        "max" |x| Scalar::max(x, Scalar::from_f64(0.6));
    };
    for (name, of_jet, of_number) in functions {
        for x in [0.2, 0.45, 0.83] {
            let [jet] = Single::variables([x]);
            let ours = of_jet(jet);
            assert!((ours.value - of_number(x)).abs() < 1e-15 * (1.0 + ours.value.abs()), "{name}");
            let h = 1e-3;
            let at = |k: f64| of_number(x + k * h);
            let quotient =
                (45.0 * (at(1.0) - at(-1.0)) - 9.0 * (at(2.0) - at(-2.0)) + at(3.0) - at(-3.0)) / (60.0 * h);
            assert!(
                (ours.by[0] - quotient).abs() < 1e-9 * (1.0 + quotient.abs()),
                "{name} at {x}: {} {quotient}",
                ours.by[0]
            );
        }
    }
}

/// x' = a x² + u and one that turns it: wherever its equations are solved, the derivatives of a step are those of
/// difference quotients, also where the matrices at its start are far from those at its stages.
#[test]
fn steps_that_are_solved_have_derivatives() {
    #[nonholonomic(
        base { q }
        lagrangian { der(q)^2 / 2 }
        forces { q: u - k * q^3 - c * der(q)^3; }
        inputs { u }
        emit { jacobian }
    )]
    #[derive(Clone, Copy, Debug)]
    struct Stiff {
        k: f64,
        c: f64,
    }
    let stiff = Stiff { k: 900.0, c: 40.0 };
    let mut solved = 0;
    macro_rules! compare {
        ($($method:ident)*) => { $(
            for step in 1..40_u32 {
                let h = 0.02 * f64::from(step);
                for [q, q_dot] in [[0.0, 3.0], [1.0, 0.0], [-0.2, 5.0], [0.01, -0.1]] {
                    let start = StiffState { q, q_dot };
                    let at = |q: f64, q_dot: f64, u: f64| {
                        $method::linearized_step(&stiff, 0.0, h, &StiffState { q, q_dot }, &StiffInput { u })
                    };
                    let Ok(here) = at(start.q, start.q_dot, 0.3) else { continue };
                    let d = 1e-5;
                    for (column, [dq, dv, du]) in [[d, 0.0, 0.0], [0.0, d, 0.0], [0.0, 0.0, d]].into_iter().enumerate() {
                        let (Ok(ahead), Ok(behind)) =
                            (at(q + dq, q_dot + dv, 0.3 + du), at(q - dq, q_dot - dv, 0.3 - du))
                        else { continue };
                        let (ahead, behind) = (ahead.state.to_array(), behind.state.to_array());
                        // on the same branch of the solutions
                        if ahead.iter().zip(&behind).any(|(a, b)| (a - b).abs() > 1e-3) { continue }
                        solved += 1;
                        for row in 0..2 {
                            let quotient = (ahead[row] - behind[row]) / (2.0 * d);
                            let found =
                                if column < 2 { here.by_state[(row, column)] } else { here.by_input[(row, 0)] };
                            let off = (quotient - found).abs();
                            let name = stringify!($method);
                            assert!(off < 1e-4 * (1.0 + found.abs()), "{name} {h} {q} {q_dot}: {found} {quotient}");
                        }
                    }
                }
            }
        )* };
    }
    compare!(ImplicitMidpoint GaussLegendre4 GaussLegendre6 Radau5);
    assert!(solved > 700, "{solved}");
}

/// A spring that gets stiff within the step, at rest: the equations of the step are solved at once, and their derivatives
/// are far from those at its start.
#[test]
fn derivatives_need_no_iteration_that_settles() {
    #[nonholonomic(
        base { q }
        lagrangian { der(q)^2 / 2 }
        forces { q: u - k * t * q; }
        inputs { u }
        emit { jacobian }
    )]
    #[derive(Clone, Copy, Debug)]
    struct Spring {
        k: f64,
    }
    // the first column with 60 digits
    let rest = SpringState::default();
    let stiff =
        GaussLegendre4::linearized_step(&Spring { k: 1e12 }, 0.0, -1.0, &rest, &SpringInput::default())
            .unwrap();
    assert!((stiff.by_state[(0, 0)] - 1.000_000_000_144).abs() < 1e-14, "{stiff:?}");
    assert!((stiff.by_state[(1, 0)] + 12.000_000_000_864).abs() < 1e-13, "{stiff:?}");
    let root = 3.0_f64.sqrt() / 6.0;
    let (nodes, weights) = ([0.5 - root, 0.5 + root], [[0.25, 0.25 - root], [0.25 + root, 0.25]]);
    for (k, h) in [(1.0, 0.1), (1e3, 1.0), (-1e3, 1.0), (1e6, 2.0)] {
        let at = |time: f64| SMatrix::<f64, 2, 2>::new(0.0, 1.0, -k * time, 0.0);
        let (mut left, mut right) = (SMatrix::<f64, 4, 4>::identity(), SMatrix::<f64, 4, 3>::zeros());
        for (i, row) in weights.iter().enumerate() {
            for (j, weight) in row.iter().enumerate() {
                let block = at(nodes[j] * h) * (h * weight);
                for (a, b) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                    left[(2 * i + a, 2 * j + b)] -= block[(a, b)];
                    right[(2 * i + a, b)] += block[(a, b)];
                }
                right[(2 * i + 1, 2)] += h * weight;
            }
        }
        let stages = left.lu().solve(&right).unwrap();
        let mut ends = SMatrix::<f64, 2, 3>::new(1.0, 0.0, 0.0, 0.0, 1.0, h);
        for (j, node) in nodes.iter().enumerate() {
            for column in 0..3 {
                let point = |row: usize| stages[(2 * j + row, column)] + f64::from(u8::from(row == column));
                ends[(0, column)] += h / 2.0 * point(1);
                ends[(1, column)] -= h / 2.0 * k * node * h * point(0);
            }
        }
        let step =
            GaussLegendre4::linearized_step(&Spring { k }, 0.0, h, &rest, &SpringInput::default()).unwrap();
        for row in 0..2 {
            for (column, found) in [step.by_state[(row, 0)], step.by_state[(row, 1)], step.by_input[(row, 0)]]
                .into_iter()
                .enumerate()
            {
                let (expected, size) = (ends[(row, column)], ends.row(row).amax());
                assert!(
                    (found - expected).abs() <= 1e-9 * size,
                    "{k} {h} {row} {column}: {found} {expected}"
                );
            }
        }
        let radau = Radau5::linearized_step(&Spring { k }, 0.0, h, &rest, &SpringInput::default()).unwrap();
        let gauss =
            GaussLegendre6::linearized_step(&Spring { k }, 0.0, h, &rest, &SpringInput::default()).unwrap();
        assert!(radau.by_state.iter().chain(gauss.by_state.iter()).all(|entry| entry.is_finite()));
    }
}

/// x' = 0, whose Jacobian is none after the start.
#[test]
fn a_step_without_derivatives_is_an_error() {
    #[derive(Clone, Copy)]
    struct Place(f64);
    impl State for Place {
        type Scalar = f64;
        type Dim = D<1>;
        fn to_array(&self) -> [f64; 1] {
            [self.0]
        }
        fn from_array([x]: [f64; 1]) -> Self {
            Self(x)
        }
        fn names() -> [&'static str; 1] {
            ["x"]
        }
    }
    struct Rest;
    impl Dynamics for Rest {
        type State = Place;
        type Input = ();
        fn derivative(&self, _: f64, _: &Place, (): &()) -> Place {
            Place(0.0)
        }
    }
    impl Jacobian for Rest {
        type InputDim = D<0>;
        fn state_jacobian(&self, t: f64, _: &Place, (): &()) -> [[f64; 1]; 1] {
            [[if t > 0.0 { f64::INFINITY } else { 0.0 }]]
        }
        fn input_jacobian(&self, _: f64, _: &Place, (): &()) -> [[f64; 0]; 1] {
            [[]]
        }
    }
    let expected = IntegrationError::SingularStep { time: 0.0, step: 2.0 };
    let start = Place(1.0);
    let ends = [
        GaussLegendre4::linearized_step(&Rest, 0.0, 2.0, &start, &()).map(|_| ()),
        GaussLegendre6::linearized_step(&Rest, 0.0, 2.0, &start, &()).map(|_| ()),
        Radau5::linearized_step(&Rest, 0.0, 2.0, &start, &()).map(|_| ()),
    ];
    assert_eq!(ends, [const { Err(IntegrationError::SingularStep { time: 0.0, step: 2.0 }) }; 3]);
    assert_eq!(
        expected.to_string(),
        "the step of length 2.0 from t = 0.0 has no derivatives: its equations are singular where they are solved, or the \
         system's Jacobian is not finite there; take a step of another length"
    );
}

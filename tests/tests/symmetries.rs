//! Momenta and their rates: the momentum equation against the derivative along the motion, by dual
//! numbers; conservation laws along trajectories; what the reports say.

use nh_tests::dual::Dual;
use nh_tests::random::Random;
use nonholonomic::Dim;
use nonholonomic::prelude::*;

/// A sleigh with friction, driven. Its momenta: of a section of D, of the plane's translations (which
/// are not in D), and of the rotation about the origin.
#[nonholonomic(
    base   { theta, x, y }
    basis  { omega, v1, v2 }
    anchor {
        der(theta) = omega;
        der(x) = v1 * cos(theta) - v2 * sin(theta);
        der(y) = v1 * sin(theta) + v2 * cos(theta);
    }
    lagrangian  { (J + m * a^2) / 2 * omega^2 + m / 2 * (v1^2 + v2^2) + m * a * omega * v2 }
    constraints { v2 = 0; }
    forces      { omega: torque - c * omega; v1: push * cos(theta) - c * v1; }
    inputs      { torque, push }
    symmetries {
        turn: omega;
        mixed: x * omega + sin(y) * v1;
        along_x: cos(theta) * v1 - sin(theta) * v2;
        along_y: der(y);
        rotation: omega + x * der(y) - y * der(x);
    }
)]
#[derive(Clone, Copy, Debug)]
struct Sleigh<T> {
    m: T,
    J: T,
    a: T,
    c: T,
}

/// A rolling disk: the roll is a symmetry in D, the translations are none.
#[nonholonomic(
    base { x, y, theta, phi }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) + I / 2 * der(theta)^2 + J / 2 * der(phi)^2 }
    constraints {
        der(x) = R * cos(phi) * der(theta);
        der(y) = R * sin(phi) * der(theta);
    }
    forces { theta: drive; }
    inputs { drive }
    symmetries {
        roll: der(theta) + R * cos(phi) * der(x) + R * sin(phi) * der(y);
        steer: der(phi);
        along_x: der(x);
    }
)]
#[derive(Clone, Copy, Debug)]
struct Disk<T> {
    m: T,
    I: T,
    J: T,
    R: T,
}

/// Projected, on an embedded base: sections of D that have no common frame.
#[nonholonomic(
    base { g[3] }
    basis { w[3] }
    anchor {
        der(g[0]) = g[1] * w[2] - g[2] * w[1];
        der(g[1]) = g[2] * w[0] - g[0] * w[2];
        der(g[2]) = g[0] * w[1] - g[1] * w[0];
    }
    on { dot(g, g) = 1; }
    brackets so(3) { w[0], w[1], w[2] }
    lagrangian  { dot(w, I * w) / 2 - dot(c, g) }
    constraints { dot(g, w) = 0; }
    symmetries { tangent: cross(g, w); }
)]
#[derive(Clone, Copy, Debug)]
struct Veselova<T> {
    I: [[T; 3]; 3],
    c: [T; 3],
}

/// A heavy symmetric top: spins about the vertical and about its axis are conserved.
#[nonholonomic(
    base { g[3] }
    basis { w[3] }
    anchor {
        der(g[0]) = g[1] * w[2] - g[2] * w[1];
        der(g[1]) = g[2] * w[0] - g[0] * w[2];
        der(g[2]) = g[0] * w[1] - g[1] * w[0];
    }
    brackets so(3) { w[0], w[1], w[2] }
    lagrangian { A / 2 * (w[0]^2 + w[1]^2) + C / 2 * w[2]^2 - h * g[2] }
    symmetries { vertical: dot(g, w); axial: w[2]; tilt: w[0]; }
)]
#[derive(Clone, Copy, Debug)]
struct Top<T> {
    A: T,
    C: T,
    h: T,
}

/// A skate whose blade is turned, on a belt: an affine constraint and a section that move.
#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - k * x * y }
    constraints { sin(w * t) * der(x) - cos(w * t) * der(y) = belt * x; }
    independent { der(x) }
    symmetries { glide: cos(w * t) * der(x) + sin(w * t) * der(y); }
)]
#[derive(Clone, Copy, Debug)]
struct TurnedBlade<T> {
    m: T,
    k: T,
    w: T,
    belt: T,
}

/// D by sections that span it, with a force along one of them, and a section by the name of the frame.
#[nonholonomic(
    base { x, y, z }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) - k / 2 * z^2 }
    frame { slide = der(x) + y * der(z); across = der(y); }
    distribution { slide, across }
    forces { slide: push - c * slide; }
    inputs { push }
    symmetries { slide: slide; both: 2 * slide + x * der(y); }
)]
#[derive(Clone, Copy, Debug)]
struct Spanned<T> {
    m: T,
    k: T,
    c: T,
}

/// Falls freely: the momentum is conserved up to the impulse of gravity.
#[nonholonomic(
    base { x, z }
    lagrangian { m / 2 * (der(x)^2 + der(z)^2) - m * g * z }
    symmetries { across: der(x); fall: der(z) up to -m * g * t; }
)]
#[derive(Clone, Copy, Debug)]
struct Falling<T> {
    m: T,
    g: T,
}

/// Constant speed in the plane (a nonlinear constraint), free along the vertical.
#[nonholonomic(
    base { x, y, z }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) - k * x }
    constraints { der(x)^2 + der(y)^2 = c^2; }
    symmetries { up: der(z); shift: der(y); }
)]
#[derive(Clone, Copy, Debug)]
struct ConstantSpeed<T> {
    m: T,
    k: T,
    c: T,
}

const T: f64 = 0.3;

/// Evaluates momenta, their rates, and the slopes of the momenta along the motion.
trait Along<S: Dynamics> {
    fn slopes(&self, system: &S, state: &S::State, input: &S::Input) -> (Vec<f64>, Vec<f64>);
}

macro_rules! along {
    ($system:ident, $n:literal $(, $input:ident [$m:literal])?) => {
        impl Along<$system<f64>> for $system<Dual> {
            fn slopes(
                &self,
                system: &$system<f64>,
                state: &<$system<f64> as Dynamics>::State,
                input: &<$system<f64> as Dynamics>::Input,
            ) -> (Vec<f64>, Vec<f64>) {
                let rates = system.momentum_rates(T, state, input);
                let motion = system.derivative(T, state, input).to_array();
                let place = state.to_array();
                let moving: [Dual; $n] =
                    core::array::from_fn(|i| Dual { value: place[i], slope: motion[i] });
                let moving = State::from_array(moving);
                let momenta = self.momenta(Dual { value: T, slope: 1.0 }, &moving);
                (along!(@list rates), along!(@list momenta).iter().map(|momentum| momentum.slope).collect())
            }
        }
    };
    (@list $record:ident) => { Vec::from(<[_; _]>::from($record)) };
}

along!(Sleigh, 5);
along!(Disk, 6);
along!(Veselova, 6);
along!(Top, 6);
along!(TurnedBlade, 3);
along!(Spanned, 5);
along!(Falling, 4);
along!(ConstantSpeed, 6);

/// Compares at random points, brought to the constraints by `prepare`.
fn check<S>(
    system: &S,
    dual: &impl Along<S>,
    input: impl Fn(&mut Random) -> S::Input,
    prepare: impl Fn(&mut S::State),
) where
    S: Dynamics<State: State<Scalar = f64>>,
{
    let n = <S::State as State>::Dim::N;
    let mut random = Random::new(11);
    for _ in 0..50 {
        let point = random.list(n, -1.0, 1.0);
        let mut array = <S::State as State>::Dim::vec(0.0);
        array.as_mut().copy_from_slice(&point);
        let mut state = S::State::from_array(array);
        prepare(&mut state);
        let input = input(&mut random);
        let (rates, slopes) = dual.slopes(system, &state, &input);
        assert!(!rates.is_empty());
        for (index, (rate, slope)) in rates.iter().zip(&slopes).enumerate() {
            let error = (rate - slope).abs();
            assert!(error <= 1e-12 * (1.0 + slope.abs()), "{index}: {rate} is not {slope}");
        }
    }
}

/// A parameter of either kind.
fn n<S: Scalar>(value: f64) -> S {
    S::from_f64(value)
}

fn sleigh<S: Scalar>() -> Sleigh<S> {
    Sleigh { m: n(1.3), J: n(0.7), a: n(0.4), c: n(0.2) }
}

fn disk<S: Scalar>() -> Disk<S> {
    Disk { m: n(1.3), I: n(0.7), J: n(0.4), R: n(0.2) }
}

fn spanned<S: Scalar>() -> Spanned<S> {
    Spanned { m: n(1.3), k: n(0.7), c: n(0.4) }
}

fn veselova<S: Scalar>() -> Veselova<S> {
    let inertia = [[1.2, 0.1, -0.2], [0.1, 0.9, 0.3], [-0.2, 0.3, 1.6]];
    Veselova { I: inertia.map(|row| row.map(n)), c: [0.3, -0.8, 0.5].map(n) }
}

fn speed<S: Scalar>() -> ConstantSpeed<S> {
    ConstantSpeed { m: n(1.2), k: n(0.4), c: n(0.9) }
}

fn blade<S: Scalar>() -> TurnedBlade<S> {
    TurnedBlade { m: n(1.2), k: n(0.4), w: n(0.7), belt: n(0.3) }
}

fn falling<S: Scalar>() -> Falling<S> {
    Falling { m: n(1.2), g: n(9.81) }
}

fn top<S: Scalar>() -> Top<S> {
    Top { A: n(1.2), C: n(0.4), h: n(0.7) }
}

/// Checks mathematics (11) and (12).
#[test]
fn the_momentum_equation_holds_in_the_adapted_formulation() {
    let two = |random: &mut Random| SleighInput {
        torque: random.between(-1.0, 1.0),
        push: random.between(-1.0, 1.0),
    };
    check(&sleigh(), &sleigh(), two, |_| ());
    check(&disk(), &disk(), |random| DiskInput { drive: random.between(-1.0, 1.0) }, |_| ());
    check(&spanned(), &spanned(), |random| SpannedInput { push: random.between(-1.0, 1.0) }, |_| ());
}

#[test]
fn the_momentum_equation_holds_on_the_constraint_manifold() {
    let body = veselova();
    let prepare = |state: &mut VeselovaState<f64>| {
        body.normalize(state).unwrap();
        body.project(T, state).unwrap();
    };
    check(&body, &veselova(), |_| (), prepare);
    let particle = speed();
    check(&particle, &speed(), |_| (), |state| particle.project(T, state).unwrap());
}

#[test]
fn the_momentum_equation_holds_for_moving_sections() {
    check(&blade(), &blade(), |_| (), |_| ());
    check(&falling(), &falling(), |_| (), |_| ());
}

#[test]
fn momenta_without_constraints() {
    check(&top(), &top(), |_| (), |_| ());
    let top = top::<f64>();
    let start = TopState { g: [0.6, 0.0, 0.8], w: [0.3, -0.2, 2.0] };
    let mut sim = Integrator::new(top, Dopri5::new().rtol(1e-12).atol(1e-13), 0.0, start);
    sim.advance_to(20.0).unwrap();
    let (before, after) = (top.momenta(0.0, &start), top.momenta(20.0, sim.state()));
    assert!((before.vertical - after.vertical).abs() < 1e-10, "{before:?} {after:?}");
    assert!((before.axial - after.axial).abs() < 1e-10, "{before:?} {after:?}");
    assert!((before.tilt - after.tilt).abs() > 1e-3, "{before:?} {after:?}");
    let rates = top.momentum_rates(0.0, &start, &());
    assert_eq!((rates.vertical, rates.axial), (0.0, 0.0));
}

#[test]
fn the_report_says_what_a_section_is() {
    let contains = |report: &str, parts: &[&str]| {
        for part in parts {
            assert!(report.contains(part), "{part}\n{report}");
        }
    };
    let sleigh = [
        "turn: omega; in D, L is not invariant; der(omega*(J + m*a^2)) = torque - omega*(c + v1*m*a)",
        "along_x: (cos(theta))*v1 + (-sin(theta))*v2; a symmetry of L and D that is not in D",
        "rotation: omega + ",
        "cyclic coordinates, each left to a quadrature: x, y\n",
        "  momentum_rates: ",
    ];
    contains(Sleigh::<f64>::REPORT, &sleigh);
    let disk = [
        "theta_dot; in D, L is invariant, D is not; der(theta_dot*(I + m*R^2)) = drive\n",
        "the momentum of steer, J*phi_dot (CLMM Theorem 3.5)",
    ];
    contains(Disk::<f64>::REPORT, &disk);
    contains(Falling::<f64>::REPORT, &["the momentum of fall, m*(z_dot + g*t)"]);
    assert!(!Falling::<f64>::REPORT.contains("the momentum of x,"), "{}", Falling::<f64>::REPORT);
    let speed = ["up: z_dot; a horizontal symmetry", "cyclic coordinates, each left to a quadrature: y, z\n"];
    contains(ConstantSpeed::<f64>::REPORT, &speed);
}

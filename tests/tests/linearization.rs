//! `linearization`: mathematics (36) by named variables, and steady motions, against numbers that were found without this
//! project.

use nonholonomic::prelude::*;
use nonholonomic::{LinearizationError, TrimError};

/// A car whose tyres push aside in proportion to the angle at which they slip; the steering angle is given.
#[nonholonomic(
    base { x, y, yaw }
    basis { u, v, r }
    anchor {
        der(x) = u * cos(yaw) - v * sin(yaw);
        der(y) = u * sin(yaw) + v * cos(yaw);
        der(yaw) = r;
    }
    inputs { steer, drive }
    let front = steer - atan((v + a * r) / u);
    let rear = -atan((v - b * r) / u);
    lagrangian { m / 2 * (u^2 + v^2) + J / 2 * r^2 }
    forces {
        u: drive - cf * front * sin(steer);
        v: cf * front * cos(steer) + cr * rear;
        r: a * cf * front * cos(steer) - b * cr * rear;
    }
    outputs { slip = v / u; }
    linearization { keep: u, v, r; }
)]
#[derive(Clone, Copy, Debug)]
struct Car<T> {
    m: T,
    J: T,
    a: T,
    b: T,
    cf: T,
    cr: T,
}

const CAR: Car<f64> = Car { m: 1500.0, J: 2500.0, a: 1.2, b: 1.6, cf: 80_000.0, cr: 90_000.0 };

#[test]
fn a_car_in_a_steady_corner() {
    use CarVariable::{r, steer, u};
    // 20 m/s and 0.3 rad/s, by mpmath.findroot on the three equations of motion (tests/reference/trim.py)
    let guess = CarState { u: 20.0, r: 0.3, x: 7.0, ..CarState::default() };
    let (state, input) = CAR.trim(0.0, &guess, &CarInput::default(), &[u, r]).unwrap();
    assert_eq!((state.u, state.r, state.x), (20.0, 0.3, 7.0));
    assert!((state.v - V).abs() < 1e-12, "{:e}", state.v);
    assert!((input.steer - STEER).abs() < 1e-14, "{:e}", input.steer);
    assert!((input.drive - DRIVE).abs() < 1e-9, "{:e}", input.drive);
    // in `f32`, with the drive held instead
    let car = Car::<f32> { m: 1500.0, J: 2500.0, a: 1.2, b: 1.6, cf: 80_000.0, cr: 90_000.0 };
    let coarse = CarState { u: 20.0, r: 0.3, ..CarState::default() };
    let coarse_input = CarInput { steer: 0.05, drive: 497.128_33 };
    let (found, with) = car.trim(0.0, &coarse, &coarse_input, &[u, CarVariable::drive]).unwrap();
    assert!(
        (found.v + 0.377_668).abs() < 1e-4 && (with.steer - 0.063_532).abs() < 1e-5,
        "{found:?} {with:?}"
    );
    // the same corner by the angle of the wheel
    let (again, _) = CAR.trim(0.0, &guess, &input, &[u, steer]).unwrap();
    assert!((again.r - 0.3).abs() < 1e-13 && (again.v - V).abs() < 1e-12, "{again:?}");
}

const V: f64 = -0.377_668_024_324_452_97;
const STEER: f64 = 0.063_532_271_662_772_35;
const DRIVE: f64 = 497.128_327_777_347_3;

#[test]
fn what_is_not_held_may_be_undetermined() {
    let guess = CarState { u: 20.0, r: 0.3, ..CarState::default() };
    let refused = CAR.trim(0.0, &guess, &CarInput::default(), &[CarVariable::u]).unwrap_err();
    assert!(matches!(refused, TrimError::Undetermined { .. }), "{refused}");
    let all = [CarVariable::u, CarVariable::v, CarVariable::r, CarVariable::steer, CarVariable::drive];
    let refused = CAR.trim(0.0, &guess, &CarInput::default(), &all).unwrap_err();
    let TrimError::NoSolution { equation, .. } = refused else { panic!("{refused}") };
    assert!(equation.starts_with("the rate of"), "{equation}");
}

#[test]
fn the_classical_matrices_of_a_car() {
    // straight ahead: the single-track model
    let guess = CarState { u: 20.0, ..CarState::default() };
    let found = CAR.linearize(0.0, &guess, &CarInput::default()).unwrap();
    let Car { m, J, a, b, cf, cr } = CAR;
    let u = 20.0;
    let expected = [
        [0.0, 0.0, 0.0],
        [0.0, -(cf + cr) / (m * u), -u - (a * cf - b * cr) / (m * u)],
        [0.0, -(a * cf - b * cr) / (J * u), -(a * a * cf + b * b * cr) / (J * u)],
    ];
    for (i, row) in expected.iter().enumerate() {
        for (j, entry) in row.iter().enumerate() {
            assert!((found.a[(i, j)] - entry).abs() < 1e-13, "{i} {j}: {} {entry}", found.a[(i, j)]);
        }
    }
    assert!((found.b[(1, 0)] - cf / m).abs() < 1e-13 && (found.b[(0, 1)] - 1.0 / m).abs() < 1e-18);
    assert_eq!((found.states, found.inputs, found.outputs), (["u", "v", "r"], ["steer", "drive"], ["slip"]));
    assert!((found.c[(0, 1)] - 0.05).abs() < 1e-16);
}

/// A robot on two wheels with a motor on each, its centre of mass ahead of the axle.
#[nonholonomic(
    base { x, y, theta }
    basis { v, omega, side }
    anchor {
        der(x) = v * cos(theta) - side * sin(theta);
        der(y) = v * sin(theta) + side * cos(theta);
        der(theta) = omega;
    }
    constraints { side = 0; }
    lagrangian { m / 2 * (v^2 + (side + d * omega)^2) + J / 2 * omega^2 }
    inputs { volts[2] }
    let wheel = [v - b * omega, v + b * omega];
    auxiliary { der(current[i in 0..2]) = (volts[i] - k / r * wheel[i] - R * current[i]) / L; }
    forces {
        v: k / r * (current[0] + current[1]) - c * v;
        omega: k / r * b * (current[1] - current[0]);
    }
    linearization { keep: v, omega, current; }
)]
#[derive(Clone, Copy, Debug)]
struct Robot {
    m: f64,
    J: f64,
    d: f64,
    b: f64,
    r: f64,
    k: f64,
    R: f64,
    L: f64,
    c: f64,
}

const ROBOT: Robot = Robot { m: 12.0, J: 0.7, d: 0.15, b: 0.2, r: 0.08, k: 0.3, R: 0.9, L: 2e-3, c: 4.0 };

#[test]
fn a_robot_in_a_steady_turn() {
    let Robot { m, d, b, r, k, R, c, .. } = ROBOT;
    let guess = RobotState { v: 1.3, omega: -0.8, theta: 0.4, ..RobotState::default() };
    let held = [RobotVariable::v, RobotVariable::omega];
    let (state, input) = ROBOT.trim(0.0, &guess, &RobotInput::default(), &held).unwrap();
    assert!((state.theta, state.v, state.omega) == (0.4, 1.3, -0.8));
    // the mass ahead of the axle is drawn inwards: thrust c v − m d ω², turning moment m d v ω
    let (thrust, moment) = (c * 1.3 - m * d * 0.64, m * d * 1.3 * -0.8);
    let current = [-1.0, 1.0].map(|side| r / k * (thrust + side * moment / b) / 2.0);
    let speeds = [1.3 + b * 0.8, 1.3 - b * 0.8];
    for ((found, current), (volts, speed)) in
        state.current.iter().zip(current).zip(input.volts.iter().zip(speeds))
    {
        assert!((found - current).abs() < 1e-14, "{state:?}");
        assert!((volts - (R * current + k / r * speed)).abs() < 1e-13, "{input:?}");
    }
    // and it is one: the velocities stay
    let mut sim = Integrator::new(ROBOT, Radau5::new().rtol(1e-9).atol(1e-9), 0.0, state);
    sim.set_input(input);
    sim.advance_to(5.0).unwrap();
    assert!((sim.state().v - 1.3).abs() < 1e-8 && (sim.state().omega + 0.8).abs() < 1e-8);
    assert!((sim.state().theta - (0.4 - 0.8 * 5.0)).abs() < 1e-7);
    let found = ROBOT.linearize(0.0, &state, &input).unwrap();
    assert_eq!(found.states, ["v", "omega", "current[0]", "current[1]"]);
    assert!((found.a[(0, 1)] - 2.0 * d * -0.8).abs() < 1e-14 && (found.b[(2, 0)] - 500.0).abs() < 1e-12);
}

/// A mass on a rope in x and y, which a horizontal force pulls aside.
#[nonholonomic(
    base { x, y }
    holonomic { rope: x^2 + y^2 = l^2; }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - m * g * y }
    forces { x: pull; }
    inputs { pull }
    outputs { height = y / l; }
    linearization { keep: x, der(x); }
)]
#[derive(Clone, Copy, Debug)]
struct Pendulum {
    m: f64,
    l: f64,
    g: f64,
}

const PENDULUM: Pendulum = Pendulum { m: 2.0, l: 0.5, g: 9.81 };

#[test]
fn a_pendulum_in_x_and_y_is_trimmed_on_its_circle() {
    use PendulumVariable::{pull, x};
    let guess = PendulumState { x: 0.3, y: -0.35, x_dot: 0.1, ..PendulumState::default() };
    let (state, input) = PENDULUM.trim(0.0, &guess, &PendulumInput::default(), &[x]).unwrap();
    assert!((state.x - 0.3).abs() < 1e-300 && (state.y + 0.4).abs() < 1e-15, "{state:?}");
    assert!(state.x_dot.abs() < 1e-15 && state.y_dot.abs() < 1e-15, "{state:?}");
    // pull / (m g) = tan of the deflection
    assert!((input.pull - 2.0 * 9.81 * 0.75).abs() < 1e-13, "{input:?}");
    let found = PENDULUM.linearize(0.0, &state, &input).unwrap();
    // ẍ = cos φ l φ̈ and δx = cos φ l δφ there: l φ̈ = −g sin φ + pull/m cos φ
    let frequency = -(9.81 / 0.8 + 0.0) / 0.5;
    assert!((found.a[(1, 0)] - frequency).abs() < 1e-12, "{} {frequency}", found.a[(1, 0)]);
    assert!((found.b[(1, 0)] - 0.64 / 2.0).abs() < 1e-15);
    // along the circle dy/dx = −x/y
    assert!((found.c[(0, 0)] - 0.75 / 0.5).abs() < 1e-14, "{}", found.c);
    // hanging, without a force
    let (state, _) = PENDULUM.trim(0.0, &guess, &PendulumInput::default(), &[pull]).unwrap();
    assert!(state.x.abs() < 1e-15 && (state.y + 0.5).abs() < 1e-15, "{state:?}");
    // where y does not follow from x
    let aside = PendulumState { x: 0.5, ..PendulumState::default() };
    let refused = PENDULUM.linearize(0.0, &aside, &PendulumInput::default()).unwrap_err();
    assert_eq!(refused, LinearizationError::NotFree { kept: "x" });
    // no force holds it further out than the rope reaches
    let far = PendulumState { x: 0.6, y: -0.1, ..PendulumState::default() };
    let refused = PENDULUM.trim(0.0, &far, &PendulumInput::default(), &[x]).unwrap_err();
    assert!(matches!(refused, TrimError::NoSolution { .. } | TrimError::Undetermined { .. }), "{refused}");
    let nowhere = PendulumState { x: f64::NAN, ..PendulumState::default() };
    let refused = PENDULUM.trim(0.0, &nowhere, &PendulumInput::default(), &[]).unwrap_err();
    assert_eq!(refused.to_string(), "`x` of the guess is NaN: give finite numbers");
}

/// A body that turns about a fixed point, with the vertical in its axes.
#[nonholonomic(
    base { g[3] }
    on { dot(g, g) = 1; }
    basis { w[3] }
    anchor { der(g) = cross(g, w); }
    brackets so(3) { w }
    lagrangian { sum(i in 0..3: I[i] * w[i]^2) / 2 - weight * g[2] }
    linearization { keep: g[0], g[1], w; }
)]
#[derive(Clone, Copy, Debug)]
struct Top {
    I: [f64; 3],
    weight: f64,
}

#[test]
fn a_top_sleeps_on_the_sphere() {
    let top = Top { I: [2.0, 2.5, 1.0], weight: 3.0 };
    let guess = TopState { g: [0.05, -0.02, 1.02], w: [0.1, 0.1, 4.0] };
    let (state, ()) = top.trim(0.0, &guess, &(), &[TopVariable::w_2]).unwrap();
    assert!(state.w[2].to_bits() == 4.0_f64.to_bits() && (state.g[2] - 1.0).abs() < 1e-15, "{state:?}");
    assert!(state.w[0].abs() + state.w[1].abs() + state.g[0].abs() + state.g[1].abs() < 1e-13, "{state:?}");
    let found = top.linearize(0.0, &state, &()).unwrap();
    // Euler's equations about the vertical: ẇ₀ = ((I₁ − I₂) 4 w₁ + weight g₁)/I₀
    assert!((found.a[(2, 3)] - 1.5 * 4.0 / 2.0).abs() < 1e-14, "{}", found.a);
    assert!((found.a[(2, 1)].abs() - 1.5).abs() < 1e-14, "{}", found.a);
}

nh_models::bicycle! {
    #[derive(Clone, Copy, Debug)]
    struct Bicycle<T>;
    forces { steer: torque; }
    inputs { torque }
    linearization { keep: lean, steer, der(lean), der(steer); }
}

/// Upright at a speed, roughly.
fn riding(speed: f64) -> (Bicycle<f64>, BicycleState<f64>) {
    let bicycle = nh_models::published_bicycle!(Bicycle, 9.81, |number: f64| number);
    (bicycle, BicycleState { rear_dot: -speed / 0.3, yaw: 0.7, x: 3.0, ..BicycleState::default() })
}

#[test]
fn the_benchmark_bicycle_is_trimmed_upright_and_in_a_turn() {
    use BicycleVariable::{rear_dot, steer, torque};

    let (bicycle, straight) = riding(5.0);
    let leaning = BicycleState { lean: 0.05, steer: -0.02, lean_dot: 0.01, ..straight };
    let upright = bicycle.trim(0.0, &leaning, &BicycleInput::default(), &[rear_dot, torque]).unwrap();
    let (BicycleState { lean, steer: delta, lean_dot, pitch, yaw, x, .. }, _) = upright;
    assert!(lean.abs() + delta.abs() + lean_dot.abs() + pitch.abs() < 1e-12, "{upright:?}");
    assert!((yaw, x) == (0.7, 3.0));
    // the published eigenvalues at 5 m/s: products and sums of λ² + 1.55 λ + … (weave), capsize, castering
    let a = bicycle.linearize(0.0, &upright.0, &upright.1).unwrap().a;
    let (re, im) = (-0.775_341_882_195_85_f64, 4.464_867_713_788_23_f64);
    let (capsize, castering) = (-0.322_866_429_004_09, -14.078_389_692_798_22);
    assert!((a.trace() - (2.0 * re + capsize + castering)).abs() < 1e-11, "{}", a.trace());
    let determinant = (re * re + im * im) * capsize * castering;
    let (rates, stiffness) = (a.fixed_view::<2, 2>(0, 2), a.fixed_view::<2, 2>(2, 0));
    assert!((rates - nalgebra::Matrix2::identity()).abs().max() < 1e-14);
    let found = stiffness[(0, 0)] * stiffness[(1, 1)] - stiffness[(0, 1)] * stiffness[(1, 0)];
    assert!((found / determinant - 1.0).abs() < 1e-10, "{found}");
    // a small turn leans as the published K₀ and K₂ say
    let small = BicycleState { steer: 1e-5, ..straight };
    let (turning, _) = bicycle.trim(0.0, &small, &BicycleInput::default(), &[rear_dot, steer]).unwrap();
    let by_steer = 9.81 * -2.599_516_852_498_72 + 25.0 * 76.597_345_895_732_22;
    let ratio = -by_steer / (9.81 * -80.95);
    assert!((turning.lean / 1e-5 / ratio - 1.0).abs() < 1e-8, "{} {ratio}", turning.lean / 1e-5);
    // a wide one goes round: speed, lean and steering stay, also as the equations of motion have it
    let wide = BicycleState { steer: 0.2, lean: 0.3, ..straight };
    let (state, input) = bicycle.trim(0.0, &wide, &BicycleInput::default(), &[rear_dot, steer]).unwrap();
    assert!(state.steer.to_bits() == 0.2_f64.to_bits() && state.lean > 0.3, "{state:?}");
    let mut sim = Integrator::new(bicycle, Dopri5::new().rtol(1e-11).atol(1e-11), 0.0, state);
    sim.set_input(input);
    sim.advance_to(1.0).unwrap();
    let after = sim.state();
    assert!((after.lean - state.lean).abs() < 1e-8 && (after.steer - 0.2).abs() < 1e-8, "{after:?}");
    assert!((after.rear_dot - state.rear_dot).abs() < 1e-8 && (after.yaw - state.yaw).abs() > 0.5);
    // the speed is what nothing else says
    let refused = bicycle.trim(0.0, &straight, &BicycleInput::default(), &[torque]).unwrap_err();
    assert_eq!(refused, TrimError::Undetermined { variable: "rear_dot" });
    assert!(refused.to_string().contains("hold it"), "{refused}");
    // in a turn the lean's rate changes with the speed, which is not kept
    let refused = bicycle.linearize(0.0, &state, &input).unwrap_err();
    assert!(matches!(refused, LinearizationError::DependsOnOthers { other: "rear_dot", .. }), "{refused}");
}

/// A mass on a spring of the user's making.
#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 + m * g * x }
    forces { x: -self.spring(x, stretch) - der(x); }
    inputs { stretch }
    derivative { spring: [self.stiffness, self.by_stretch]; }
    linearization { keep: x, der(x); }
)]
#[derive(Clone, Copy, Debug)]
struct Hanging {
    m: f64,
    g: f64,
}

impl Hanging {
    fn spring(&self, x: f64, stretch: f64) -> f64 {
        self.m * (x + x.powi(3) - stretch)
    }
    fn stiffness(&self, x: f64, _stretch: f64) -> f64 {
        self.m * (1.0 + 3.0 * x * x)
    }
    fn by_stretch(&self, _x: f64, _stretch: f64) -> f64 {
        -self.m
    }
}

#[test]
fn methods_are_differentiated_by_the_declared_methods() {
    let hanging = Hanging { m: 2.0, g: 10.0 };
    let held = [HangingCoordinate::stretch];
    let (state, _) = hanging.trim(0.0, &HangingState::default(), &HangingInput::default(), &held).unwrap();
    // x + x³ = 10
    assert!((state.x - 2.0).abs() < 1e-15, "{state:?}");
    let found = hanging.linearize(0.0, &state, &HangingInput::default()).unwrap();
    assert!((found.a[(1, 0)] + 13.0).abs() < 1e-14 && (found.a[(1, 1)] + 0.5).abs() < 1e-15);
    assert!((found.b[(1, 0)] - 1.0).abs() < 1e-15);
}

/// A slider and its crank, by what is independent and what a linearisation keeps.
macro_rules! slider_crank {
    ($name:ident, $independent:tt, $linearization:tt, $state:expr) => {
        #[nonholonomic(
            base { crank, rod, slide }
            holonomic {
                along: r * cos(crank) + l * cos(rod) = slide;
                across: r * sin(crank) + l * sin(rod) = 0;
            }
            lagrangian {
                J / 2 * der(crank)^2 + j / 2 * der(rod)^2 + m / 2 * der(slide)^2 - k / 2 * (slide - l)^2
            }
            inputs { torque }
            forces { crank: torque; }
            outputs { place = slide; }
            independent $independent
            linearization $linearization
        )]
        #[derive(Clone, Copy, Debug)]
        struct $name {
            r: f64,
            l: f64,
            J: f64,
            j: f64,
            m: f64,
            k: f64,
        }

        impl $name {
            /// What is linearised where the crank is at 0.4, and turns at 1.5.
            fn turning() -> nonholonomic::Linearization<f64, 2, 1, 1> {
                let machine = Self { r: 0.3, l: 0.8, J: 0.02, j: 0.01, m: 0.6, k: 40.0 };
                let (sine, cosine) = 0.4_f64.sin_cos();
                let rod = -(0.3 * sine / 0.8).asin();
                let slide = 0.3 * cosine + 0.8 * rod.cos();
                let state = $state(&machine, rod, slide);
                machine.linearize(0.0, &state, &Default::default()).unwrap()
            }
        }
    };
}

slider_crank!(Named, { der(crank) }, { keep: crank, der(crank); }, |_: &Self, rod, slide| {
    NamedState { crank: 0.4, rod, slide, crank_dot: 1.5 }
});
slider_crank!(Charted, { crank, der(crank) }, {}, |_: &Self, rod, slide| {
    ChartedState { crank: 0.4, rod, slide, crank_dot: 1.5 }
});
// every velocity is in the state, and the rate of the chart's coordinate is kept
slider_crank!(Placed, { crank }, {}, |machine: &Self, rod: f64, slide| {
    let (sine, cosine) = 0.4_f64.sin_cos();
    let rod_dot = -machine.r * cosine * 1.5 / (machine.l * rod.cos());
    let slide_dot = -machine.r * sine * 1.5 - machine.l * rod.sin() * rod_dot;
    PlacedState { crank: 0.4, rod, slide, crank_dot: 1.5, rod_dot, slide_dot }
});

#[test]
fn what_is_independent_is_kept_by_a_linearisation() {
    let named = Named::turning();
    for other in [Charted::turning(), Placed::turning()] {
        assert_eq!(other.states, ["crank", "crank_dot"]);
        let scale = named.a.amax();
        assert!((other.a - named.a).amax() < 1e-13 * scale, "{} {}", other.a, named.a);
        assert!((other.b - named.b).amax() < 1e-13 * named.b.amax(), "{} {}", other.b, named.b);
        assert!((other.c - named.c).amax() < 1e-14, "{} {}", other.c, named.c);
    }
    // ds/dcrank = -r sin crank + r cos crank tan rod
    let rod = -(0.3 * 0.4_f64.sin() / 0.8).asin();
    let slope = 0.3 * (0.4_f64.cos() * rod.tan() - 0.4_f64.sin());
    assert!((named.c[(0, 0)] - slope).abs() < 1e-14, "{} {slope}", named.c);
    assert!(
        Placed::REPORT.contains("independent coordinates: crank, as named; it is valid where cos(rod) != 0"),
        "{}",
        Placed::REPORT
    );
    // without constraints every variable is independent; an embedded place has a chart
    let all = Free { m: 2.0, k: 8.0 }.linearize(0.0, &FreeState::default(), &()).unwrap();
    assert_eq!((all.states, all.a[(1, 0)]), (["x", "x_dot"], -4.0));
    let rod = OnCircle { m: 2.0, l: 0.5, g: 9.81 };
    let hanging = OnCircleState { c: 1.0, ..OnCircleState::default() };
    let found = rod.linearize(0.0, &hanging, &()).unwrap();
    assert_eq!(found.states, ["s", "w"]);
    assert!((found.a[(1, 0)] + 9.81 / 0.5).abs() < 1e-13, "{}", found.a);
}

#[nonholonomic(base { x } lagrangian { m / 2 * der(x)^2 - k / 2 * x^2 } linearization {})]
struct Free {
    m: f64,
    k: f64,
}

#[nonholonomic(
    base { c, s }
    on { c^2 + s^2 = 1; }
    basis { w }
    anchor { der(c) = -s * w; der(s) = c * w; }
    lagrangian { m / 2 * l^2 * w^2 + m * g * l * c }
    independent { s }
    linearization {}
)]
struct OnCircle {
    m: f64,
    l: f64,
    g: f64,
}

#[test]
fn refusals_say_what_to_do() {
    let texts = [
        LinearizationError::NotFinite.to_string(),
        LinearizationError::NotFree { kept: "x" }.to_string(),
        LinearizationError::DependsOnOthers { kept: "x", other: "y", value: 0.5 }.to_string(),
        TrimError::Undetermined { variable: "x" }.to_string(),
        TrimError::NoSolution { equation: "the rate of `x`", residual: 0.5 }.to_string(),
        TrimError::NotFinite.to_string(),
    ];
    let expected = [
        "the derivatives are not finite at this state: the mass matrix or the constraints may be singular",
        "`x` follows from the other variables that are kept by the constraints at this state: keep fewer",
        "the rate of `x` changes with `y`, which is not kept, by 0.5: keep that as well",
        "the motion stays steady where `x` changes, as far as the derivatives tell where the search came to: hold it, \
         or another variable of that family",
        "no steady motion was found: the rate of `x` is left with 0.5; hold fewer variables or other values, or guess \
         nearer to a solution",
        "the motion or its derivatives are not finite where the search came to: guess away from there",
    ];
    assert_eq!(texts, expected);
    // a bad start
    let standing = CAR.trim(0.0, &CarState::default(), &CarInput::default(), &[]).unwrap_err();
    assert_eq!(standing, TrimError::NotFinite);
}

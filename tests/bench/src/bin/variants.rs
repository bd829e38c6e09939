//! The same system with parameters at run time, prepared, with constants, and without what a scene does
//! not need: instructions per evaluation of the derivative, and the size of the state.
//!
//! ```sh
//! RUSTFLAGS="-C target-cpu=x86-64-v3" cargo run --release -p nh-bench --bin variants
//! ```
#![allow(non_snake_case, reason = "parameters are written as in mechanics: J, R")]

use std::hint::black_box;
use std::process::ExitCode;

use nh_bench::callgrind;
use nh_bench::contest::Random;
use nh_runtime::Dim;
use nh_runtime::prelude::*;

/// The argument with which the program calls itself under callgrind.
const EVALUATE: &str = "--evaluate";
/// The states at which a derivative is evaluated.
const SAMPLES: usize = 16;

/// One way to declare a system.
struct Variant {
    system: &'static str,
    name: &'static str,
    /// Evaluates at some states.
    evaluate: Box<dyn Fn()>,
    /// The function that is counted.
    symbol: &'static str,
    /// Of the state.
    components: usize,
}

/// Declares the sleigh, with some fields and more sections.
macro_rules! sleigh {
    ({ $($field:ident: $kind:ty),* } $($more:tt)*) => {
        #[nh_runtime::nonholonomic(
            $($more)*
            base   { theta, x, y }
            basis  { omega, v1, v2 }
            anchor {
                der(theta) = omega;
                der(x) = v1 * cos(theta) - v2 * sin(theta);
                der(y) = v1 * sin(theta) + v2 * cos(theta);
            }
            lagrangian  { (J + m * (a^2 + b^2)) / 2 * omega^2 + m / 2 * (v1^2 + v2^2) - m * b * omega * v1 + m * a * omega * v2 }
            constraints { v2 = 0; }
            forces      { omega: torque - c * omega; }
            inputs      { torque }
        )]
        #[derive(Clone, Copy, Debug)]
        pub(crate) struct Sleigh {
            $(pub(crate) $field: $kind),*
        }
    };
}

mod sleigh_varying {
    sleigh! { { m: f64, J: f64, a: f64, b: f64, c: f64 } emit { prepared } }
}

mod sleigh_fixed {
    sleigh! { {} constants { m = 1.3; J = 0.7; a = 0.4; b = 0.15; c = 0.2; } }
}

mod sleigh_tracked {
    sleigh! { { m: f64, J: f64, a: f64, b: f64, c: f64 } track { omega, v1 } }
}

/// Declares the robot, with some fields and more sections.
macro_rules! robot {
    ({ $($field:ident: $kind:ty),* } $($more:tt)*) => {
        #[nh_runtime::nonholonomic(
            $($more)*
            base { psi1, psi2, x, y, theta }
            lagrangian {
                let lateral = -der(x) * sin(theta) + der(y) * cos(theta);
                (m0 + 2 * m1) / 2 * (der(x)^2 + der(y)^2) + m0 * l * lateral * der(theta)
                    + J / 2 * der(theta)^2 + J2 / 2 * (der(psi1)^2 + der(psi2)^2)
            }
            constraints {
                der(x) = -R / 2 * (der(psi1) + der(psi2)) * cos(theta);
                der(y) = -R / 2 * (der(psi1) + der(psi2)) * sin(theta);
                der(theta) = R / (2 * c) * (der(psi2) - der(psi1));
            }
        )]
        #[derive(Clone, Copy, Debug)]
        pub(crate) struct Robot {
            $(pub(crate) $field: $kind),*
        }
    };
}

mod robot_varying {
    robot! { { m0: f64, m1: f64, l: f64, J: f64, J2: f64, c: f64, R: f64 } emit { prepared } }
}

mod robot_fixed {
    robot! { {} constants { m0 = 5.0; m1 = 0.4; l = 0.12; J = 0.31; J2 = 0.004; c = 0.2; R = 0.08; } }
}

/// Declares the tractor, 6 trailers, with some fields and more sections.
macro_rules! tractor {
    ({ $($field:ident: $kind:ty),* } $($more:tt)*) => {
        #[nh_runtime::nonholonomic(
            $($more)*
            base  { x, y, th, rel[6] }
            basis { v, side, omega, rd[6] }
            anchor {
                der(x) = v * cos(th) - side * sin(th);
                der(y) = v * sin(th) + side * cos(th);
                der(th) = omega;
                for i in 0..6 { der(rel[i]) = rd[i]; }
            }
            lagrangian {
                let ang[i in 0..6] = sum(j in 0..i+1: rel[j]);
                let w[i in 0..6] = omega + sum(j in 0..i+1: rd[j]);
                let px[i in 0..6] = v + sum(j in 0..i+1: d[j] * sin(ang[j]) * w[j]);
                let py[i in 0..6] = side - sum(j in 0..i+1: d[j] * cos(ang[j]) * w[j]);
                m[0] / 2 * (v^2 + (side + a * omega)^2) + J[0] / 2 * omega^2
                    + sum(i in 0..6: J[i+1] / 2 * w[i]^2 + m[i+1] / 2 * (px[i]^2 + py[i]^2))
            }
            constraints {
                let ang[i in 0..6] = sum(j in 0..i+1: rel[j]);
                let w[i in 0..6] = omega + sum(j in 0..i+1: rd[j]);
                let px[i in 0..6] = v + sum(j in 0..i+1: d[j] * sin(ang[j]) * w[j]);
                let py[i in 0..6] = side - sum(j in 0..i+1: d[j] * cos(ang[j]) * w[j]);
                side = 0;
                for i in 0..6 { cos(ang[i]) * py[i] = sin(ang[i]) * px[i]; }
            }
            inputs { push, steer }
            forces { v: push; omega: steer; }
        )]
        #[derive(Clone, Copy, Debug)]
        pub(crate) struct Tractor {
            $(pub(crate) $field: $kind),*
        }
    };
}

mod tractor_varying {
    tractor! { { m: [f64; 7], J: [f64; 7], d: [f64; 6], a: f64 } emit { prepared } }
}

mod tractor_fixed {
    tractor! { {} constants { m = [1.5, 1.1, 0.9, 0.7, 0.6, 0.5, 0.45]; J = [0.4, 0.2, 0.14, 0.1, 0.08, 0.07, 0.06]; d = [0.9, 0.85, 0.8, 0.75, 0.7, 0.65]; a = 0.25; } }
}

/// A variant with a function of its own, which is counted by its name.
macro_rules! variant {
    ($system:expr, $name:expr, $function:ident, $System:ty, $value:expr) => {{
        #[inline(never)]
        fn $function(
            system: &$System,
            state: &<$System as nh_runtime::Dynamics>::State,
            input: &<$System as nh_runtime::Dynamics>::Input,
        ) -> <$System as nh_runtime::Dynamics>::State {
            nh_runtime::Dynamics::derivative(system, 0.0, state, input)
        }
        Variant {
            system: $system,
            name: $name,
            evaluate: Box::new(move || evaluate(&$value, $function)),
            symbol: concat!(module_path!(), "::variants::", stringify!($function)),
            components: components::<$System>(),
        }
    }};
}
/// A variant whose value is a `const`, which the compiler folds into the inlined derivative.
macro_rules! known {
    ($system:expr, $function:ident, $System:ty, $value:expr) => {{
        #[inline(never)]
        fn $function(
            _: &$System,
            state: &<$System as nh_runtime::Dynamics>::State,
            input: &<$System as nh_runtime::Dynamics>::Input,
        ) -> <$System as nh_runtime::Dynamics>::State {
            const VALUE: $System = $value;
            nh_runtime::Dynamics::derivative(&VALUE, 0.0, state, input)
        }
        Variant {
            system: $system,
            name: "a `const` value",
            evaluate: Box::new(move || evaluate(&$value, $function)),
            symbol: concat!(module_path!(), "::variants::", stringify!($function)),
            components: components::<$System>(),
        }
    }};
}

/// How many components a state has.
fn components<S: Dynamics>() -> usize {
    <<S::State as State>::Dim as Dim>::N
}

/// Evaluates a derivative at random states.
fn evaluate<S>(system: &S, derivative: fn(&S, &S::State, &S::Input) -> S::State)
where
    S: Dynamics<State: State<Scalar = f64>>,
{
    let mut random = Random::new();
    for _ in 0..SAMPLES {
        let mut components = <<S::State as State>::Dim as Dim>::vec(0.0);
        components.as_mut().fill_with(|| random.draw());
        let state = S::State::from_array(components);
        black_box(derivative(black_box(system), black_box(&state), black_box(&S::Input::default())));
    }
}

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<(), String> {
    let variants = variants();
    if std::env::args().nth(1).is_some_and(|argument| argument == EVALUATE) {
        for variant in &variants {
            (variant.evaluate)();
        }
        return Ok(());
    }
    let program = std::env::current_exe().map_err(|error| error.to_string())?;
    let profile = program.with_file_name("nh-bench.variants.callgrind");
    let wanted = |name: &str| variants.iter().any(|variant| name.ends_with(variant.symbol));
    let counts = callgrind::count(&[&program.to_string_lossy(), EVALUATE], &profile, wanted)?;
    println!("| system | parameters | components of the state | instructions |");
    println!("|---|---|--:|--:|");
    for variant in &variants {
        let count = counts.iter().find(|(name, _)| name.ends_with(variant.symbol));
        let count = count.map_or("–".to_owned(), |(_, count)| format!("{count:.0}"));
        println!("| {} | {} | {} | {count} |", variant.system, variant.name, variant.components);
    }
    Ok(())
}

/// All of them.
fn variants() -> Vec<Variant> {
    let sleigh = sleigh_varying::Sleigh { m: 1.3, J: 0.7, a: 0.4, b: 0.15, c: 0.2 };
    let sleigh = [
        variant!("sleigh", "at run time", sleigh_at_run_time, sleigh_varying::Sleigh, sleigh),
        variant!("sleigh", "prepared", sleigh_prepared, sleigh_varying::PreparedSleigh, sleigh.prepare()),
        variant!("sleigh", "constants", sleigh_constants, sleigh_fixed::Sleigh, sleigh_fixed::Sleigh {}),
        variant!(
            "sleigh",
            "at run time, `track { omega, v1 }`",
            sleigh_tracked_alone,
            sleigh_tracked::Sleigh,
            sleigh_tracked::Sleigh { m: 1.3, J: 0.7, a: 0.4, b: 0.15, c: 0.2 }
        ),
        known!(
            "sleigh",
            sleigh_known,
            sleigh_varying::Sleigh,
            sleigh_varying::Sleigh { m: 1.3, J: 0.7, a: 0.4, b: 0.15, c: 0.2 }
        ),
    ];
    let robot = robot_varying::Robot { m0: 5.0, m1: 0.4, l: 0.12, J: 0.31, J2: 0.004, c: 0.2, R: 0.08 };
    let robot = [
        variant!("robot", "at run time", robot_at_run_time, robot_varying::Robot, robot),
        variant!("robot", "prepared", robot_prepared, robot_varying::PreparedRobot, robot.prepare()),
        variant!("robot", "constants", robot_constants, robot_fixed::Robot, robot_fixed::Robot {}),
        known!(
            "robot",
            robot_known,
            robot_varying::Robot,
            robot_varying::Robot { m0: 5.0, m1: 0.4, l: 0.12, J: 0.31, J2: 0.004, c: 0.2, R: 0.08 }
        ),
    ];
    let tractor = tractor_varying::Tractor {
        m: [1.5, 1.1, 0.9, 0.7, 0.6, 0.5, 0.45],
        J: [0.4, 0.2, 0.14, 0.1, 0.08, 0.07, 0.06],
        d: [0.9, 0.85, 0.8, 0.75, 0.7, 0.65],
        a: 0.25,
    };
    let tractor = [
        variant!(
            "tractor, 6 trailers",
            "at run time",
            tractor_at_run_time,
            tractor_varying::Tractor,
            tractor
        ),
        variant!(
            "tractor, 6 trailers",
            "prepared",
            tractor_prepared,
            tractor_varying::PreparedTractor,
            tractor.prepare()
        ),
        variant!(
            "tractor, 6 trailers",
            "constants",
            tractor_constants,
            tractor_fixed::Tractor,
            tractor_fixed::Tractor {}
        ),
        known!(
            "tractor, 6 trailers",
            tractor_known,
            tractor_varying::Tractor,
            tractor_varying::Tractor {
                m: [1.5, 1.1, 0.9, 0.7, 0.6, 0.5, 0.45],
                J: [0.4, 0.2, 0.14, 0.1, 0.08, 0.07, 0.06],
                d: [0.9, 0.85, 0.8, 0.75, 0.7, 0.65],
                a: 0.25,
            }
        ),
    ];
    sleigh.into_iter().chain(robot).chain(tractor).collect()
}

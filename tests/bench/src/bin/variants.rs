//! The same system with parameters at run time, prepared, with constants, and without what a scene does
//! not need: instructions per evaluation of the derivative, and the size of the state.
//!
//! ```sh
//! RUSTFLAGS="-C target-cpu=x86-64-v3" cargo run --release -p nh-bench --bin variants
//! ```
#![allow(non_snake_case, reason = "parameters are written as in mechanics: J, R")]

use std::hint::black_box;
use std::process::ExitCode;

use nh_bench::contest::Random;
use nh_counted::program;
use nonholonomic::Dim;
use nonholonomic::prelude::*;

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

mod sleigh_varying {
    nh_models::sleigh! {
        #[derive(Clone, Copy, Debug)]
        pub(crate) struct Sleigh {
            pub(crate) m: f64,
            pub(crate) J: f64,
            pub(crate) a: f64,
            pub(crate) b: f64,
            pub(crate) c: f64,
        }
        emit { prepared }
    }
}

mod sleigh_fixed {
    nh_models::sleigh! {
        #[derive(Clone, Copy, Debug)]
        pub(crate) struct Sleigh {}
        constants { m = 1.3; J = 0.7; a = 0.4; b = 0.15; c = 0.2; }
    }
}

mod sleigh_tracked {
    nh_models::sleigh! {
        #[derive(Clone, Copy, Debug)]
        pub(crate) struct Sleigh {
            pub(crate) m: f64,
            pub(crate) J: f64,
            pub(crate) a: f64,
            pub(crate) b: f64,
            pub(crate) c: f64,
        }
        track { omega, v1 }
    }
}

mod robot_varying {
    nh_models::robot! {
        #[derive(Clone, Copy, Debug)]
        pub(crate) struct Robot {
            pub(crate) m0: f64,
            pub(crate) m1: f64,
            pub(crate) l: f64,
            pub(crate) J: f64,
            pub(crate) J2: f64,
            pub(crate) c: f64,
            pub(crate) R: f64,
        }
        emit { prepared }
    }
}

mod robot_fixed {
    nh_models::robot! {
        #[derive(Clone, Copy, Debug)]
        pub(crate) struct Robot {}
        constants { m0 = 5.0; m1 = 0.4; l = 0.12; J = 0.31; J2 = 0.004; c = 0.2; R = 0.08; }
    }
}

mod tractor_varying {
    nh_models::tractor! {
        6 trailers:
        #[derive(Clone, Copy, Debug)]
        pub(crate) struct Tractor {
            pub(crate) m: [f64; 7],
            pub(crate) J: [f64; 7],
            pub(crate) d: [f64; 6],
            pub(crate) a: f64,
        }
        emit { prepared }
    }
}

mod tractor_fixed {
    nh_models::tractor! {
        6 trailers:
        #[derive(Clone, Copy, Debug)]
        pub(crate) struct Tractor {}
        constants {
            m = [1.5, 1.1, 0.9, 0.7, 0.6, 0.5, 0.45];
            J = [0.4, 0.2, 0.14, 0.1, 0.08, 0.07, 0.06];
            d = [0.9, 0.85, 0.8, 0.75, 0.7, 0.65];
            a = 0.25;
        }
    }
}

/// A variant with a function of its own, which is counted by its name.
macro_rules! variant {
    ($system:expr, $name:expr, $function:ident, $System:ty, $value:expr) => {{
        #[inline(never)]
        fn $function(
            system: &$System,
            state: &<$System as nonholonomic::Dynamics>::State,
            input: &<$System as nonholonomic::Dynamics>::Input,
        ) -> <$System as nonholonomic::Dynamics>::State {
            nonholonomic::Dynamics::derivative(system, 0.0, state, input)
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
            state: &<$System as nonholonomic::Dynamics>::State,
            input: &<$System as nonholonomic::Dynamics>::Input,
        ) -> <$System as nonholonomic::Dynamics>::State {
            const VALUE: $System = $value;
            nonholonomic::Dynamics::derivative(&VALUE, 0.0, state, input)
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
    let evaluate = |_: &[String]| {
        for variant in variants() {
            (variant.evaluate)();
        }
        Ok(())
    };
    program::main(evaluate, measure)
}

fn measure(_: &[String]) -> Result<(), String> {
    let variants = variants();
    let wanted = |name: &str| variants.iter().any(|variant| name.ends_with(variant.symbol));
    let counts = program::count("nh-bench.variants.callgrind", &[], wanted)?;
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

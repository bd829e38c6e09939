//! Instructions of each single step of the methods of fixed step, at states all over the place and in a running
//! simulation: the least and the most. With [`Fast`] numbers, whose sine has no branch, they have to be equal,
//! or the program fails; the platform's sine and the iterations of implicit methods are shown beside them.
//!
//! ```sh
//! cargo run --release -p nh-counted --bin steps
//! ```
#![allow(non_snake_case, reason = "parameters are written as in mechanics: J, R")]

use std::hint::black_box;
use std::process::ExitCode;

use nh_counted::random::Random;
use nh_counted::{callgrind, program};
use nonholonomic::methods::Method;
use nonholonomic::prelude::*;
use nonholonomic::{Dim, ScalarOf, VecOf};

/// Instructions are counted from the beginning of the one function to that of the other.
const COUNTED: [&str; 2] = ["*counted_step*", "*end_of_step*"];
/// How many steps are counted of each case.
const STEPS: usize = 16;

nh_models::sleigh! {
    /// A sleigh with a basis of D: sine and cosine.
    #[derive(Clone, Copy, Debug)]
    struct Sleigh<T> { m: T, J: T, a: T, b: T, c: T }
    emit { angle_cache }
}

nh_models::snakeboard! {
    /// The snakeboard: sine and cosine of two angles.
    #[derive(Clone, Copy, Debug)]
    struct Snakeboard<T> { m: T, l: T, J0: T, J1: T }
    independent { u1, dpsi, dphi }
    emit { angle_cache }
}

nh_models::veselova! {
    /// The Veselova system: all velocities and a multiplier.
    #[derive(Clone, Copy, Debug)]
    struct Veselova<T> { I: [T; 3], c: [T; 3] }
    on { dot(g, g) = 1; }
}

/// Steps of a method from many states, or of one simulation.
struct Case {
    number: &'static str,
    system: &'static str,
    /// Whether a pure function or a simulation takes the steps.
    way: &'static str,
    method: &'static str,
    /// Whether every step has to cost the same.
    is_constant: bool,
    /// Takes the steps, each in a call of [`counted_step`].
    run: Box<dyn Fn()>,
}

/// Callgrind counts from the beginning of this function to that of the next.
#[inline(never)]
fn counted_step(step: &mut dyn FnMut()) {
    step();
    end_of_step();
}

#[inline(never)]
fn end_of_step() {
    black_box(());
}

/// A pure function of a state, at random states.
fn anywhere<S: Dynamics + 'static>(
    system: S,
    step: impl Fn(&S, &S::State) -> S::State + 'static,
) -> Box<dyn Fn()> {
    Box::new(move || {
        let mut random = Random::new();
        for place in 0..STEPS {
            // near and far, slow and fast, but no angle beyond 1.6 million radians, where the sine does branch
            let scale = [1e-3, 1.0, 10.0, 100.0][place % 4];
            let mut numbers: VecOf<S> = <<S::State as State>::Dim as Dim>::vec(ScalarOf::<S>::ZERO);
            numbers.as_mut().fill_with(|| Scalar::from_f64(scale * random.draw()));
            let state = black_box(S::State::from_array(numbers));
            counted_step(&mut || _ = black_box(step(black_box(&system), &state)));
        }
    })
}

/// The steps of a simulation after its first.
fn running<S, M>(system: S, method: M, start: S::State) -> Box<dyn Fn()>
where
    S: Dynamics<State: State<Scalar: Real>> + Clone + 'static,
    M: Method<S> + Copy + 'static,
{
    Box::new(move || {
        let mut sim = Integrator::new(system.clone(), method, Scalar::from_f64(0.0), start);
        let _ = sim.step();
        for _ in 0..STEPS {
            counted_step(&mut || _ = black_box(sim.step()));
        }
    })
}

/// The parameters of the sleigh over any number.
fn sleigh<T: Scalar>() -> Sleigh<T> {
    let [m, J, a, b, c] = [1.3, 0.7, 0.4, 0.15, 0.2].map(T::from_f64);
    Sleigh { m, J, a, b, c }
}

/// The parameters of the snakeboard over any number.
fn snakeboard<T: Scalar>() -> Snakeboard<T> {
    let [m, l, J0, J1] = [1.4, 0.5, 0.09, 0.03].map(T::from_f64);
    Snakeboard { m, l, J0, J1 }
}

/// The parameters of the Veselova system over any number.
fn veselova<T: Scalar>() -> Veselova<T> {
    Veselova { I: [1.3, 0.8, 2.1].map(T::from_f64), c: [0.2, -0.5, 0.9].map(T::from_f64) }
}

/// A state of the sleigh that keeps turning.
fn turning<T: Scalar>() -> SleighState<T> {
    SleighState::from([0.3, 0.0, 0.0, 2.0, 1.0].map(T::from_f64))
}

/// A state of the snakeboard that moves in all of its coordinates.
fn rolling<T: Scalar>() -> SnakeboardState<T> {
    SnakeboardState::from([0.0, 0.0, 0.2, 0.1, 0.4, 1.0, 0.7, 0.3].map(T::from_f64))
}

/// Steps of simulations with angles at hand, beside those that compute every sine.
macro_rules! cases_with_angles {
    ($cases:ident, $number:ty: $($Method:ident::$make:ident),*) => {$(
        let h = <$number as Scalar>::from_f64(0.01);
        let mut add = |system, run| {
            $cases.push(case::<$number>(system, "a simulation", stringify!($Method), false, run));
        };
        add("snakeboard", running(snakeboard::<$number>(), $Method::$make(h), rolling()));
        add("snakeboard, angles at hand", running(snakeboard::<$number>().with_angle_cache(), $Method::$make(h), rolling()));
        add("sleigh, angles at hand", running(sleigh::<$number>().with_angle_cache(), $Method::$make(h), turning()));
    )*};
}

/// The steps of a method as a pure function, and in a simulation.
macro_rules! cases_of {
    ($cases:ident, $number:ty, $is_constant:literal: $($Method:ident::$make:ident),* $(,)?) => {$(
        let h = <$number as Scalar>::from_f64(0.01);
        $cases.push(case::<$number>("sleigh", "a function", stringify!($Method), $is_constant, anywhere(
            sleigh::<$number>(),
            move |system, state| $Method::step(system, Scalar::ZERO, h, state, &Default::default()),
        )));
        $cases.push(case::<$number>("Veselova", "a function", stringify!($Method), $is_constant, anywhere(
            veselova::<$number>(),
            move |system, state| $Method::step(system, Scalar::ZERO, h, state, &()),
        )));
        $cases.push(case::<$number>("sleigh", "a simulation", stringify!($Method), $is_constant, running(
            sleigh::<$number>(), $Method::$make(h), turning(),
        )));
    )*};
}

/// A case.
fn case<T>(
    system: &'static str,
    way: &'static str,
    method: &'static str,
    is_constant: bool,
    run: Box<dyn Fn()>,
) -> Case {
    let number = std::any::type_name::<T>();
    let number = if number.ends_with("Fast<f64>") { "Fast<f64>" } else { number };
    Case { number, system, way, method, is_constant, run }
}

/// All of them.
fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    cases_of!(cases, Fast<f64>, true: Euler::new, Heun::new, Ralston::new, Rk4::new);
    cases_of!(cases, Fast<f64>, true: Bs23::fixed, Dopri5::fixed, Tsit5::fixed, Dop853::fixed, Vern9::fixed);
    cases_of!(cases, f64, false: Rk4::new, Dop853::fixed);
    cases_with_angles!(cases, f64: Rk4::new, Dop853::fixed);
    cases_with_angles!(cases, Fast<f64>: Rk4::new, Dop853::fixed);
    let h = 0.01;
    let implicit = [
        ("ImplicitMidpoint", running(sleigh(), ImplicitMidpoint::new(Fast(h)), turning())),
        ("GaussLegendre4", running(sleigh(), GaussLegendre4::new(Fast(h)), turning())),
        ("GaussLegendre6", running(sleigh(), GaussLegendre6::new(Fast(h)), turning())),
    ];
    for (method, run) in implicit {
        cases.push(case::<Fast<f64>>("sleigh", "a simulation", method, false, run));
    }
    cases
}

fn main() -> ExitCode {
    let evaluate = |_: &[String]| {
        for case in cases() {
            (case.run)();
        }
        Ok(())
    };
    program::main(evaluate, measure)
}

fn measure(_: &[String]) -> Result<(), String> {
    let cases = cases();
    if !callgrind::is_present() {
        println!("valgrind is not there: nothing is counted");
        return Ok(());
    }
    let counts = program::count_each(COUNTED, &[], cases.len() * STEPS)?;
    println!("| numbers | system | step as | method | least | most |");
    println!("|---|---|---|---|--:|--:|");
    let mut varying = Vec::new();
    for (case, counts) in cases.iter().zip(counts.chunks(STEPS)) {
        let Case { number, system, way, method, is_constant, .. } = case;
        let (least, most) =
            counts.iter().fold((u64::MAX, 0), |(least, most), n| (least.min(*n), most.max(*n)));
        println!("| `{number}` | {system} | {way} | `{method}` | {least} | {most} |");
        if *is_constant && least != most {
            varying.push(format!("{method} of the {system} as {way}: {least} to {most}"));
        }
    }
    if varying.is_empty() { Ok(()) } else { Err(format!("not constant: {}", varying.join("; "))) }
}

//! This runtime among its peers: the same right-hand side, the same two runs, instructions and time to
//! reach given accuracies at the end. `cargo run --release` in this directory.

mod bare;
mod others;
mod ours;
mod problem;

use std::hint::black_box;

use nonholonomic::prelude::*;
use nh_work_precision::{Outcome, Study};

use problem::{Problem, Sleigh, Veselova};

/// The accuracies to reach.
const ACCURACIES: [f64; 6] = [1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-12];

fn tolerances() -> impl Iterator<Item = f64> {
    (0..=29).map(|half| 10.0_f64.powf(-f64::from(half) / 2.0))
}

fn steps() -> impl Iterator<Item = u32> {
    (20..=52).map(|quarter| 2.0_f64.powf(f64::from(quarter) / 4.0).round() as u32)
}

fn study<const N: usize, P: Problem<N>>(full: bool) -> Study {
    let names = P::State::names();
    let names: &[&'static str] = names.as_ref();
    let mut study = Study::new(P::NAME, 0.0, P::END);
    study.reference(names.iter().copied().zip(P::REFERENCE));
    macro_rules! add {
        ($library:literal, $method:literal, $settings:expr, |$s:ident, $x:ident, $setting:ident| $run:expr) => {
            for $setting in $settings {
                study.other($library, $method, f64::from($setting), names, move || {
                    let given = P::given();
                    let ($s, $x) = (&black_box(given.0), black_box(given.1));
                    let end: Option<[f64; N]> = $run;
                    end.map(|end| end.to_vec())
                });
            }
        };
    }
    add!("bare loop", "rk4", steps(), |s, x, n| Some(bare::rk4(s, x, n)));
    add!("bare loop", "dop853", tolerances(), |s, x, tol| bare::dop853(s, x, tol));
    add!("nonholonomic", "Rk4", steps(), |s, x, n| ours::run(s, x, Rk4::new(P::END / f64::from(n))));
    add!("nonholonomic", "Bs23", tolerances(), |s, x, tol| ours::run(s, x, Bs23::new().rtol(tol)));
    add!("nonholonomic", "Tsit5", tolerances(), |s, x, tol| ours::run(s, x, Tsit5::new().rtol(tol)));
    add!("nonholonomic", "Dop853", tolerances(), |s, x, tol| ours::run(s, x, Dop853::new().rtol(tol)));
    add!("nonholonomic", "Vern9", tolerances(), |s, x, tol| ours::run(s, x, Vern9::new().rtol(tol)));
    add!("nonholonomic", "Taylor", tolerances(), |s, x, tol| ours::run(s, x, Taylor::new().rtol(tol)));
    if !full {
        return study;
    }
    add!("ode_solvers", "rk4", steps(), |s, x, n| others::ode_solvers_rk4(s, x, n));
    add!("ode_solvers", "dopri5", tolerances(), |s, x, tol| others::ode_solvers_dopri5(s, x, tol));
    add!("ode_solvers", "dop853", tolerances(), |s, x, tol| others::ode_solvers_dop853(s, x, tol));
    add!("differential-eq.", "dopri5", tolerances(), |s, x, tol| others::differential_equations(
        s, x, tol, 0
    ));
    add!("differential-eq.", "dop853", tolerances(), |s, x, tol| others::differential_equations(
        s, x, tol, 1
    ));
    add!("differential-eq.", "rkv988e", tolerances(), |s, x, tol| others::differential_equations(
        s, x, tol, 2
    ));
    add!("diffsol", "tsit45", tolerances(), |s, x, tol| others::diffsol_tsit45(s, x, tol));
    add!("multicalc", "rk4", steps(), |s, x, n| others::multicalc_rk4(s, x, n));
    add!("multicalc", "rk45", tolerances(), |s, x, tol| others::multicalc_rk45(s, x, tol));
    #[cfg(feature = "russell")]
    add!("russell_ode", "dopri8", tolerances(), |s, x, tol| others::russell_dopri8(s, x, tol));
    study
}

/// For each library the cheapest run at each accuracy, by instructions where they are counted: thousand
/// instructions, microseconds, method.
fn show(name: &str, outcomes: &[Outcome]) {
    println!(
        "\n{name}: thousand instructions / microseconds, by the cheapest method, to an error of at most"
    );
    print!("{:<18}", "");
    ACCURACIES.iter().for_each(|accuracy| print!("{accuracy:>26.0e}"));
    println!();
    let mut libraries: Vec<&str> = Vec::new();
    for outcome in outcomes {
        if !libraries.contains(&outcome.variant.as_str()) {
            libraries.push(&outcome.variant);
        }
    }
    for library in libraries {
        print!("{library:<18}");
        for accuracy in ACCURACIES {
            // an error below the accuracy by luck is not one that a user could have asked for: the runs
            // of the same method with finer settings have to reach it too
            let reached = |outcome: &&Outcome| {
                let finer = outcomes.iter().filter(|other| {
                    let same = other.variant == outcome.variant && other.method == outcome.method;
                    let is_steps = outcome.setting >= 1.0;
                    same && if is_steps {
                        other.setting >= outcome.setting
                    } else {
                        other.setting <= outcome.setting
                    }
                });
                outcome.variant == library && finer.take(4).all(|other| other.error <= accuracy)
            };
            let price =
                |outcome: &Outcome| outcome.instructions.map_or(outcome.seconds, |count| count as f64);
            let best = outcomes.iter().filter(reached).min_by(|a, b| price(a).total_cmp(&price(b)));
            match best {
                None => print!("{:>26}", "-"),
                Some(best) => {
                    // valgrind does not know every instruction of the processor
                    let count =
                        best.instructions.map_or("?".to_owned(), |n| format!("{:.0}", n as f64 / 1e3));
                    let cell = format!("{count} / {:.1} {}", best.seconds * 1e6, best.method);
                    print!("{cell:>26}");
                }
            }
        }
        println!();
    }
}

fn main() {
    let full = std::env::args().all(|argument| argument != "--ours");
    for study in [study::<5, Sleigh>(full), study::<6, Veselova>(full)] {
        let name = study.name().to_owned();
        if let Some((outcomes, _)) = study.measure() {
            show(&name, &outcomes);
        }
    }
}

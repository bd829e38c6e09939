//! What becomes of declarations, as text: `cargo run -p nh-stages -- FILE [NAME …]` prints the report of every
//! declaration in a Rust file, or of those that are named, and the errors of those that are refused. Without a
//! file, or with `-`, it reads the standard input. With `--explain` it prints besides which forms competed for each
//! function, and the program of the derivative, step by step; with `--times` only what each expansion costs, in
//! milliseconds on the processor's clock, the lesser of two runs.

use std::io::Read;
use std::time::Instant;

use nh_stages::Declaration;
use nonholonomic_core::limits::{processor_time, timed};
use nonholonomic_core::program::{Cost, schedule};
use nonholonomic_core::system::System;

fn main() -> std::io::Result<()> {
    let (options, arguments): (Vec<String>, Vec<String>) =
        std::env::args().skip(1).partition(|argument| argument.starts_with("--"));
    let is_asked = |wanted: &str| options.iter().any(|option| option == wanted);
    let (is_explained, is_timed) = (is_asked("--explain"), is_asked("--times"));
    let (path, wanted) = arguments.split_first().map_or(("-", &[][..]), |(path, rest)| (path.as_str(), rest));
    let mut source = String::new();
    if path == "-" {
        std::io::stdin().read_to_string(&mut source)?;
    } else {
        source = std::fs::read_to_string(path)?;
    }
    for declaration in nh_stages::declarations(&source) {
        if !wanted.is_empty() && !wanted.contains(&declaration.name) {
            continue;
        }
        if is_timed {
            let least = milliseconds(&declaration).min(milliseconds(&declaration));
            println!("{least:8.1}  {}", declaration.name);
            continue;
        }
        match declaration.system() {
            Ok(system) => {
                println!("{}", system.report);
                if is_explained {
                    println!("{}", explained(&system));
                }
            }
            Err(errors) => println!("{}: refused\n{}\n", declaration.name, errors.join("\n")),
        }
    }
    Ok(())
}

/// What one expansion takes, from tokens to tokens.
fn milliseconds(declaration: &Declaration) -> f64 {
    let start = Instant::now();
    let (tokens, seconds) = timed(|| declaration.expanded());
    let wall = start.elapsed().as_secs_f64();
    drop(tokens);
    1e3 * if processor_time().is_some() { seconds } else { wall }
}

/// The ledger, and the program of the derivative.
fn explained(system: &System) -> String {
    let graph = &system.model.graph;
    let program = schedule(graph, &system.derivative);
    let cost = Cost::of(&program);
    let jacobian = system.jacobian.as_ref().map(|jacobian| Cost::of(&schedule(graph, jacobian)));
    let jacobian = jacobian.map_or_else(String::new, |cost| format!("Jacobian: {cost}\n"));
    format!("Choices\n\n{}\n{jacobian}Derivative: {cost}\n\n{}", system.ledger, program.text(graph))
}

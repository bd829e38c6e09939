//! What becomes of declarations, as text: `cargo run -p nh-stages -- FILE [NAME …]` prints the report of every
//! declaration in a Rust file, or of those that are named, and the errors of those that are refused. Without a
//! file, or with `-`, it reads the standard input; with `--family NAME SIZE …` it takes the members of a growing
//! family, and with `--all [NAME …]` the reference systems, the machines of the benchmark of record and the arms.
//! With `--explain` it prints besides which forms competed for each function, and the program of the derivative,
//! step by step; with `--form="NAME"` one form of the equations alone competes, so that it is proved also where others are
//! cheaper; with `--times` only what each expansion costs: milliseconds on the processor's clock, the lesser of
//! two runs, and counted steps of work.

use std::io::{Error, Read};
use std::time::Instant;

use nh_stages::{Declaration, arms, declarations, families, references, whole_record};
use nonholonomic_core::choose::{Lowered, lowered};
use nonholonomic_core::forms::Registry;
use nonholonomic_core::limits::{processor_time, spent, timed, within_limits};
use nonholonomic_core::mechanics::Procedure;
use nonholonomic_core::program::Cost;
use nonholonomic_core::system::System;

fn main() -> std::io::Result<()> {
    let (options, arguments): (Vec<String>, Vec<String>) =
        std::env::args().skip(1).partition(|argument| argument.starts_with("--"));
    let is_asked = |wanted: &str| options.iter().any(|option| option == wanted);
    let registry = registry(&options)?;
    let chosen = if is_asked("--all") {
        named([references(), whole_record(), arms()].concat(), &arguments)
    } else if is_asked("--family") {
        members(&arguments)?
    } else {
        of_file(&arguments)?
    };
    for (name, declaration) in chosen {
        if is_asked("--times") {
            let [(one, steps), (two, _)] = [(); 2].map(|()| cost(&declaration));
            let refused = if declaration.system().is_ok() { "" } else { ", refused" };
            println!("{:8.1}  {steps:9}  {name}{refused}", one.min(two));
            continue;
        }
        match declaration.system_by(&registry) {
            Ok(system) => {
                println!("{}", system.report);
                if is_asked("--explain") {
                    println!("{}", explained(&system));
                }
            }
            Err(errors) => println!("{name}: refused\n{}\n", errors.join("\n")),
        }
    }
    Ok(())
}

/// All forms, or the one that is asked for.
fn registry(options: &[String]) -> std::io::Result<Registry> {
    let all = Registry::standard();
    let Some(wanted) = options.iter().find_map(|option| option.strip_prefix("--form=")) else {
        return Ok(all);
    };
    let forms: Vec<_> = all.forms().iter().copied().filter(|form| form.name() == wanted).collect();
    let solutions: Vec<_> =
        all.solutions().iter().copied().filter(|solution| solution.name() == wanted).collect();
    if forms.is_empty() && solutions.is_empty() {
        return Err(Error::other(format!("no form is called {wanted:?}; there are {all:?}")));
    }
    Ok(Registry::of(forms).solving(solutions))
}

/// The declarations of a file, or those of them that are named.
fn of_file(arguments: &[String]) -> std::io::Result<Vec<(String, Declaration)>> {
    let (path, wanted) = arguments.split_first().map_or(("-", &[][..]), |(path, rest)| (path.as_str(), rest));
    let mut source = String::new();
    if path == "-" {
        std::io::stdin().read_to_string(&mut source)?;
    } else {
        source = std::fs::read_to_string(path)?;
    }
    let found = declarations(&source).into_iter();
    Ok(named(found.map(|declaration| (declaration.name.clone(), declaration)).collect(), wanted))
}

/// Those with these names, or all if none are given.
fn named(mut found: Vec<(String, Declaration)>, wanted: &[String]) -> Vec<(String, Declaration)> {
    found.retain(|(name, _)| wanted.is_empty() || wanted.contains(name));
    found
}

/// The members of a family at sizes.
fn members(arguments: &[String]) -> std::io::Result<Vec<(String, Declaration)>> {
    let known = |name: &String| families().find(|family| family.name == name);
    let Some((family, sizes)) = arguments.split_first().and_then(|(name, sizes)| Some((known(name)?, sizes)))
    else {
        let names: Vec<&str> = families().map(|family| family.name).collect();
        return Err(Error::other(format!("a family is one of these: {}", names.join("; "))));
    };
    let of_size = |size: &String| {
        let size = size.parse().map_err(|_| Error::other(format!("`{size}` is no size")))?;
        Ok((format!("{}, {size}", family.name), family.member(size)))
    };
    sizes.iter().map(of_size).collect()
}

/// What one expansion takes, from tokens to tokens: milliseconds, and steps of work.
fn cost(declaration: &Declaration) -> (f64, u64) {
    let start = Instant::now();
    let (work, seconds) = timed(|| {
        within_limits(|| {
            drop(declaration.expanded());
            spent()
        })
    });
    let wall = start.elapsed().as_secs_f64();
    let milliseconds = 1e3 * if processor_time().is_some() { seconds } else { wall };
    (milliseconds, work.unwrap_or(u64::MAX))
}

/// The ledger, and the program of the derivative, as they are emitted.
fn explained(system: &System) -> String {
    let graph = &system.model.graph;
    let parameters: Vec<_> = system.model.parameters.iter().map(|parameter| parameter.symbol).collect();
    let emitted = |procedure: &Procedure| lowered(graph, procedure, &parameters, |program| program);
    let Ok(Lowered { program, .. }) = emitted(&system.derivative) else {
        return format!("Choices\n\n{}\nno program of the derivative is proved", system.ledger);
    };
    let of = |name: &str, procedure: Option<&Procedure>| {
        let emitted = procedure.map(emitted).and_then(Result::ok);
        emitted.map_or_else(String::new, |emitted| format!("{name}: {}\n", Cost::of(&emitted.program)))
    };
    let jacobian = of("Jacobian", system.jacobian().as_ref());
    let both = of("Derivative with Jacobian", system.linearized.as_ref());
    let cost = Cost::of(&program);
    format!("Choices\n\n{}\n{both}{jacobian}Derivative: {cost}\n\n{}", system.ledger, program.text(graph))
}

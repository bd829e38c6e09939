//! What the programs of the benchmark share: they call themselves under callgrind, and end with a message.

use std::path::PathBuf;
use std::process::ExitCode;

use crate::callgrind::{self, Counts};

/// The argument with which a program calls itself under callgrind.
const EVALUATE: &str = "--evaluate";

/// Runs a program: `evaluate`, with the arguments that follow, if it has called itself to be counted, and
/// `measure` with all arguments otherwise.
pub fn main(
    evaluate: impl FnOnce(&[String]) -> Result<(), String>,
    measure: impl FnOnce(&[String]) -> Result<(), String>,
) -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let result = match arguments.split_first() {
        Some((first, others)) if first == EVALUATE => evaluate(others),
        _ => measure(&arguments),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

/// Instructions per call of the functions whose name `wanted` accepts, where this program evaluates with these
/// arguments. The profile is left beside it.
///
/// # Errors
/// What went wrong, in words.
pub fn count(profile: &str, arguments: &[&str], wanted: impl Fn(&str) -> bool) -> Result<Counts, String> {
    let program = std::env::current_exe().map_err(|error| error.to_string())?;
    let profile = beside(profile)?;
    let program = program.to_string_lossy();
    let command: Vec<&str> = [&*program, EVALUATE].into_iter().chain(arguments.iter().copied()).collect();
    callgrind::count(&command, &profile, wanted)
}

/// A file beside this program.
///
/// # Errors
/// If it is not known where that is.
pub fn beside(name: &str) -> Result<PathBuf, String> {
    let program = std::env::current_exe().map_err(|error| error.to_string())?;
    Ok(program.with_file_name(name))
}

/// Instructions, where this program evaluates with these arguments, from each beginning of one function to that of
/// another: their names as patterns, and how often they are called in turn.
///
/// # Errors
/// What went wrong, in words.
pub fn count_each(functions: [&str; 2], arguments: &[&str], calls: usize) -> Result<Vec<u64>, String> {
    callgrind::count_each(&[&[EVALUATE], arguments].concat(), functions, calls)
}

/// Says so if the compiler may not use fused multiply-adds.
pub fn warn_without_fma() {
    if !cfg!(target_feature = "fma") {
        println!("compiled without fused multiply-add: set RUSTFLAGS=\"-C target-cpu=x86-64-v3\"\n");
    }
}

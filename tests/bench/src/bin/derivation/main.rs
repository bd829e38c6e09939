//! How long a derivation takes, in process and with the stages of the macro told apart.
//!
//! ```sh
//! cargo run --release -p nh-bench --bin derivation   # optimised
//! cargo run --release -p nh-bench --bin derivation -- --compile   # and families compiled and counted
//! cargo run --release -p nh-bench --bin derivation -- --constants # with constants for the fields
//! cargo run -p nh-bench --bin derivation             # as procedural macros are built by default
//! ```
//!
//! The stages are those of `nh-macros`, compiled into this program: outside a compiler tokens are
//! those of `proc-macro2`'s own.

#![allow(clippy::cast_precision_loss, reason = "sizes are small")]

extern crate proc_macro;

mod compiled;
mod families;
mod growth;
mod stopwatch;

use nh_bench::contest_table::cell;

#[allow(dead_code, unused_imports, reason = "the other macros use more")]
#[path = "../../../../../nh-macros/src/derived_outline.rs"]
mod derived_outline;
#[allow(dead_code, unused_imports, reason = "the other macros use more")]
#[path = "../../../../../nh-macros/src/emit/mod.rs"]
mod emit;
#[allow(dead_code, unused_imports, reason = "the other macros use more")]
#[path = "../../../../../nh-macros/src/expand.rs"]
mod expand;
#[allow(dead_code, unused_imports, reason = "the other macros use more")]
#[path = "../../../../../nh-macros/src/report.rs"]
mod report;
#[allow(dead_code, unused_imports, reason = "the other macros use more")]
#[path = "../../../../../nh-macros/src/resolve/mod.rs"]
mod resolve;
#[allow(dead_code, unused_imports, reason = "the other macros use more")]
#[path = "../../../../../nh-macros/src/suggest.rs"]
mod suggest;
#[allow(dead_code, unused_imports, reason = "the other macros use more")]
#[path = "../../../../../nh-macros/src/syntax/mod.rs"]
mod syntax;

/// The argument with which families are compiled, too.
const COMPILE: &str = "--compile";
/// The argument with which constants stand for the fields.
const CONSTANTS: &str = "--constants";

fn main() {
    let (options, filter): (Vec<String>, Vec<String>) =
        std::env::args().skip(1).partition(|argument| argument.starts_with("--"));
    let is_given = |option: &str| options.iter().any(|given| given == option);
    println!("| ms | parse | derive | emit | whole | operations | instructions | LLVM, ms |");
    println!("|---|--:|--:|--:|--:|--:|--:|--:|");
    let mut points = Vec::new();
    for declaration in families::all() {
        if !filter.is_empty() && !filter.iter().any(|wanted| declaration.name.contains(wanted.as_str())) {
            continue;
        }
        let declaration = if is_given(CONSTANTS) { declaration.with_constants() } else { declaration };
        let times = stopwatch::measure(&declaration);
        let compiled = match declaration.member {
            Some(_) if is_given(COMPILE) => compiled::measure(&declaration),
            _ => compiled::Compiled::default(),
        };
        println!(
            "| {} | {:.2} | {:.2} | {:.2} | {:.2} | {} | {} | {} |",
            declaration.name,
            times.parse,
            times.derive,
            times.emit,
            times.whole(),
            times.operations,
            cell(compiled.instructions, 0),
            cell(compiled.llvm, 0),
        );
        if let Some((family, size)) = declaration.member {
            let measured = [
                Some(times.whole()),
                Some(times.operations as f64),
                compiled.instructions,
                compiled.llvm.filter(|time| *time > 0.0),
            ];
            points.push(growth::Point { family, size, measured });
        }
    }
    growth::print(&points);
}

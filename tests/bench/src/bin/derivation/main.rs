//! How long a derivation takes, in process and with the stages of the macro told apart.
//!
//! ```sh
//! cargo run --release -p nh-bench --bin derivation   # optimised
//! cargo run -p nh-bench --bin derivation             # as procedural macros are built by default
//! ```
//!
//! The stages are those of `nh-macros`, compiled into this program: outside a compiler tokens are
//! those of `proc-macro2`'s own.

extern crate proc_macro;

mod families;
mod stopwatch;

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

fn main() {
    let filter: Vec<String> = std::env::args().skip(1).collect();
    println!("{:<28} {:>9} {:>9} {:>9} {:>9} {:>7}", "ms", "parse", "derive", "emit", "whole", "steps");
    for declaration in families::all() {
        if filter.is_empty() || filter.iter().any(|wanted| declaration.name.contains(wanted.as_str())) {
            let times = stopwatch::measure(&declaration);
            println!(
                "{:<28} {:>9.2} {:>9.2} {:>9.2} {:>9.2} {:>7}",
                declaration.name,
                times.parse,
                times.derive,
                times.emit,
                times.whole(),
                times.operations
            );
        }
    }
}

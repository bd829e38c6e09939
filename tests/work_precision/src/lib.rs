//! Work–precision diagrams: what accuracy costs, for any declared system.
//!
//! A [`Study`] is one motion over a span of time. To it are added [`Variant`]s: the system in `f64` or
//! `f32`, adapted or projected. Each runs with many methods and settings, and every run is compared with a
//! converged reference. Out come a table, a picture, and the cheapest method and setting for each accuracy.
//!
//! ```no_run
//! use nonholonomic::prelude::*;
//! use nh_work_precision::Study;
//!
//! #[nonholonomic(
//!     base { theta, x, y } basis { omega, v, u }
//!     anchor {
//!         der(theta) = omega;
//!         der(x) = v * cos(theta) - u * sin(theta);
//!         der(y) = v * sin(theta) + u * cos(theta);
//!     }
//!     lagrangian { J / 2 * omega^2 + m / 2 * (v^2 + u^2) - m * g * sin(slope) * x }
//!     constraints { u = 0; }
//!     emit { taylor }
//! )]
//! #[derive(Clone, Copy)]
//! struct Skate { m: f64, J: f64, g: f64, slope: f64 }
//!
//! fn main() -> std::io::Result<()> {
//!     let skate = Skate { m: 1.0, J: 0.1, g: 9.81, slope: 0.2 };
//!     let start = SkateState { omega: 1.0, ..SkateState::default() };
//!     let mut study = Study::new("skate", 0.0, 10.0);
//!     study.variant("f64", skate, start).explicit().taylor();
//!     study.finish()
//! }
//! ```
//!
//! Every reference system of the project runs so by
//! `cargo run --release -p nh-work-precision --features catalogue --bin catalogue [name …]`.
//!
//! Run it with `--release`. Instructions are counted where valgrind is installed: the program runs itself
//! under callgrind once, and each run of a method is a profile of its own.

mod instructions;
mod lists_of_runs;
mod picture;
mod study;
mod variant;

pub use study::{Outcome, Study};
pub use variant::Variant;

/// The studies that the command line asks for by their names, or all of them.
///
/// # Errors
/// For a name that is none of these.
pub fn wanted<'a>(known: &[&'a str]) -> std::io::Result<Vec<&'a str>> {
    let asked: Vec<String> = std::env::args().skip(1).collect();
    if let Some(unknown) = asked.iter().find(|name| !known.contains(&name.as_str())) {
        let advice = format!("there is no study {unknown}: choose from {}", known.join(", "));
        return Err(std::io::Error::new(std::io::ErrorKind::InvalidInput, advice));
    }
    Ok(known
        .iter()
        .filter(|name| asked.is_empty() || asked.iter().any(|one| one == *name))
        .copied()
        .collect())
}

//! Random machines, and what their emitted programs lose.
//!
//! [`Machine::of`] makes a declaration from a seed: bodies in the plane that carry each other, with wheels, blades,
//! trailers, arms, sliders and rotors; satellites, tops, balls and discs; Lie algebras; particles under constraints
//! of all kinds. [`Machine::closed`] makes one with constraints on positions: linkages, bodies on pins, particles on
//! surfaces. It is text in the language of the macro, so that whatever reads declarations can be fed with it.
//!
//! [`Motion::of`] is the reference: mathematics (7), (9) and (34), unreduced, from the declared L, anchor, brackets and
//! constraints, those on positions differentiated twice, by automatic differentiation and one pivoted solution in
//! numbers of 71 digits ([`Jet`]). It shares no formula and no code with the derivation.
//!
//! [`Emitted::of`] derives the system as the macro does and runs its program in `f64`; [`losses`] compares. What an
//! ulp of every input changes is no loss: it is measured with the reference, and the rest counts in units of it.
//!
//! The tests run a fixed seed. More, and each machine's declaration:
//!
//! ```sh
//! cargo run --release -p nh-machines -- 1000            # machines; the next argument is the seed
//! cargo run --release -p nh-machines -- show 17         # one declaration, and what it loses at every level
//! cargo run --release -p nh-machines -- 700 2 closed    # those with constraints on positions
//! ```

#![allow(clippy::needless_range_loop, reason = "matrices are indexed as in formulas")]

mod emitted;
mod evaluate;
mod generator;
mod jet;
mod loss;
mod numbers;
mod place;
mod reference;

pub use emitted::{Emitted, LEVELS};
pub use generator::{Machine, Random};
pub use jet::Jet;
pub use loss::{Loss, Worst, losses};
pub use place::{Place, Scale};
pub use reference::Motion;

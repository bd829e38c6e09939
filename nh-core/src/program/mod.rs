//! Straight-line programs: what is emitted, and what the interpreter runs.
//!
//! [`schedule`] takes a procedure through these steps, each of which but the sixth keeps its value:
//!
//! 1. `import`: what the outputs depend on becomes n-ary sums and products with integer exponents.
//!    Where accuracy may go, `angles` are shared by the addition theorems.
//! 2. `factor`: common factors are taken out of sums, and signs out of products.
//! 3. `powers`: denominators are gathered or inverted once.
//! 4. `pairs`: pairs of operands that several sums or products share are computed once.
//! 5. `lower`: binary steps in an order in which every value precedes its uses.
//! 6. `coincide`: steps that have one value become one step. That is a conjecture, and beside what it is one of.
//! 7. `fuse`: sums with products become multiply-adds; `signs`: negations go where they are free.
//!
//! [`accumulated`] differentiates step by step: `opened` leaves the unknowns of linear systems free, `tape` has the
//! partial derivatives of all steps, `vertex_order` says in which order they are multiplied.
//!
//! Constants become numbers before 2 or after it (`fold`), or at last (`lower`), whichever is cheapest. What numbers alone
//! give only with rounding errors becomes a number when it is printed (`known_numbers`).
//!
//! [`at_rest`] gives derivatives the values that they tend to where lengths vanish by which they divide
//! (`vanishing_lengths`), as `orders_at_rest` proves it.
//!
//! [`corrected`] makes a program carry its rounding errors along; [`error_growth`] compares programs by
//! theirs, and [`units_lost`] finds terms that cancel identically. [`Recurrences`] extend a program from numbers to power series in the time.

mod accumulate;
mod angles;
mod coincide;
mod correct;
mod cost;
mod denominators;
mod factor;
mod fold;
mod fuse;
mod import;
mod interpret;
mod known_numbers;
mod lower;
mod measured_rounding;
mod nary;
mod opened;
mod orders_at_rest;
mod other_sides;
mod pairs;
#[cfg(test)]
mod program_tests;
mod random_points;
mod rounding;
mod rule;
mod scales;
mod schedule;
mod signs;
mod split;
mod step;
mod tape;
mod taylor;
mod text;
mod vanishing_lengths;
mod vertex_order;
mod where_defined;

pub use accumulate::{Systems, Wanted, accumulated};
pub use correct::corrected;
pub use cost::{Cost, order};
pub use interpret::{Arithmetic, interpret, interpret_in};
pub use measured_rounding::{error_growth_apart_in_runs, error_growth_in_runs};
pub use orders_at_rest::Limits;
pub use rounding::{error_growth, error_growth_apart, reading_in_vain, units_lost};
pub use rule::{Factor, Inner, Rule};
pub use schedule::{Scheduled, schedule, schedule_grouping, schedule_roughly, schedules};
pub use split::{Split, split};
pub use step::{Program, Step, Value};
pub use taylor::{Recurrences, Variation};
pub use vanishing_lengths::{AtRest, at_rest};

//! Units as a proof: sums, equations and arguments of functions are homogeneous.
//!
//! Every name has a dimension, a vector of rational exponents of kg, m, s, A, K, mol, cd. What is declared of some
//! names, and every condition that the declaration contains, is a linear equation over ℚ in the exponents of all
//! names (Kennedy 1996). Equations are taken up one after the other, so that whatever contradicts those before it
//! does so together with a set of them of which none can be left out: that set is shown.

mod consistency;
mod dimension;
mod elimination;
mod form;
mod inferred;
mod reading;
mod wording;

pub use consistency::{Condition, Conflict, Side, USUAL, infer};
pub use dimension::{Dimension, Refused, UNITS, raised};
pub use form::{Form, Unknown};
pub(crate) use inferred::lines;
pub use inferred::{Inferred, Quantity, Unit};
pub use reading::{Kind, Reading};
pub use wording::IN_UNITS;

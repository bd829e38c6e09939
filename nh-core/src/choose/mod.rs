//! Choosing among forms: they are compared, proved, and recorded here.

mod conditions;
mod ledger;
pub(crate) mod limits;
mod proof;
mod reference;
mod selection;
mod zero_set;

pub(crate) use conditions::Regular;
pub use ledger::{Contender, Decision, Fate, Ledger, Proof};
pub(crate) use proof::{Claim, prove, prove_equal};
pub(crate) use reference::{Called, Reference};
pub(crate) use selection::{Entry, admitted, cheapest, fate};

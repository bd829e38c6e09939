//! Choosing among forms: they are compared, proved, and recorded here.

mod conditions;
mod derived;
mod divisions;
mod ground;
mod ledger;
mod lowered;
mod lowering;
mod pivots;
mod proof;
mod reference;
mod selection;
pub(crate) mod sizes;
mod zero_set;

pub(crate) use conditions::Regular;
pub(crate) use derived::{
    Allowed, AlmostPoissonForm, AppliedForce, BracketForm, Derived as DerivedFunction, GyroscopicForm,
    Motion, PowerForm, SplittingForm, ValuesForm, VelocityNames, prove_derived, prove_product,
};
pub use ledger::{Contender, Decision, Fate, Ledger, Proof};
pub use lowered::{Unproved, prove_program, prove_split};
pub use lowering::{DEFECT, Lowered, Lowering, REFUTED, lowered};
pub(crate) use proof::{Claim, Defect, prove, prove_equal};
pub(crate) use reference::{Given, Reference};
pub(crate) use selection::{Entry, admitted, cheapest, fate, ranking, rate, rate_derivatives};

//! Explicit Runge–Kutta methods: one table each.

mod bs23;
mod dop853;
mod dopri5;
mod low_order;
#[cfg(test)]
mod order_conditions;
mod scheme;
mod tableau;
mod tsit5;
mod vern9;

pub use bs23::BogackiShampine3;
pub use dop853::DormandPrince8;
pub use dopri5::DormandPrince5;
pub use low_order::{Euler1, Heun2, Kutta4, Ralston3};
pub(crate) use scheme::stages_of;
pub use tableau::{Pair, Tableau};
pub use tsit5::Tsitouras5;
pub use vern9::Verner9;

//! What the documentation of the runtime promises, as laws over every method in double and in single precision.

#![allow(clippy::float_cmp)] // exact times are meant
#![allow(clippy::needless_pass_by_value)] // one macro calls all laws, with methods as values

mod closing;
mod corrections;
mod domains;
mod ends;
mod events;
mod extremes;
mod filters;
mod leaving;
mod limits;
mod own_systems;
mod receding;
mod refused;
mod rounded_events;
mod starts;
mod systems;
mod time;

//! The integrators on small systems written by hand.

// exact values are meant
#![allow(clippy::float_cmp)]

mod acting_events;
mod api;
mod conservation;
mod ensembles;
mod errors;
mod events;
mod implicit;
// they are kept in a `Vec`, which needs the standard library
#[cfg(feature = "std")]
mod kept_motions;
mod landing;
mod lanes;
mod made_of_others;
mod orders;
mod projected;
mod step_control;
mod systems;
mod transition;

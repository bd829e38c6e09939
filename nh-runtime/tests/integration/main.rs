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
mod kept_motions;
mod landing;
mod lanes;
mod made_of_others;
mod orders;
mod projected;
mod step_control;
mod systems;
mod transition;

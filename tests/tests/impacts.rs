//! `impacts`: jumps of velocities, mathematics (50), against what is known of them in closed form.

// bits and exact zeros are meant
#![allow(clippy::float_cmp)]

#[path = "impacts/algebroids.rs"]
mod algebroids;
#[path = "impacts/ball.rs"]
mod ball;
#[path = "impacts/contacts.rs"]
mod contacts;
#[path = "impacts/formulations.rs"]
mod formulations;
#[path = "impacts/several_items.rs"]
mod several_items;

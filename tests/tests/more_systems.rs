//! Systems beyond the catalogue, most of them declared in more than one way: accelerations, energies,
//! multipliers and short trajectories agree with numbers that nothing in this project had a part in.
//!
//! How the numbers were computed: L, the constraints and the forces were written in the coordinates
//! that the head of each file lists, often redundant ones (rotation matrices, Cartesian positions of
//! every body) with their holonomic equations; the constraints were differentiated; one linear solve
//! at 50 digits gave accelerations and multipliers; what a declaration has as its state is a function
//! of coordinates and velocities there, and its rate follows by the chain rule. No quasi-velocity,
//! bracket or reduced Lagrangian occurs. A trajectory is an extrapolated integration of the same
//! equations (Gragg, Bulirsch, Stoer), done with two step sizes that agree to ten digits and more.

#[path = "more_systems/carriages.rs"]
mod carriages;
#[path = "more_systems/groups.rs"]
mod groups;
#[path = "more_systems/particles.rs"]
mod particles;
#[path = "more_systems/reference.rs"]
mod reference;
#[path = "more_systems/rolling.rs"]
mod rolling;
#[path = "more_systems/time.rs"]
mod time;
#[path = "more_systems/trailers.rs"]
mod trailers;
#[path = "more_systems/wheels.rs"]
mod wheels;

use reference::{check, check_with_multipliers};

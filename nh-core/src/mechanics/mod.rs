//! Lagrangian mechanics on a Lie algebroid.

mod adapted;
mod complete_lift;
mod cyclic;
mod definiteness;
mod energy;
mod euler_lagrange;
mod flow;
mod hamiltonian;
mod jacobian;
mod momentum;
mod moving_energy;
mod planar_points;
mod procedure;
mod projected;
mod restricted;
mod symmetric_solve;
mod velocity_forms;
mod volume;
mod wheel_frames;

pub use adapted::{ReducedEquations, reaction_forces, reduced_equations};
pub use complete_lift::complete_lift;
pub use cyclic::{cyclic_coordinates, translation};
pub use definiteness::definiteness;
pub use energy::energy;
pub use euler_lagrange::{ForceBalance, LagrangianSystem};
pub use flow::Flow;
pub use hamiltonian::{HamiltonianSide, NoInverse, NonholonomicBracket, hamiltonian_side};
pub use jacobian::{NotDifferentiable, divergence, jacobian};
pub use momentum::Momentum;
pub use moving_energy::moving_energy_section;
pub use procedure::{Definition, Procedure};
pub use projected::{SaddleEquations, saddle_equations};
pub use symmetric_solve::{Definiteness, Factorisation, solve_symmetric, uncoupled};
pub use velocity_forms::{equations_by_velocity_forms, equations_in_wheel_frames};
pub use volume::{Density, ModularSection, Volume, VolumeSetting, invariant_volume};

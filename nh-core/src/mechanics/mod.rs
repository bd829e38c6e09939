//! Lagrangian mechanics on a Lie algebroid.

mod adapted;
mod complete_lift;
mod cyclic;
mod definiteness;
mod elimination_order;
mod energy;
mod euler_lagrange;
mod exterior_derivative;
mod factorisation;
mod flow;
mod gibbs_appell;
mod hamiltonian;
mod jacobian;
mod kinetic_metric;
mod ldl;
mod lone_constraint;
mod momentum;
mod moving_energy;
mod nonholonomic_connection;
mod orthogonal_constraints;
mod pair;
mod partial_velocities;
mod planar_points;
mod procedure;
mod projected;
mod rank_one;
mod restricted;
mod splitting;
mod symmetric_solve;
mod velocity_forms;
mod volume;
mod wheel_frames;

pub use adapted::{ReducedEquations, equations_by_momenta, reaction_forces, reduced_equations};
pub use complete_lift::complete_lift;
pub use cyclic::{cyclic_coordinates, translation, translations};
pub use definiteness::{DefiniteSets, definiteness, keeps_its_sign};
pub use energy::energy;
pub use euler_lagrange::{ForceBalance, LagrangianSystem};
pub use factorisation::Factorisation;
pub use flow::Flow;
pub use gibbs_appell::GibbsAppell;
pub use hamiltonian::{Drift, HamiltonianSide, NoInverse, NonholonomicBracket, hamiltonian_side};
pub use jacobian::{NotDifferentiable, derivative_along, divergence, jacobian};
pub use kinetic_metric::kinetic_metric;
pub use momentum::Momentum;
pub use moving_energy::moving_energy_section;
pub use nonholonomic_connection::NonholonomicConnection;
pub(crate) use procedure::Solved;
pub use procedure::{Definition, Procedure};
pub use projected::{SaddleEquations, saddle_equations};
pub use splitting::{Chaplygin, NotSplit, Splitting};
pub use symmetric_solve::{Definiteness, solve_symmetric, uncoupled};
pub use velocity_forms::{
    equations_by_partial_velocities, equations_by_velocity_forms, equations_in_wheel_frames,
};
pub use volume::{Density, ModularSection, Volume, VolumeSetting, invariant_volume};

//! Symbolic geometry and mechanics of nonholonomic Lagrangian systems on Lie algebroids.
//!
//! The engine behind `#[nonholonomic]`: it knows expressions, anchors, brackets and constraint
//! distributions, and nothing of tokens. Formulas are cited by the tags
//! CLMM (Cortés, de León, Marrero, Martínez, *Nonholonomic Lagrangian systems on Lie algebroids*),
//! CNS (Cariñena, Nunes da Costa, Santos, *Quasi-coordinates from the point of view of Lie
//! algebroid structures*), CM (Crampin, Mestdag, *Reduction of invariant constrained systems using
//! anholonomic frames*) and M (Marrero, *Nonholonomic mechanics: a Lie algebroid perspective*).
//!
//! In them, a velocity y moves the base by the anchor ρ, sections have the bracket C, and the motion with constraints
//! Φ y + b = 0 is that of Lagrange and d'Alembert, with W and p of the Lagrangian:
//!
//! ```math
//! \begin{gathered}
//! \dot x^i = \rho^i_\alpha y^\alpha, \qquad [e_\alpha, e_\beta] = C^\gamma_{\alpha\beta} e_\gamma, \\
//! W_{\alpha\beta}\,\dot y^\beta + \rho^i_\beta y^\beta \partial_i p_\alpha + C^\gamma_{\alpha\beta} y^\beta p_\gamma
//!   - \rho^i_\alpha \partial_i L + \partial_t p_\alpha = \Upsilon_\alpha + \lambda_A \Phi^A_\alpha
//! \end{gathered}
//! ```
#![warn(missing_debug_implementations)]

pub mod algebra;
pub mod check;
pub mod choose;
pub mod compile;
pub mod count;
mod findings;
pub mod forms;
pub mod functions;
pub mod geometry;
pub mod id;
mod id_map;
pub mod limits;
pub mod mechanics;
pub mod model;
pub mod phase_space;
pub mod program;
pub mod reduction;
pub mod report;
pub mod system;
pub mod units;
pub mod violation;

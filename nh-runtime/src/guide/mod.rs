//! A guide from the first model to a control loop; every snippet is compiled and run with the tests.
//!
//! | I want to … | page |
//! |---|---|
//! | declare my first machine and watch it move | [`first_model`] |
//! | know when to write `base`, `basis`, `anchor`, `velocities` or none of them | [`coordinates_and_velocities`] |
//! | say that a wheel rolls, a blade does not slip, a joint is prescribed | [`constraints`] |
//! | close a loop of links, stand on the ground, start from a rough guess | [`closed_loops`] |
//! | let it bounce, land, come to a stop | [`impacts`] |
//! | let it go from rolling to flying and back | [`modes`] |
//! | declare it by where its bodies are | [`geometry`] |
//! | see all sections and words at a glance | [`language`] |
//! | drive it, brake it, read a sensor | [`forces_and_inputs`] |
//! | have motors with currents, filters, commanded rates | [`auxiliary_states`] |
//! | be told of a wrong formula by its units | [`units`] |
//! | understand what was derived, and what it costs | [`reading_a_report`] |
//! | see the formulas behind it | [`the_equations`] |
//! | choose a method of integration; keep a whole motion | [`which_integrator`] |
//! | stabilise it, estimate its state, plan ahead | [`control_loops`] |
//! | find steady motions, and the linear model about them | [`steady_motions`] |
//! | have gradients for an optimiser, sensitivities for identification | [`derivatives_of_motions`] |
//! | run thousands of them at once | [`many_at_once`] |
//! | put it on a microcontroller | [`microcontrollers`] |
//! | share one model between plant, controller and estimator | [`one_model_many_uses`] |
//! | use it with other crates and languages | [`interoperation`] |
//! | get past an error | [`troubleshooting`] |
//! | know what it does not do | [`limits`] |

#[doc = include_str!("first_model.md")]
pub mod first_model {}

#[doc = include_str!("coordinates_and_velocities.md")]
pub mod coordinates_and_velocities {}

#[doc = include_str!("constraints.md")]
pub mod constraints {}

#[doc = include_str!("closed_loops.md")]
pub mod closed_loops {}

#[doc = include_str!("impacts.md")]
pub mod impacts {}

#[doc = include_str!("modes.md")]
pub mod modes {}

#[doc = include_str!("geometry.md")]
pub mod geometry {}

#[doc = include_str!("language.md")]
pub mod language {}

#[doc = include_str!("forces_and_inputs.md")]
pub mod forces_and_inputs {}

#[doc = include_str!("auxiliary_states.md")]
pub mod auxiliary_states {}

#[doc = include_str!("units.md")]
pub mod units {}

#[doc = include_str!("reading_a_report.md")]
pub mod reading_a_report {}

#[doc = include_str!("the_equations.md")]
pub mod the_equations {}

#[doc = include_str!("which_integrator.md")]
pub mod which_integrator {}

#[doc = include_str!("steady_motions.md")]
pub mod steady_motions {}

#[doc = include_str!("control_loops.md")]
pub mod control_loops {}

#[doc = include_str!("derivatives_of_motions.md")]
pub mod derivatives_of_motions {}

#[doc = include_str!("many_at_once.md")]
pub mod many_at_once {}

#[doc = include_str!("microcontrollers.md")]
pub mod microcontrollers {}

#[doc = include_str!("one_model_many_uses.md")]
pub mod one_model_many_uses {}

#[doc = include_str!("interoperation.md")]
pub mod interoperation {}

#[doc = include_str!("troubleshooting.md")]
pub mod troubleshooting {}

#[doc = include_str!("limits.md")]
pub mod limits {}

//! Taylor series of solutions: coefficients, and the method that sums them.

mod coefficients;
mod method;
mod systems;
mod trajectories;

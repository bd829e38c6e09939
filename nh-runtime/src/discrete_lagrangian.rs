//! Systems with a Lagrangian on TQ and position constraints, for methods that discretise the action.

use crate::{Dynamics, VecOf};

/// A system on TQ that moves by its Lagrangian and position constraints alone: declared with `emit { rattle }`,
/// which is refused where forces act, where constraints are on velocities, and where L depends on the time.
///
/// The state is (q, q̇), n of each. All functions are on the whole of TQ, also where the constraints do not hold.
///
/// ```
/// use nonholonomic::prelude::*;
/// use nonholonomic::{D, DiscreteLagrangian};
///
/// /// A point of mass 1 that slides on the unit circle under gravity.
/// #[derive(Clone, Copy)]
/// struct Bead { gravity: f64 }
/// #[derive(Clone, Copy)]
/// struct Place { x: f64, y: f64, x_dot: f64, y_dot: f64 }
/// impl State for Place {
///     type Scalar = f64;
///     type Dim = D<4>;
///     fn to_array(&self) -> [f64; 4] { [self.x, self.y, self.x_dot, self.y_dot] }
///     fn from_array([x, y, x_dot, y_dot]: [f64; 4]) -> Self { Self { x, y, x_dot, y_dot } }
///     fn names() -> [&'static str; 4] { ["x", "y", "x_dot", "y_dot"] }
/// }
/// impl Dynamics for Bead {
///     type State = Place;
///     type Input = ();
///     fn derivative(&self, _t: f64, s: &Place, (): &()) -> Place {
///         let Place { x, y, x_dot, y_dot } = *s;
///         let pull = (x_dot * x_dot + y_dot * y_dot - self.gravity * y) / (x * x + y * y);
///         Place { x: x_dot, y: y_dot, x_dot: -pull * x, y_dot: -pull * y - self.gravity }
///     }
/// }
/// impl DiscreteLagrangian for Bead {
///     fn lagrangian_slopes(&self, s: &Place) -> [f64; 4] { [0.0, -self.gravity, s.x_dot, s.y_dot] }
///     fn position_constraints(&self, s: &Place) -> [f64; 4] { [(s.x * s.x + s.y * s.y - 1.0) / 2.0, 0.0, 0.0, 0.0] }
///     fn constrained(&self, s: &Place, [r_x, r_y, c, _]: &[f64; 4]) -> [f64; 4] {
///         let pull = (c - (s.x * r_x + s.y * r_y)) / (s.x * s.x + s.y * s.y);
///         [r_x + pull * s.x, r_y + pull * s.y, 0.0, 0.0]
///     }
/// }
/// impl Energy for Bead {
///     fn energy(&self, _t: f64, s: &Place) -> f64 { (s.x_dot * s.x_dot + s.y_dot * s.y_dot) / 2.0 + self.gravity * s.y }
/// }
///
/// # fn main() -> Result<(), IntegrationError> {
/// let bead = Bead { gravity: 9.81 };
/// let start = Place { x: 1.0, y: 0.0, x_dot: 0.0, y_dot: 0.0 };
/// let mut sim = Integrator::new(bead, Rattle::new(0.01), 0.0, start);
/// let mut off = 0.0_f64;
/// for second in 1..=1000 {
///     sim.advance_to(f64::from(second))?;
///     off = off.max(bead.energy(0.0, &sim.state()).abs());
/// }
/// assert!(off < 1e-2 && (sim.state().x.hypot(sim.state().y) - 1.0).abs() < 1e-14);
/// # Ok(())
/// # }
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no discrete Lagrangian",
    label = "needs the trait `DiscreteLagrangian`",
    note = "add `emit {{ rattle }}` to its declaration, or implement `DiscreteLagrangian` by hand"
)]
pub trait DiscreteLagrangian: Dynamics {
    /// ∂L/∂q, then ∂L/∂q̇.
    fn lagrangian_slopes(&self, state: &Self::State) -> VecOf<Self>;

    /// g(q), zero where the constraints hold, in the first components.
    fn position_constraints(&self, state: &Self::State) -> VecOf<Self>;

    /// a, in the first n components, with W a − r in the span of the rows of G = ∂g and G a = c, at the place of the state:
    /// W = ∂²L/∂q̇², r the first n components of `given`, c those behind.
    fn constrained(&self, state: &Self::State, given: &VecOf<Self>) -> VecOf<Self>;
}

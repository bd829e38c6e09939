//! Impacts: velocities that jump while the place stands still.
//!
//! An [`Impact`] tells of rows Ψ y + b at a state: bilateral ones, which hold after the jump (a blade that is set down,
//! a ball that begins to roll), and unilateral ones with a gap h ≥ 0, of which those that are closed push and never
//! pull. Where there are unilateral rows, the bilateral ones act with them: a wheel that touches the ground begins to
//! roll, and one above it does not. [`strike`] makes the jump, mathematics (50); [`advance_with_impacts`] carries an integration from jump to
//! jump, and ends it with [`End::Accumulated`] where the jumps come without end, as those of a ball that comes to rest.

mod complementarity;
mod jumps;
mod no_jump;
mod run;

pub use jumps::{Struck, strike};
pub use no_jump::ImpactError;
pub use run::{End, advance_with_impacts};

use crate::{Dynamics, Scalar, ScalarOf, VecOf};

/// What an impact knows of itself at a state: for each row A, with N = Ψ B and C the masses on the constraints.
#[derive(Clone, Copy, Debug)]
pub struct Rows<T, V, const R: usize> {
    /// s = Ψ y + b, the rate of the gap; for a bilateral row, what has to vanish.
    pub approach: [T; R],
    /// C⁻¹ Nᵀ: the change of the state by a unit of the row's impulse, zero in the coordinates.
    pub response: [V; R],
    /// K = N C⁻¹ Nᵀ, symmetric and positive definite where the rows are independent.
    pub mobility: [[T; R]; R],
}

/// A kind of impact that a system may undergo, with `R` rows, six at most.
///
/// ```
/// use nonholonomic::impacts::{End, Impact, Rows, advance_with_impacts};
/// use nonholonomic::prelude::*;
/// # use nonholonomic::D;
/// # use core::ops::ControlFlow;
/// # #[derive(Clone, Copy, Debug)] struct Ball;
/// # #[derive(Clone, Copy, Debug)] struct BallState { height: f64, speed: f64 }
/// # impl State for BallState {
/// #     type Scalar = f64;
/// #     type Dim = D<2>;
/// #     fn to_array(&self) -> [f64; 2] { [self.height, self.speed] }
/// #     fn from_array([height, speed]: [f64; 2]) -> Self { Self { height, speed } }
/// #     fn names() -> [&'static str; 2] { ["height", "speed"] }
/// # }
/// # impl Dynamics for Ball {
/// #     type State = BallState;
/// #     type Input = ();
/// #     fn derivative(&self, _t: f64, x: &BallState, (): &()) -> BallState {
/// #         BallState { height: x.speed, speed: -9.81 }
/// #     }
/// # }
///
/// /// The ground under a ball of mass 1, from which it bounces.
/// struct Ground { restitution: f64 }
///
/// impl Impact<Ball, 1> for Ground {
///     fn names(&self) -> [&'static str; 1] { ["ground"] }
///     fn restitution(&self, _ball: &Ball) -> f64 { self.restitution }
///     fn gaps(&self, _ball: &Ball, _t: f64, x: &BallState) -> [Option<f64>; 1] { [Some(x.height)] }
///     fn rows(&self, _ball: &Ball, _t: f64, x: &BallState) -> Rows<f64, [f64; 2], 1> {
///         Rows { approach: [x.speed], response: [[0.0, 1.0]], mobility: [[1.0]] }
///     }
/// }
///
/// # fn main() -> Result<(), Box<dyn core::error::Error>> {
/// let start = BallState { height: 1.0, speed: 0.0 };
/// let mut sim = Integrator::new(Ball, Dopri5::new(), 0.0, start);
/// let mut bounces = 0;
/// let end = advance_with_impacts(&mut sim, 10.0, &Ground { restitution: 0.5 }, 1e-9, |_| {
///     bounces += 1;
///     ControlFlow::Continue(())
/// })?;
/// // it comes to rest: all bounces are over after three times the first fall
/// assert!(matches!(end, End::Accumulated { row: 0, .. }) && bounces > 20);
/// assert!((sim.time() - 3.0 * (2.0_f64 / 9.81).sqrt()).abs() < 1e-6);
/// assert!(sim.state().height.abs() < 1e-9 && sim.state().speed == 0.0);
/// # Ok(())
/// # }
/// ```
pub trait Impact<S: Dynamics, const R: usize> {
    /// What the rows are called, for messages.
    fn names(&self) -> [&'static str; R];

    /// The coefficient of restitution e of all rows, from 0 (they land) to 1 (no energy is lost).
    fn restitution(&self, system: &S) -> ScalarOf<S>;

    /// Which rows the restitution acts on: it acts on gaps, and not on what has to vanish of the velocities. All, unless
    /// said otherwise.
    fn bounces(&self) -> [bool; R] {
        [true; R]
    }

    /// Whether the rows and the constraints of the system vanish with the velocities: nothing moves by itself, as a turning
    /// table does. Then a jump says what energy it loses; nothing is said of it unless this is.
    fn is_homogeneous(&self) -> bool {
        false
    }

    /// The size of the terms of which each gap is the difference: a gap that is within the root of the machine's epsilon
    /// of that is closed. 0 unless said otherwise.
    fn sizes(&self, system: &S, t: ScalarOf<S>, state: &S::State) -> [ScalarOf<S>; R] {
        _ = (system, t, state);
        [ScalarOf::<S>::ZERO; R]
    }

    /// The gap of each unilateral row, positive outside; `None` for a bilateral row.
    fn gaps(&self, system: &S, t: ScalarOf<S>, state: &S::State) -> [Option<ScalarOf<S>>; R];

    /// The rows at a state.
    fn rows(&self, system: &S, t: ScalarOf<S>, state: &S::State) -> Rows<ScalarOf<S>, VecOf<S>, R>;
}

/// The rows that are tried in all combinations.
const MOST_ROWS: usize = 6;

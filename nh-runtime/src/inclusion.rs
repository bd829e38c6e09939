//! Modes: a system that is another one with further constraints.

use core::error::Error;
use core::fmt::{self, Display, Formatter};

use crate::{Constrained, Dynamics, Real, Scalar, ScalarOf, State};

/// A mode of a larger system: what rolls is a mode of what flies.
///
/// `morphism!` writes the implementation where the states of `W` hold those of the mode: it was proved that the mode is
/// `W` with further constraints. Motions of the mode are not motions of `W`; from one to the other leads
/// [`include`](Self::include), and back [`restrict`](Self::restrict), where the further constraints hold.
pub trait Inclusion<W: Dynamics>: Dynamics {
    /// What was proved, and the map, as text.
    const REPORT: &'static str;

    /// The larger system, with the parameters that belong to those of this one.
    fn whole(&self) -> W;

    /// The state of the larger system.
    fn include(&self, t: ScalarOf<Self>, state: &Self::State) -> W::State;

    /// The state of this mode, where the larger system is in one.
    ///
    /// # Errors
    /// [`NotInMode`] where the further constraints do not hold: to the root of the machine's epsilon, coordinates against
    /// the largest coordinate, velocities against the largest velocity and each auxiliary state against itself. A mode that
    /// has equations for its state is [projected](Constrained::project) to them: off is what that moves by more. Where it
    /// does not get there, residuals are no numbers.
    fn restrict(&self, t: ScalarOf<Self>, state: &W::State) -> Result<Self::State, NotInMode<W::State>>
    where
        ScalarOf<W>: Real;
}

/// A state that is not in a mode.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct NotInMode<X> {
    /// The variable that is off by most.
    pub variable: &'static str,
    /// By how much; no number where it has infinite or no value, or where the mode does not get there.
    pub residual: f64,
    /// By how much each variable is off.
    pub residuals: X,
}

impl<X> Display for NotInMode<X> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "the state is not in this mode: `{}` is off by {:?}; make the jump of an impact first, or stay in the larger \
             system",
            self.variable, self.residual
        )
    }
}

impl<X: fmt::Debug> Error for NotInMode<X> {}

/// A state of a mode, moved to where the mode's equations for its state hold; no numbers where that fails.
pub fn returned<S: Constrained>(mode: &S, t: ScalarOf<S>, mut own: S::State) -> S::State {
    if mode.project(t, &mut own).is_ok() {
        return own;
    }
    let mut components = own.to_array();
    components.as_mut().fill(ScalarOf::<S>::from_f64(f64::NAN));
    S::State::from_array(components)
}

/// `own`, if it is what `state` is made of: `included` is what it gives. The components are so many coordinates, so many
/// velocities, and then auxiliary states, which have units of their own.
///
/// # Errors
/// [`NotInMode`].
pub fn restricted<X, W: State>(
    own: X,
    included: &W,
    state: &W,
    [coordinates, velocities]: [usize; 2],
) -> Result<X, NotInMode<W>>
where
    W::Scalar: Real,
{
    let (zero, tolerance) = (W::Scalar::ZERO, W::Scalar::EPSILON.sqrt());
    let (given, wanted) = (state.to_array(), included.to_array());
    let mut residuals = given;
    residuals.as_mut().iter_mut().zip(wanted.as_ref()).for_each(|(residual, wanted)| *residual -= *wanted);
    let both = given.as_ref().iter().zip(wanted.as_ref());
    let sizes = both.map(|(a, b)| a.abs().max(b.abs()));
    let largest = |from: usize, count: usize| sizes.clone().skip(from).take(count).fold(zero, W::Scalar::max);
    let scales = [largest(0, coordinates), largest(coordinates, velocities)];
    // what is no number is off, and no measure of others
    let broken = residuals.as_ref().iter().position(|residual| !residual.is_finite());
    let mut worst = broken.map(|index| (index, zero));
    for (index, residual) in residuals.as_ref().iter().enumerate().filter(|_| broken.is_none()) {
        let [of_coordinates, of_velocities] = scales;
        let scale = if index < coordinates {
            of_coordinates
        } else if index < coordinates + velocities {
            of_velocities
        } else {
            largest(index, 1)
        };
        let share = residual.abs() / scale;
        if residual.abs() > tolerance * scale && worst.is_none_or(|(_, known)| share > known) {
            worst = Some((index, share));
        }
    }
    let Some((index, _)) = worst else { return Ok(own) };
    let residual = residuals.as_ref().get(index).map_or(f64::NAN, |residual| residual.to_f64());
    let variable = W::names().as_ref().get(index).copied().unwrap_or_default();
    Err(NotInMode { variable, residual, residuals: W::from_array(residuals) })
}

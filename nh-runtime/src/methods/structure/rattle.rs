//! The variational method with position constraints.

use super::blur::{PART, PERIODS, add_changes, apart, blur, few, signed};
use crate::arrays::{Array, all_finite, difference, displaced, nought};
use crate::methods::implicit::newton::{Settling, exceeds, falls, is_first_term, refusal, size, sizes};
use crate::methods::plateau::{Plateau, largest_of};
use crate::methods::{Arrival, Fixed, OneStep, Start, Symmetric};
use crate::{
    Dim, DimOf, DiscreteLagrangian, IntegrationError, Real, Scalar, ScalarOf, State, Statistics, VecOf,
};

/// The method of SHAKE and RATTLE for any Lagrangian of TQ that is quadratic in the velocities, with fixed steps, of order 2,
/// mathematics (62): the action of a step is h/2 (L(q₀, u) + L(q₁, u)) with u = (q₁ − q₀)/h, and multipliers at both ends
/// keep the positions and the velocities on the constraints (Andersen, J. Comput. Phys. 52 (1983); Jay, SIAM J. Numer.
/// Anal. 33 (1996); Marsden, West, Acta Numerica 10 (2001), 3.5).
///
/// Symplectic on the constraint manifold and symmetric, so that the energy of any motion stays in a band of the square of
/// the step: that of a crank that goes round as well, which a symmetric method alone lets drift. Momenta of symmetries that
/// are linear in q, as rotations are in x and y, are kept to round-off. Where the masses are constant only the multipliers
/// are searched for; else the velocity with them, by iterations with the masses at the start, each of which gains a factor
/// of h times the rate at which these change. Steps have to be shorter than two radians of the fastest oscillation.
///
/// For systems declared with `emit { rattle }`; [`Statistics::evaluations`] counts the slopes of L.
pub type Rattle<T> = Fixed<DiscreteAction<T>, T>;

/// A step of [`Rattle`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiscreteAction<T> {
    tolerance: T,
}

impl<T> Symmetric for DiscreteAction<T> {}

impl<T: Real> Rattle<T> {
    /// The method with steps of length `step`, which has to be positive and finite.
    #[must_use]
    pub fn new(step: T) -> Self {
        Self { step, scheme: DiscreteAction { tolerance: T::from_f64(1e3) * T::EPSILON } }
    }
}

/// The iterations after which a solution is given up.
const MOST_ITERATIONS: u32 = 50;

impl<T: Real, S: DiscreteLagrangian> OneStep<S> for DiscreteAction<T>
where
    S::State: State<Scalar = T>,
{
    /// u − v₀ of the last step, from which the next search starts.
    type Work = VecOf<S>;
    dense_by_cubic!();

    fn work(&self) -> VecOf<S> {
        DimOf::<S>::vec(T::ZERO)
    }

    fn forget(&self, work: &mut VecOf<S>) {
        *work = DimOf::<S>::vec(T::ZERO);
    }

    fn keeps_positions(&self) -> bool {
        true
    }

    fn increment(
        &self,
        start: &Start<'_, S>,
        x: &VecOf<S>,
        h: T,
        work: &mut VecOf<S>,
        statistics: &mut Statistics,
    ) -> Result<VecOf<S>, IntegrationError> {
        let none = DimOf::<S>::vec(T::ZERO);
        let velocity = behind(x);
        if is_first_term(h) {
            return Ok(halves(&displaced(&none, h, &velocity), &none));
        }
        let mut action = Action { start, h, momentum: behind(&slopes(start.system, x)), hidden: none };
        let mut u = displaced(&velocity, T::ONE, work);
        let (mut iterations, mut before, mut least, mut reach) = (0, None, None, None);
        let mut settling = Settling::<DimOf<S>, T>::new();
        let mut plateau = Plateau::new();
        loop {
            let from = u;
            let ends @ [_, end] = action.ends(x, &u);
            let mut correction = action.correction(&ends);
            // where it is more than the velocities, rounding of the positions by a short step may be all of it
            if iterations == 0 && is_beyond(&correction, &u) {
                action.hidden = action.hidden(&end);
                correction = action.correction(&ends);
                statistics.evaluations += 2;
            }
            u = displaced(&u, T::ONE, &correction);
            statistics.evaluations += 2;
            statistics.iterations += 1;
            iterations += 1;
            let moved = [correction, u].map(|rate| displaced(&none, h, &rate));
            let size = size(&moved[0], x, &moved[1], &none);
            let ratio = before.map(|before| size / before);
            let is_finite = size.is_finite() && all_finite::<T, _>(&u);
            if is_finite
                && (size == T::ZERO || settling.after(&correction, &u, size <= self.tolerance, ratio))
            {
                break;
            }
            if !is_finite || iterations == MOST_ITERATIONS {
                *work = none;
                return Err(refusal(start, h, (iterations, size / self.tolerance), end.as_ref(), None));
            }
            // what rounding of the positions leaves, by the length of the step, is more than rounding of u
            let sizes = sizes(&correction);
            if !falls(least.get_or_insert(sizes).as_mut(), sizes.as_ref()) && iterations > 1 {
                let reach = reach.get_or_insert_with(|| {
                    statistics.evaluations += 7;
                    action.reach(&ends, &correction)
                });
                if sizes.as_ref().iter().zip(reach.as_ref()).all(|(size, reach)| size <= reach) {
                    break;
                }
            }
            let ahead = |part: T| {
                statistics.evaluations += 2;
                action.correction(&action.ends(x, &displaced(&from, part, &correction)))
            };
            let permitted = T::EPSILON.sqrt() * largest_of([&displaced(&none, h.recip(), x), &u]);
            let is_open = |row| exceeds(row, (&moved[0], x, &moved[1], &none), self.tolerance);
            if plateau.is_level(&correction, size)
                && size > self.tolerance
                && plateau.is_rounding(&correction, permitted, is_open, ahead)
            {
                break;
            }
            before = Some(size);
        }
        *work = difference(&u, &velocity);
        let arrived = action.arrived(&action.ends(x, &u));
        statistics.evaluations += 4;
        Ok(halves(&displaced(&none, h, &u), &difference(&arrived, &velocity)))
    }
}

/// A step, as a function of u.
struct Action<'s, S: DiscreteLagrangian> {
    start: &'s Start<'s, S>,
    h: ScalarOf<S>,
    /// p₀ = ∂L/∂q̇ at the start.
    momentum: VecOf<S>,
    /// Up to which size constraints hold as well as positions have digits, where they did at first; else zero.
    hidden: VecOf<S>,
}

impl<T: Real, S: DiscreteLagrangian> Action<'_, S>
where
    S::State: State<Scalar = T>,
{
    /// (q₀, u) and (q₀ + h u, u).
    fn ends(&self, x: &VecOf<S>, u: &VecOf<S>) -> [VecOf<S>; 2] {
        [halves(x, u), halves(&displaced(x, self.h, u), u)]
    }

    /// What u is to be changed by, up to the difference of the masses and of the constraints at the two ends.
    fn correction(&self, ends: &[VecOf<S>; 2]) -> VecOf<S> {
        self.constrained(self.start.state, &self.missing(ends))
    }

    /// The velocities that the constraints make of what is given; no numbers where that has none, whatever the system makes
    /// of these.
    fn constrained(&self, at: &S::State, given: &VecOf<S>) -> VecOf<S> {
        let mut velocities = self.start.system.constrained(at, given);
        let without = nought(given);
        velocities.as_mut().iter_mut().for_each(|velocity| *velocity += without);
        halves(&velocities, &DimOf::<S>::vec(T::ZERO))
    }

    /// How far rounding reaches into a correction, in two patterns: that of the positions at the end, four units of their
    /// last places up and down, and that of the momenta and the constraints beside their terms. What noise comes to.
    fn reach(&self, [here, there]: &[VecOf<S>; 2], correction: &VecOf<S>) -> VecOf<S> {
        let none = DimOf::<S>::vec(T::ZERO);
        let noise = halves(&self.noise(there), &displaced(&none, self.h.recip(), &self.blur(there)));
        let mut reach = none;
        for period in PERIODS {
            let rounded = halves(&apart(there, few::<T>(), period), &behind(there));
            let change = difference(&self.correction(&[*here, rounded]), correction);
            let of_terms = self.constrained(self.start.state, &signed(&noise, period));
            reach = displaced(&displaced(&reach, T::ONE, &sizes(&change)), T::ONE, &sizes(&of_terms));
        }
        reach
    }

    /// What rounding makes of the momenta: four units of what they are the sum of, which moving the velocities apart shows.
    fn noise(&self, there: &VecOf<S>) -> VecOf<S> {
        let momentum = |u: &VecOf<S>| behind(&slopes(self.start.system, &halves(there, u)));
        let u = behind(there);
        let mut noise = displaced(&DimOf::<S>::vec(T::ZERO), few(), &sizes(&self.momentum));
        add_changes(&mut noise, &momentum(&u), T::from_f64(PART), |period, part| {
            momentum(&apart(&u, part, period))
        });
        noise
    }

    /// The constraints that are open by no more than rounding, by how much that is.
    fn hidden(&self, there: &VecOf<S>) -> VecOf<S> {
        let mut hidden = self.blur(there);
        for (hidden, open) in hidden.as_mut().iter_mut().zip(self.open(there).as_ref()) {
            *hidden = if open.abs() <= *hidden { *hidden } else { T::ZERO };
        }
        hidden
    }

    /// g(q), in front of zeros.
    fn open(&self, at: &VecOf<S>) -> VecOf<S> {
        self.start.system.position_constraints(&S::State::from_array(*at))
    }

    /// What rounding makes of the constraints.
    fn blur(&self, there: &VecOf<S>) -> VecOf<S> {
        blur(there, there, |x| self.open(x))
    }

    /// p₀ + h/2 ∂L/∂q(q₀, u) − (∂L/∂q̇(q₀, u) + ∂L/∂q̇(q₁, u))/2, which multipliers of the constraints at the start make up
    /// for, and −g(q₁)/h.
    fn missing(&self, [here, there]: &[VecOf<S>; 2]) -> VecOf<S> {
        let half = T::from_f64(0.5);
        let slopes = [here, there].map(|end| slopes(self.start.system, end));
        let [mean, other] = slopes.map(|slopes| behind(&slopes));
        let mut force = displaced(&self.momentum, half * self.h, &slopes[0]);
        force = displaced(&force, -half, &displaced(&mean, T::ONE, &other));
        let mut open = self.open(there);
        for (open, blur) in open.as_mut().iter_mut().zip(self.hidden.as_ref()) {
            *open = if open.abs() <= *blur { T::ZERO } else { *open };
        }
        halves(&force, &displaced(&DimOf::<S>::vec(T::ZERO), -self.h.recip(), &open))
    }

    /// v₁ with ∂L/∂q̇(q₁, v₁) = h/2 ∂L/∂q(q₁, u) + (∂L/∂q̇(q₀, u) + ∂L/∂q̇(q₁, u))/2 but for multipliers of the constraints at
    /// the end, where they are satisfied.
    fn arrived(&self, [here, there]: &[VecOf<S>; 2]) -> VecOf<S> {
        let (half, rest) = (T::from_f64(0.5), DimOf::<S>::vec(T::ZERO));
        let slopes = [*here, *there, halves(there, &rest)].map(|end| slopes(self.start.system, &end));
        let [mean, other, at_rest] = slopes.map(|slopes| behind(&slopes));
        let momentum =
            displaced(&displaced(&rest, half, &displaced(&mean, T::ONE, &other)), half * self.h, &slopes[1]);
        let given = halves(&difference(&momentum, &at_rest), &rest);
        self.constrained(&S::State::from_array(*there), &given)
    }
}

/// Whether some number is larger than the other.
fn is_beyond<T: Real, V: Array<T>>(numbers: &V, others: &V) -> bool {
    numbers.as_ref().iter().zip(others.as_ref()).any(|(number, other)| number.abs() > other.abs())
}

/// ∂L/∂q and ∂L/∂q̇.
fn slopes<S: DiscreteLagrangian>(system: &S, x: &VecOf<S>) -> VecOf<S> {
    system.lagrangian_slopes(&S::State::from_array(*x))
}

/// The first halves of two arrays.
fn halves<T: Scalar, V: Array<T>>(front: &V, behind: &V) -> V {
    let mut whole = *front;
    let n = whole.as_ref().len() / 2;
    whole.as_mut().iter_mut().skip(n).zip(behind.as_ref()).for_each(|(slot, value)| *slot = *value);
    whole
}

/// The second half of an array, in front of zeros.
fn behind<T: Scalar, V: Array<T>>(whole: &V) -> V {
    let mut half = *whole;
    let n = half.as_ref().len() / 2;
    let values = whole.as_ref().iter().skip(n).copied().chain(core::iter::repeat(T::ZERO));
    half.as_mut().iter_mut().zip(values).for_each(|(slot, value)| *slot = value);
    half
}

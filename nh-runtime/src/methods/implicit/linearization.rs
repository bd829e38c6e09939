//! Where an implicit method takes ∂f/∂x from.

use crate::arrays::{Array, all_finite};
use crate::methods::Start;
use crate::projection::largest;
use crate::{Dim, DimOf, Dynamics, Jacobian, MatOf, Real, Scalar, ScalarOf, State, Statistics, VecOf};

/// How a method finds the Jacobian ∂f/∂x of its system: [`FiniteDifferences`] or [`Analytic`].
pub trait Linearization<S: Dynamics>: Copy {
    /// ∂f/∂x at a time and a point, where f is `slope`, for a step of length `h`; in row i, the derivatives of
    /// component i.
    fn state_jacobian(
        &self,
        start: &Start<'_, S>,
        time: ScalarOf<S>,
        point: &VecOf<S>,
        slope: &VecOf<S>,
        h: ScalarOf<S>,
        statistics: &mut Statistics,
    ) -> MatOf<S>;

    /// ∂f/∂x at the start of a step of length `h` whose error rests on it, where an error `permitted` of each
    /// component is aimed at.
    fn accurate_state_jacobian(
        &self,
        start: &Start<'_, S>,
        slope: &VecOf<S>,
        h: ScalarOf<S>,
        permitted: &VecOf<S>,
        statistics: &mut Statistics,
    ) -> MatOf<S> {
        let _ = permitted;
        self.state_jacobian(start, start.time, &start.state.to_array(), slope, h, statistics)
    }

    /// Whether a Jacobian that was formed for a step of length `formed` serves one of length `h`, too, as far as its digits
    /// go.
    fn serves(&self, _formed: ScalarOf<S>, _h: ScalarOf<S>) -> bool {
        true
    }

    /// The evaluations of the derivative that a Jacobian takes.
    fn evaluations(&self) -> usize {
        0
    }
}

/// The Jacobian by difference quotients: one evaluation of the derivative for each component, and a second where
/// the first shows nothing but rounding.
///
/// The increments are √ε times the size of the component: the larger of its value and of its change in a step. A
/// component that is nearly zero in both may be on its way to become large: where its increment shows nothing, a
/// share of the largest component does, and what a step changes is bounded by it. There is no other scale: quotients do not
/// depend on a unit that all components share; where these have different ones, as they do where a component is nearly zero,
/// they differ within the digits that quotients have.
///
/// An iteration that the Jacobian only speeds up forgives an inaccurate one, but rounding: it ends before what the equations
/// conserve is conserved, unless that of all columns is. So a component that is not small, and moves, has an increment of at
/// least ∛ε of the lesser of its value and its change there. And as increments are made for steps of one length, that of a
/// component that is zero among them, quotients do not serve steps that are a thousand times as long: they are formed anew.
///
/// Quotients over √ε have half the digits. Where the error of a step rests on the Jacobian, and a column without the
/// other half would move some component by more than a hundredth of its permitted error, a central difference over
/// ∛ε of the component, with two thirds of the digits, takes its place for two evaluations more.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FiniteDifferences;

/// The system's own Jacobian; where it is not finite while the derivative is, as that of √x at zero, the difference quotients
/// of [`FiniteDifferences`] take its place.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Analytic;

/// The share of the largest component that a small one may be taken for.
const SMALL: f64 = 1e-3;
/// How many times as long as the step that quotients are formed for others may be.
const LONGER: f64 = 1e3;
/// The rounding errors of a derivative below which its change says nothing.
const ROUND_OFF: f64 = 16.0;
/// The share of the permitted error that the rounding of a Jacobian may come to.
const NEGLIGIBLE: f64 = 0.01;

impl<S: Jacobian> Linearization<S> for Analytic
where
    ScalarOf<S>: Real,
{
    #[inline]
    fn state_jacobian(
        &self,
        start: &Start<'_, S>,
        time: ScalarOf<S>,
        point: &VecOf<S>,
        slope: &VecOf<S>,
        h: ScalarOf<S>,
        statistics: &mut Statistics,
    ) -> MatOf<S> {
        let own = start.system.state_jacobian(time, &S::State::from_array(*point), start.input);
        if own.as_ref().iter().all(all_finite::<ScalarOf<S>, _>) {
            return own;
        }
        quotients(&Place { start, time, point, slope }, h, None, statistics)
    }
}

impl<S: Dynamics> Linearization<S> for FiniteDifferences
where
    ScalarOf<S>: Real,
{
    fn state_jacobian(
        &self,
        start: &Start<'_, S>,
        time: ScalarOf<S>,
        point: &VecOf<S>,
        slope: &VecOf<S>,
        h: ScalarOf<S>,
        statistics: &mut Statistics,
    ) -> MatOf<S> {
        quotients(&Place { start, time, point, slope }, h, None, statistics)
    }

    fn accurate_state_jacobian(
        &self,
        start: &Start<'_, S>,
        slope: &VecOf<S>,
        h: ScalarOf<S>,
        permitted: &VecOf<S>,
        statistics: &mut Statistics,
    ) -> MatOf<S> {
        let point = &start.state.to_array();
        quotients(&Place { start, time: start.time, point, slope }, h, Some(permitted), statistics)
    }

    fn serves(&self, formed: ScalarOf<S>, h: ScalarOf<S>) -> bool {
        h.abs() <= ScalarOf::<S>::from_f64(LONGER) * formed.abs()
    }

    fn evaluations(&self) -> usize {
        DimOf::<S>::N
    }
}

/// The matrix of the quotients for a step of length h, to the permitted error if there is one.
fn quotients<S: Dynamics>(
    place: &Place<'_, '_, S>,
    h: ScalarOf<S>,
    permitted: Option<&VecOf<S>>,
    statistics: &mut Statistics,
) -> MatOf<S>
where
    ScalarOf<S>: Real,
{
    let w = ScalarOf::<S>::from_f64;
    let epsilon = ScalarOf::<S>::EPSILON;
    let (root, cube_root) = (epsilon.sqrt(), epsilon.cbrt());
    let sizes = sizes::<ScalarOf<S>, _>(place.point, place.slope, h);
    let least = largest(sizes.as_ref()) * w(SMALL);
    let mut matrix: MatOf<S> = DimOf::<S>::mat(ScalarOf::<S>::ZERO);
    for (j, &size) in sizes.as_ref().iter().enumerate() {
        let mut delta = root * size;
        if permitted.is_none() {
            delta = delta.max(cube_root * place.lesser(j, h));
        }
        let mut column = place.quotient(j, delta, statistics);
        if size < least && column.is_none_or(|(_, is_seen)| !is_seen) {
            column = place.quotient(j, root * least, statistics).or(column);
        }
        // what nothing moves is not seen to depend on anything
        let Some((mut column, is_seen)) = column else { continue };
        // what the digits that are missing contribute to the change of a component over the step
        let share = root * h.abs() * size;
        let matters = |(entry, permitted): (&ScalarOf<S>, &ScalarOf<S>)| {
            share * entry.abs() > w(NEGLIGIBLE) * *permitted
        };
        if permitted.is_some_and(|permitted| column.as_ref().iter().zip(permitted.as_ref()).any(matters)) {
            let size = if is_seen { size } else { size.max(least) };
            column = place.central(j, cube_root * size, statistics).unwrap_or(column);
        }
        for (row, q) in matrix.as_mut().iter_mut().zip(column.as_ref()) {
            if let Some(entry) = row.as_mut().get_mut(j) {
                *entry = *q;
            }
        }
    }
    matrix
}

/// How large each component is, by its value and by its change in a step of length h. At a point far from where the
/// solution will stay, as in a boundary layer, the latter says no more than that of the largest component.
fn sizes<T: Real, V: Array<T>>(x: &V, slope: &V, h: T) -> V {
    let most = largest(x.as_ref());
    let mut sizes = *x;
    for (size, f) in sizes.as_mut().iter_mut().zip(slope.as_ref()) {
        let moved = (h * *f).abs();
        let moved = if most > T::ZERO { moved.min(most) } else { moved };
        let bounded = if moved.is_finite() { moved } else { T::ZERO };
        *size = size.abs().max(bounded);
    }
    sizes
}

/// Where a derivative is differentiated, with its value there.
struct Place<'a, 'b, S: Dynamics> {
    start: &'a Start<'b, S>,
    time: ScalarOf<S>,
    point: &'a VecOf<S>,
    slope: &'a VecOf<S>,
}

impl<S: Dynamics> Place<'_, '_, S>
where
    ScalarOf<S>: Real,
{
    /// The lesser of the value of component `j` and its change in a step of length h.
    fn lesser(&self, j: usize, h: ScalarOf<S>) -> ScalarOf<S> {
        let of = |list: &VecOf<S>| list.as_ref().get(j).map_or(ScalarOf::<S>::ZERO, |number| number.abs());
        let (value, change) = (of(self.point), h.abs() * of(self.slope));
        if change < value { change } else { value }
    }

    /// The difference quotient of f by component `j`, forwards or else backwards, and whether it shows more than
    /// rounding. None where the component does not move.
    fn quotient(
        &self,
        j: usize,
        delta: ScalarOf<S>,
        statistics: &mut Statistics,
    ) -> Option<(VecOf<S>, bool)> {
        let forwards = self.quotient_by(j, delta, statistics)?;
        if all_finite::<ScalarOf<S>, _>(&forwards.0) {
            return Some(forwards);
        }
        self.quotient_by(j, -delta, statistics)
    }

    /// The difference quotient of f by component `j` between two points at this distance on either side; None where
    /// either has none.
    fn central(&self, j: usize, delta: ScalarOf<S>, statistics: &mut Statistics) -> Option<VecOf<S>> {
        let x = *self.point.as_ref().get(j)?;
        let (ahead, behind) = (x + delta, x - delta);
        let at = |x: ScalarOf<S>| {
            let mut moved = *self.point;
            if let Some(place) = moved.as_mut().get_mut(j) {
                *place = x;
            }
            self.start.derivative_at(self.time, moved)
        };
        statistics.evaluations += 2;
        let (mut column, other) = (at(ahead), at(behind));
        for (a, b) in column.as_mut().iter_mut().zip(other.as_ref()) {
            *a = (*a - *b) / (ahead - behind);
        }
        all_finite::<ScalarOf<S>, _>(&column).then_some(column)
    }

    fn quotient_by(
        &self,
        j: usize,
        delta: ScalarOf<S>,
        statistics: &mut Statistics,
    ) -> Option<(VecOf<S>, bool)> {
        let mut moved = *self.point;
        let x = moved.as_mut().get_mut(j)?;
        let before = *x;
        *x += delta;
        // the distance that rounding has left
        let really = *x - before;
        if really == ScalarOf::<S>::ZERO {
            return None;
        }
        statistics.evaluations += 1;
        let mut ahead = self.start.derivative_at(self.time, moved);
        let round_off = ScalarOf::<S>::from_f64(ROUND_OFF) * ScalarOf::<S>::EPSILON;
        let mut is_seen = false;
        for (a, f) in ahead.as_mut().iter_mut().zip(self.slope.as_ref()) {
            let change = *a - *f;
            is_seen |= change.abs() > round_off * f.abs().max(a.abs());
            *a = change / really;
        }
        Some((ahead, is_seen))
    }
}

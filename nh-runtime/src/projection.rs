//! Newton's iteration by which generated code returns to a manifold.

use crate::arrays::all_finite;
use crate::newton_return::worst;
use crate::rounding::{
    are_rounding, displaced, further, grow, half_of_the_digits, is_level, is_settled, sizes,
};
use crate::{ProjectionError, Scalar, StateFault};

/// The iterations after which a projection is given up.
const MOST_ITERATIONS: u32 = 50;
/// The iterations among them that look for the nearest point.
const NEAREST: u32 = 40;

/// The limit of y := step(start, y) from y = start.
///
/// Near a curved manifold the iteration converges linearly, the faster the nearer the start. If it has
/// not after forty steps, steps from where it is lead to the manifold quadratically, and are as near
/// as the first ones have come.
///
/// The iteration stops when a step changes every component by at most four rounding units of its own, or when changes below
/// 5000 of them no longer halve: where the constraints are nearly dependent, a step repeats its own round-off no better. Where
/// a component is near to zero beside others, it stops where changes no longer halve, and residuals and what a step makes
/// of them are rounding beside their terms. No two components are compared, so that units do not matter. A point where
/// every residual is zero is returned as it is. Lanes stop together, when the last one does. Derivatives that numbers carry
/// converge as the numbers do, or from them.
///
/// Where constraints are dependent, steps that do not change any more may lead anywhere. So what is left of each equation is
/// asked to be less than half of the digits of what the components make of it.
///
/// # Errors
/// If the changes do not vanish, a step is not finite, or the equations are not met.
pub fn project<T: Scalar, const N: usize, const M: usize>(
    start: [T; N],
    step: impl Fn(&[T; N], &[T; N]) -> [T; N],
    residual: impl Fn(&[T; N]) -> [T; M],
) -> Result<[T; N], ProjectionError> {
    if holds(&residual(&start)) {
        return Ok(start);
    }
    let found = converge(start, NEAREST, &step, &residual)?;
    // derivatives stay with the numbers that they belong to
    if T::DERIVATIVES > 0 {
        return Ok(found);
    }
    let left = of_its_terms(&start, &found, &residual);
    if half_of_the_digits::<T>().all_ge(left) {
        return Ok(found);
    }
    // where constraints are nearly dependent a step has few digits, and where they are it has none and leads anywhere
    if !T::from_f64(0.125).all_ge(left) {
        return Err(refusal(NEAREST, &residual(&found)));
    }
    let refined = converge(found, 0, &step, &residual)?;
    if half_of_the_digits::<T>().all_ge(of_its_terms(&start, &refined, &residual)) {
        return Ok(refined);
    }
    Err(refusal(MOST_ITERATIONS, &residual(&refined)))
}

/// The largest part, among equations, that what is left of one is of its terms: of what the largest variable makes of it, and of
/// what it was at the start or what the largest variable there makes of it. Where steps lead far away, variables at the end make
/// enough of anything, and those at the start where they were far away.
fn of_its_terms<T: Scalar, const N: usize, const M: usize>(
    start: &[T; N],
    end: &[T; N],
    residual: impl Fn(&[T; N]) -> [T; M],
) -> T {
    let left = residual(end);
    if !all_finite(&left) {
        return T::ONE;
    }
    let raised = |most: [T; M], by: T| {
        let mut terms = most;
        for pattern in 0..2 {
            let there = residual(&displaced(end, &[by; N], T::ONE, pattern));
            for (terms, (there, here)) in terms.iter_mut().zip(there.iter().zip(&left)) {
                *terms = terms.max((*there - *here).abs());
            }
        }
        terms
    };
    let before = raised(residual(start).map(T::abs), largest(start));
    let terms = raised([T::ZERO; M], largest(end));
    let mut part = T::ZERO;
    for ((left, terms), before) in left.iter().zip(&terms).zip(&before) {
        let terms = before.select_gt(*terms, *terms, *before);
        let of_terms = terms.select_gt(T::ZERO, left.abs() / terms, T::ONE);
        part = part.max(left.abs().select_gt(T::ZERO, of_terms, T::ZERO));
    }
    part
}

/// The limit of y := step(start, y) from y = start for some iterations, and of y := step(y, y) after these.
fn converge<T: Scalar, const N: usize, const M: usize>(
    start: [T; N],
    nearest: u32,
    step: impl Fn(&[T; N], &[T; N]) -> [T; N],
    residual: impl Fn(&[T; N]) -> [T; M],
) -> Result<[T; N], ProjectionError> {
    let mut present = start;
    let mut most = sizes(&start);
    let mut preceding: Option<[T; N]> = None;
    let mut iterations = 0;
    // those that are left for derivatives, once the numbers have converged
    let mut left: Option<u32> = None;
    while iterations < MOST_ITERATIONS || left.is_some() {
        let next = step(if iterations < nearest { &start } else { &present }, &present);
        iterations += 1;
        if !all_finite::<T, _>(&next) {
            break;
        }
        let mut change = next;
        for (change, present) in change.iter_mut().zip(&present) {
            *change -= *present;
        }
        grow(&mut most, &next);
        present = next;
        let is_end = || {
            is_settled(&change, &most, preceding.as_ref())
                || (preceding.is_some_and(|preceding| is_level(&preceding, &change))
                    && all_hold(&are_rounding(&present, &change, &residual)))
        };
        left = match left {
            Some(left) => Some(left - 1),
            None if is_end() => Some(further::<T>() + T::DERIVATIVES * iterations),
            None => None,
        };
        if left == Some(0) {
            return Ok(present);
        }
        preceding = if iterations == nearest { None } else { Some(change) };
    }
    Err(refusal(iterations, &residual(&present)))
}

/// Whether all of these are 1, in every lane.
fn all_hold<T: Scalar>(all: &[T]) -> bool {
    all.iter().all(|one| one.all_ge(T::ONE))
}

/// How often identities of a base and position constraints, which move each other, are returned to in turn.
pub const MOST_RETURNS: usize = 8;

/// Whether, in every lane, no component has moved by more than its rounding.
#[must_use]
pub fn stays<T: Scalar, const N: usize>(before: &[T; N], after: &[T; N]) -> bool {
    let mut moved = *after;
    for (moved, before) in moved.iter_mut().zip(before) {
        *moved -= *before;
    }
    let mut most = sizes(before);
    grow(&mut most, after);
    is_settled(&moved, &most, None)
}

/// Whether nothing is left to correct.
#[inline]
#[must_use]
pub fn holds<T: Scalar>(residuals: &[T]) -> bool {
    residuals.iter().all(|r| *r == T::ZERO)
}

/// How far, relative to their size, coordinates that are given may lie from where their identities
/// hold: far enough for what is rounded to single precision.
const IDENTITY_TOLERANCE: f64 = 1e-6;

/// Accepts coordinates that one step `present → next` towards their identities hardly moves, beside those that it moves.
///
/// # Errors
/// The identity with the largest residual.
pub fn check_identities<T: Scalar, const N: usize, const M: usize>(
    present: [T; N],
    next: [T; N],
    identities: [(&'static str, T); M],
) -> Result<(), StateFault> {
    // coordinates that no identity moves say nothing of how large the others are
    let (mut distance, mut size) = (T::ZERO, T::ZERO);
    for (next, present) in next.iter().zip(&present) {
        let moved = (*next - *present).abs();
        distance = distance.max(moved);
        size = size.max(moved.select_gt(T::ZERO, present.abs(), T::ZERO));
    }
    if (size * T::from_f64(IDENTITY_TOLERANCE)).all_ge(distance) {
        return Ok(());
    }
    Err(worst(identities))
}

/// The largest absolute value.
#[inline]
pub fn largest<T: Scalar>(x: &[T]) -> T {
    x.iter().fold(T::ZERO, |largest, x| largest.max(x.abs()))
}

#[cold]
fn refusal<T: Scalar>(iterations: u32, residual: &[T]) -> ProjectionError {
    ProjectionError { iterations, residual: largest(residual).to_f64() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_circle_is_reached_quadratically() {
        // x := x − f ∇f / |∇f|²
        let circle = |[x, y]: &[f64; 2]| [x * x + y * y - 1.0];
        let step = |_: &[f64; 2], p: &[f64; 2]| {
            let [f] = circle(p);
            let factor = f / (2.0 * (p[0] * p[0] + p[1] * p[1]));
            [p[0] - factor * p[0], p[1] - factor * p[1]]
        };
        let [x, y] = project([3.0, 4.0], step, circle).unwrap();
        assert!((x - 0.6).abs() < 1e-15 && (y - 0.8).abs() < 1e-15, "{x} {y}");
        assert_eq!(project([0.6, 0.8], step, |_| [0.0]), Ok([0.6, 0.8]));
        let error = project([0.0, 0.0], step, circle).unwrap_err();
        assert_eq!(error, ProjectionError { iterations: 1, residual: 1.0 });
    }

    /// x + y = 1 and (1 + e) x + y = 1, of which rounding leaves nothing to tell them apart by, and steps lead anywhere.
    #[test]
    fn steps_that_lead_nowhere_are_no_end() {
        let rows = |[x, y]: &[f64; 2]| [x + y - 1.0, x + y - 1.0];
        let step = |start: &[f64; 2], _: &[f64; 2]| [start[0] + 0.3, start[1] - 0.1];
        assert!(project([0.2, 0.1], step, rows).is_err());
        // a step of few digits is made up for by those that follow
        let rough = |start: &[f64; 2], _: &[f64; 2]| {
            let off = 0.49 * (start[0] + start[1] - 1.0);
            [start[0] - off, start[1] - off]
        };
        let [x, y] = project([0.2, 0.1], rough, rows).unwrap();
        assert!((x + y - 1.0).abs() < 1e-15, "{x} {y}");
        // nor far away, where variables make enough of any residual
        let far = |_: &[f64; 2], _: &[f64; 2]| [1e20, 1.1 - 1e20];
        let open = |[x, y]: &[f64; 2]| [x + y - 1.0, 0.1];
        assert!(project([0.2, 0.1], far, open).is_err());
        assert!(project([1e30, 0.1], |_, _| [0.9, 0.1], |[x, y]: &[f64; 2]| [x + y - 1.1, *x]).is_err());
        // a start at rest is set in motion
        assert!(project([0.0; 2], |_, _| [0.5; 2], rows).is_ok());
    }

    #[test]
    fn a_slow_search_for_the_nearest_point_ends_on_the_manifold() {
        // the point of y = k x² that is nearest to one far above it, by steps x₀ + μ ∇f
        let steps = core::cell::Cell::new(0);
        let curve = |[x, y]: &[f64; 2]| [0.475 * x * x - y];
        let step = |start: &[f64; 2], p: &[f64; 2]| {
            steps.set(steps.get() + 1);
            let slope = 0.95 * p[0];
            let gap = slope * (p[0] - start[0]) - (p[1] - start[1]) - curve(p)[0];
            let mu = gap / (slope * slope + 1.0);
            [start[0] + mu * slope, start[1] - mu]
        };
        let near = project([0.05, 0.9], step, curve).unwrap();
        assert!(curve(&near)[0].abs() < 1e-15, "{near:?}");
        assert!((41..=46).contains(&steps.get()), "{}", steps.get());
    }

    /// In other units of each component, and beside one that is large, steps and bits are the same.
    #[test]
    fn units_matter_to_nothing() {
        let ended = |units: [f64; 2], large: f64| {
            let steps = core::cell::Cell::new(0);
            let curve = |x: &[f64; 3]| [(x[0] / units[0]).powi(2) + x[1] / units[1] - 1.0];
            let step = |start: &[f64; 3], p: &[f64; 3]| {
                steps.set(steps.get() + 1);
                let [x0, y0] = [start[0] / units[0], start[1] / units[1]];
                let x = p[0] / units[0];
                let gap = 2.0 * x * (x - x0) + (p[1] / units[1] - y0) - curve(p)[0];
                let mu = gap / (4.0 * x * x + 1.0);
                [(x0 + mu * 2.0 * x) * units[0], (y0 + mu) * units[1], p[2]]
            };
            let [x, y, _] = project([0.6 * units[0], 0.7 * units[1], large], step, curve).unwrap();
            ([x / units[0], y / units[1]].map(f64::to_bits), steps.get())
        };
        let plain = ended([1.0; 2], 0.0);
        for power in [-300, -30, 30, 300] {
            let unit = 2.0_f64.powi(power);
            for units in [[unit, 1.0], [1.0, unit], [unit, 1.0 / unit]] {
                assert_eq!(ended(units, 0.0), plain, "{units:?}");
            }
            assert_eq!(ended([1.0; 2], unit), plain, "{unit}");
        }
    }

    #[test]
    fn what_is_far_away_from_identities_is_not_excused_by_others() {
        let identity = [("|g| = 1", 0.5)];
        assert!(check_identities([1e12, 0.0, 1.5], [1e12, 0.0, 1.1], identity).is_err());
        assert!(check_identities([1e12, 0.0, 1.0], [1e12, 0.0, 1.0 + 1e-7], identity).is_ok());
    }

    #[test]
    fn identities_hold_to_their_tolerance() {
        let check = |distance: f64| {
            check_identities([3.0, 4.0], [3.0, 4.0 - distance], [("a = 0", 0.1), ("b = 0", -distance)])
        };
        assert_eq!(check(3.9e-6), Ok(()));
        assert_eq!(check(4.1e-6), Err(StateFault { identity: "a = 0", residual: 0.1 }));
        assert_eq!(check(0.5), Err(StateFault { identity: "b = 0", residual: -0.5 }));
        assert!(check(f64::NAN).is_err());
    }

    #[test]
    fn an_identity_that_is_no_number_is_named_wherever_it_stands() {
        let nan = ("c = 0", f64::NAN);
        for (present, next) in [([3.0, 4.0], [f64::NAN, 4.0]), ([3.0, 4.0], [3.0, f64::NAN])] {
            let (a, b) = (("a = 0", 0.1), ("b = 0", f64::INFINITY));
            for identities in [[a, b, nan], [a, nan, b], [nan, a, b]] {
                let fault = check_identities(present, next, identities).unwrap_err();
                assert!(fault.identity == "c = 0" && fault.residual.is_nan(), "{fault:?}");
            }
        }
    }

    #[test]
    fn what_does_not_settle_is_given_up() {
        let error = project([1.0_f32], |_, [x]| [-x], |_| [2.0]).unwrap_err();
        assert_eq!(error, ProjectionError { iterations: 50, residual: 2.0 });
    }

    #[test]
    fn round_off_that_repeats_is_accepted() {
        let noise = |_: &[f64; 1], [x]: &[f64; 1]| [if *x > 1.0 { 1.0 - 1e-14 } else { 1.0 + 1e-14 }];
        assert!(project([1.5], noise, |[x]| [x - 1.0]).is_ok());
    }
}

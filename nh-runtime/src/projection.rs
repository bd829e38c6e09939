//! Newton's iteration by which generated code returns to a manifold.

use crate::arrays::all_finite;
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
/// The iteration stops when a step changes y by at most four rounding units of the largest component,
/// or when changes below 5000 of them no longer halve: where the constraints are nearly dependent,
/// a step repeats its own round-off no better. A point where every residual is zero is returned as
/// it is. Lanes stop together, when the last one does.
///
/// # Errors
/// If the changes do not vanish, or a step is not finite.
pub fn project<T: Scalar, const N: usize, const M: usize>(
    start: [T; N],
    step: impl Fn(&[T; N], &[T; N]) -> [T; N],
    residual: impl Fn(&[T; N]) -> [T; M],
) -> Result<[T; N], ProjectionError> {
    if holds(&residual(&start)) {
        return Ok(start);
    }
    let mut present = start;
    let mut scale = largest(&start);
    let mut preceding: Option<T> = None;
    let mut iterations = 0;
    while iterations < MOST_ITERATIONS {
        let next = step(if iterations < NEAREST { &start } else { &present }, &present);
        iterations += 1;
        if !all_finite::<T, _>(&next) {
            break;
        }
        let change = next.iter().zip(&present).fold(T::ZERO, |m, (a, b)| m.max((*a - *b).abs()));
        scale = scale.max(largest(&next));
        present = next;
        if is_settled(change, scale, preceding) {
            return Ok(present);
        }
        preceding = if iterations == NEAREST { None } else { Some(change) };
    }
    Err(refusal(iterations, &residual(&present)))
}

/// How often identities of a base and position constraints, which move each other, are returned to in turn.
pub const MOST_RETURNS: usize = 8;

/// Whether, in every lane, no component has moved by more than rounding of the largest.
#[must_use]
pub fn stays<T: Scalar, const N: usize>(before: &[T; N], after: &[T; N]) -> bool {
    let mut moved = *after;
    for (moved, before) in moved.iter_mut().zip(before) {
        *moved -= *before;
    }
    is_settled(largest(&moved), largest(after), None)
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

/// Accepts coordinates that one step `present → next` towards their identities hardly moves.
///
/// # Errors
/// The identity with the largest residual.
pub fn check_identities<T: Scalar, const N: usize, const M: usize>(
    present: [T; N],
    next: [T; N],
    identities: [(&'static str, T); M],
) -> Result<(), StateFault> {
    let distance = next.iter().zip(&present).fold(T::ZERO, |m, (a, b)| m.max((*a - *b).abs()));
    if (largest(&present) * T::from_f64(IDENTITY_TOLERANCE)).all_ge(distance) {
        return Ok(());
    }
    let mut worst = StateFault { identity: "", residual: 0.0 };
    for (identity, residual) in identities {
        let residual = residual.to_f64();
        if worst.identity.is_empty() || residual.abs() > worst.residual.abs() {
            worst = StateFault { identity, residual };
        }
    }
    Err(worst)
}

/// The largest absolute value.
#[inline]
pub fn largest<T: Scalar>(x: &[T]) -> T {
    x.iter().fold(T::ZERO, |largest, x| largest.max(x.abs()))
}

/// Whether, in every lane, the change is round-off. How large that is shows in the sum with the
/// scale: lanes have no number for it.
#[inline]
pub(crate) fn is_settled<T: Scalar>(change: T, scale: T, preceding: Option<T>) -> bool {
    let beyond =
        |fraction: f64, then: T| (scale + change * T::from_f64(fraction)).select_gt(scale, then, T::ZERO);
    let still_falls = match preceding {
        Some(preceding) => (preceding * T::from_f64(0.5)).select_gt(change, T::ONE, T::ZERO),
        None => T::ONE,
    };
    let large = beyond(1e-4, T::ONE);
    let open = beyond(0.125, still_falls.max(large));
    T::ZERO.all_ge(open)
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
    fn what_does_not_settle_is_given_up() {
        let error = project([1.0_f32], |_, [x]| [-x], |_| [2.0]).unwrap_err();
        assert_eq!(error, ProjectionError { iterations: 50, residual: 2.0 });
    }

    #[test]
    fn round_off_that_repeats_is_accepted() {
        let noise = |_: &[f64; 1], [x]: &[f64; 1]| [if *x > 1.0 { 1.0 - 1e-14 } else { 1.0 + 1e-14 }];
        assert!(project([1.5], noise, |_| [1.0]).is_ok());
    }
}

//! Newton's iteration by which generated code returns to position constraints, and to linear ones on
//! velocities.

use crate::arrays::all_finite;
use crate::projection::{holds, is_settled, largest};
use crate::{ProjectionError, Scalar, StateFault};

/// The iterations after which a return is given up.
const MOST_ITERATIONS: u32 = 50;

/// The limit of x := x + change(x) from x = start.
///
/// The iteration stops where every residual is zero; where a change is of the order of rounding, or changes
/// near that no longer fall; and where the next change would be of that order: to first order it is to this
/// one as the residual that is left is to the one before, row by row. Near to where it leads it is one step.
/// Where all of x is near to zero, as upright and at the origin, rounding is that of lengths inside the equations: there
/// it stops where changes no longer fall, and jump before and behind their way. Lanes stop together, when the last one
/// does.
///
/// # Errors
/// If the changes do not vanish, or one is not finite.
#[inline]
pub fn newton<T: Scalar, const N: usize, const M: usize>(
    start: [T; N],
    change: impl Fn(&[T; N]) -> [T; N],
    residual: impl Fn(&[T; N]) -> [T; M],
) -> Result<[T; N], ProjectionError> {
    let mut present = start;
    let mut left = residual(&present);
    let mut scale = largest(&present);
    let mut preceding = None;
    let mut iterations = 0;
    while !holds(&left) {
        if iterations == MOST_ITERATIONS {
            return Err(ProjectionError { iterations, residual: largest(&left).to_f64() });
        }
        let moved = change(&present);
        iterations += 1;
        for (x, moved) in present.iter_mut().zip(&moved) {
            *x += *moved;
        }
        let before = left;
        left = residual(&present);
        if !all_finite::<T, _>(&present) {
            return Err(ProjectionError { iterations, residual: largest(&before).to_f64() });
        }
        let size = largest(&moved);
        scale = scale.max(largest(&present));
        if is_settled(size, scale, preceding) || is_last(size, scale, &before, &left) {
            break;
        }
        if preceding.is_some_and(|preceding| is_level(preceding, size))
            && is_rounding(&present, &moved, &change)
        {
            break;
        }
        preceding = Some(size);
    }
    Ok(present)
}

/// x + change(x).
#[inline]
pub fn corrected<T: Scalar, const N: usize>(start: [T; N], change: impl Fn(&[T; N]) -> [T; N]) -> [T; N] {
    let mut next = change(&start);
    for (next, start) in next.iter_mut().zip(&start) {
        *next = *start + *next;
    }
    next
}

/// The first iterate of [`project`](crate::projection::project).
#[inline]
pub fn first_iterate<T: Scalar, const N: usize>(
    start: [T; N],
    step: impl Fn(&[T; N], &[T; N]) -> [T; N],
) -> [T; N] {
    step(&start, &start)
}

/// Whether, in every lane, the next change would be round-off.
#[inline]
pub(crate) fn is_last<T: Scalar, const M: usize>(
    change: T,
    scale: T,
    before: &[T; M],
    left: &[T; M],
) -> bool {
    before.iter().zip(left).all(|(before, left)| {
        // change · left/before beside the scale, without a quotient
        let (before, left) = (before.abs(), left.abs());
        let whole = scale * before;
        let beyond = (whole + change * left).select_gt(whole, T::ONE, T::ZERO);
        T::ZERO.all_ge(beyond)
    })
}

/// Whether a change is, in some lane, of the size of the preceding one.
#[inline]
fn is_level<T: Scalar>(preceding: T, change: T) -> bool {
    let falls = (preceding * T::from_f64(0.5)).select_gt(change, T::ZERO, T::ONE);
    let grows = change.select_gt(preceding * T::from_f64(64.0), T::ZERO, T::ONE);
    !T::ZERO.all_ge(falls * grows)
}

/// Whether, in every lane, a change that led here was rounding: changes follow a multiple of it as those of smooth
/// equations do, nearly linearly, and they jump before and behind its way, as those of smooth equations do at poles
/// alone.
#[cold]
fn is_rounding<T: Scalar, const N: usize>(
    present: &[T; N],
    moved: &[T; N],
    change: impl Fn(&[T; N]) -> [T; N],
) -> bool {
    let after = |part: T| {
        let mut there = *present;
        for (x, moved) in there.iter_mut().zip(moved) {
            *x += (part - T::ONE) * *moved;
        }
        change(&there)
    };
    let size = largest(moved);
    let multiple = T::from_f64(MULTIPLE);
    let beyond = moved.map(|moved| (T::ONE - multiple) * moved);
    let off = apart(&after(multiple), &beyond) * T::from_f64(8.0);
    let follows = (size * multiple).select_gt(off, T::ONE, T::ZERO);
    let jumps = [-SURROUNDINGS, 1.0].into_iter().fold(T::ONE, |jumps, near| {
        jumps * jumps_between(after, (T::from_f64(near), T::from_f64(near + SURROUNDINGS)), size)
    });
    let is_moved = size.select_gt(T::ZERO, T::ONE, T::ZERO);
    T::ZERO.all_ge(is_moved * (T::ONE - follows * jumps))
}

/// 1 in lanes where a function jumps between two places, by no less than 1/8 of a size and far from poles, else 0.
fn jumps_between<T: Scalar, const N: usize>(
    function: impl Fn(T) -> [T; N],
    (mut near, mut far): (T, T),
    size: T,
) -> T {
    let half = T::from_f64(0.5);
    // the half in which values differ more, again and again
    let (mut at_near, mut at_far) = (function(near), function(far));
    for _ in 0..HALVINGS {
        let middle = half * (near + far);
        let there = function(middle);
        let (first, second) = (apart(&at_near, &there), apart(&there, &at_far));
        near = second.select_gt(first, middle, near);
        far = second.select_gt(first, far, middle);
        for ((at_near, at_far), there) in at_near.iter_mut().zip(&mut at_far).zip(&there) {
            *at_near = second.select_gt(first, *there, *at_near);
            *at_far = second.select_gt(first, *at_far, *there);
        }
    }
    let jumps = (apart(&at_near, &at_far) * T::from_f64(8.0)).select_gt(size, T::ONE, T::ZERO);
    let pole = size * T::from_f64(4.0 * SURROUNDINGS);
    jumps * pole.select_gt(largest(&at_near).max(largest(&at_far)), T::ONE, T::ZERO)
}

/// A multiple of a change of the size of rounding that is beyond its noise, and nothing beside the lengths of a machine.
const MULTIPLE: f64 = 1024.0;
/// How many changes before and behind one are searched for jumps: a few steps of rounding.
const SURROUNDINGS: f64 = 32.0;
/// How often the way is halved in the search for a jump: then its ends are neighbours among the numbers.
const HALVINGS: u32 = 60;

/// The largest difference of components.
fn apart<T: Scalar, const N: usize>(a: &[T; N], b: &[T; N]) -> T {
    a.iter().zip(b).fold(T::ZERO, |most, (a, b)| most.max((*a - *b).abs()))
}

/// 1, −1, or 0 where one of the numbers is.
#[inline]
#[must_use]
pub fn product_of_signs<T: Scalar, const N: usize>(numbers: [T; N]) -> T {
    numbers.iter().fold(T::ONE, |product, number| product * number.sign())
}

/// The constraint that a state leaves the largest residual in.
#[must_use]
pub fn worst<T: Scalar, const M: usize>(residuals: [(&'static str, T); M]) -> StateFault {
    let mut worst = StateFault { identity: "", residual: 0.0 };
    for (identity, residual) in residuals {
        let residual = residual.to_f64();
        let is_worse = residual.abs() > worst.residual.abs() || !residual.is_finite();
        if worst.identity.is_empty() || is_worse {
            worst = StateFault { identity, residual };
        }
    }
    worst
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::cell::Cell;

    /// x² + y² = 1, along the gradient.
    fn circle([x, y]: &[f64; 2]) -> [f64; 1] {
        [x * x + y * y - 1.0]
    }
    fn change(p: &[f64; 2]) -> [f64; 2] {
        let factor = circle(p)[0] / (2.0 * (p[0] * p[0] + p[1] * p[1]));
        [-factor * p[0], -factor * p[1]]
    }

    #[test]
    fn near_to_where_it_leads_it_is_one_step() {
        let steps = Cell::new(0);
        let counted = |p: &[f64; 2]| {
            steps.set(steps.get() + 1);
            change(p)
        };
        let [x, y] = newton([0.6 + 1e-10, 0.8], counted, circle).unwrap();
        assert!((x * x + y * y - 1.0).abs() < 3e-16);
        assert_eq!(steps.get(), 1);
        let [x, y] = newton([3.0, 4.0], counted, circle).unwrap();
        assert!((x - 0.6).abs() < 2e-16 && (y - 0.8).abs() < 2e-16);
        assert!(steps.get() <= 8, "{}", steps.get());
        assert_eq!(newton([1.0, 0.0], |_| [f64::NAN; 2], circle), Ok([1.0, 0.0]));
    }

    /// Heights beside which the coordinate is nothing.
    #[test]
    fn near_to_zero_it_ends_at_the_rounding_of_lengths() {
        // x + 2·10⁻¹⁷ beside 0.3, whose digits are 5.6·10⁻¹⁷ apart: no x is a zero, and changes go in circles
        for unit in [1.0, 1e200, 1e-200] {
            let height = |x: f64| ((x + 0.3 * unit) - 0.3 * unit) + 2e-17 * unit;
            for start in [0.01, 1e-9, 1e-15, 3.7e-17, 0.0, -1e-18] {
                let [x] = newton([start * unit], |p| [-height(p[0])], |p: &[f64; 1]| [height(p[0])]).unwrap();
                assert!(x.abs() < 1e-16 * unit, "{start} {x}");
            }
        }
        // what is smooth is not rounding: x² + 1, √(x² + 1), and both with 10⁻²⁰ from near to zero
        for (height, root) in [(1.0_f64, false), (1e-20, false), (1.0, true), (1e-20, true)] {
            let square = |x: f64| x * x + height;
            let never = |p: &[f64; 1]| [if root { square(p[0]).sqrt() } else { square(p[0]) }];
            for start in [0.3, 0.577, 1.0, 1e-10, 3e-9] {
                let change = |p: &[f64; 1]| [-square(p[0]) / (if root { p[0] } else { 2.0 * p[0] })];
                let end = newton([start * height.sqrt()], change, never);
                assert!(end.is_err(), "{height} {root} {start} {end:?}");
            }
        }
    }

    /// √(x² + ε²) + 1, without a zero, bends at one place as if it jumped there.
    #[test]
    fn an_edge_that_is_rounded_is_not_rounding() {
        for edge in [1e-3_f64, 1e-7, 1e-9, 1e-12, 1e-15, 1e-20, 0.0] {
            let height = |x: f64| (x * x + edge * edge).sqrt() + 1.0;
            let change = |p: &[f64; 1]| {
                let [x] = *p;
                [-height(x) * (height(x) - 1.0) / x]
            };
            for start in [1.0, 0.7, -3.0, 1e-6, 1e-9] {
                let end = newton([start], change, |p: &[f64; 1]| [height(p[0])]);
                assert!(end.is_err(), "{edge} {start} {end:?}");
            }
        }
    }

    #[test]
    fn what_is_not_reached_is_said() {
        assert_eq!(newton([0.0, 0.0], change, circle).unwrap_err().iterations, 1);
        let never = newton([1.0_f32], |_| [1.0], |_| [2.0]).unwrap_err();
        assert_eq!(never, ProjectionError { iterations: 50, residual: 2.0 });
    }

    #[test]
    fn the_worst_constraint_is_named() {
        assert_eq!(worst([("a", 0.1), ("b", -0.2)]), StateFault { identity: "b", residual: -0.2 });
        assert!(worst([("a", 0.1), ("b", f64::NAN)]).residual.is_nan());
    }
}

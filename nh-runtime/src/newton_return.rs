//! Newton's iteration by which generated code returns to position constraints, and to linear ones on
//! velocities.

use crate::arrays::all_finite;
use crate::projection::{holds, largest};
use crate::rounding::{
    are_rounding, further, grow, is_last, is_level, is_settled, left_over, sizes, without_noise,
};
use crate::{ProjectionError, Scalar, StateFault};

/// The iterations after which a return is given up.
const MOST_ITERATIONS: u32 = 50;

/// The limit of x := x + change(x) from x = start.
///
/// The iteration stops where every residual is zero; where every variable changes by rounding of its own, or by not much
/// more and no longer less; and where the next change would be of that order: to first order it is to this one as the
/// residual that is left is to the one before, row by row. Near to where it leads it is one step. No two variables and no
/// two residuals are compared, so that units do not matter.
/// Where a variable is near to zero beside others, rounding is that of the terms of the equations: there it stops where
/// changes no longer fall and residuals are rounding beside their terms. Where one has come from eight times as far, its
/// rounding there is none here: it goes on while more than rounding is left of equations, and halves. Where all variables are near to zero, as upright
/// and at the origin, that is rounding of lengths inside the equations: residuals jump before and behind the way of the
/// change. A variable that rounding of the others changes by as much as it is becomes zero where the equations hold then: the
/// table of a lift that stays level, of which each step leaves rounding of rounding. Lanes stop together, when the last one does. Derivatives that numbers carry converge by further iterations.
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
    let mut most = sizes(&present);
    let mut preceding = None;
    let mut iterations = 0;
    let mut further = further::<T>();
    let mut is_there = false;
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
        grow(&mut most, &present);
        let is_end = || {
            is_settled(&moved, &most, preceding.as_ref())
                || is_last(&moved, &most, left_over(&before, &left))
                || (preceding.is_some_and(|preceding| is_level(&preceding, &moved))
                    && is_rounding(&present, &moved, (&before, &left), &residual))
        };
        // rounding of where a way began is not that of where it leads
        let is_on_its_way =
            || is_far(&most, &present) && still_falls(&present, &moved, (&before, &left), &residual);
        if is_there || (is_end() && !is_on_its_way()) {
            if further == 0 {
                break;
            }
            (is_there, further) = (true, further - 1);
        } else if further == 0 {
            let of_level = |preceding: [T; N]| {
                let steps = (&preceding, &moved);
                is_level(steps.0, steps.1).then(|| without_noise(&present, steps, &change, &residual))?
            };
            if let Some(zeroed) = preceding.and_then(of_level) {
                present = zeroed;
                break;
            }
        }
        preceding = Some(moved);
    }
    Ok(present)
}

/// Whether some variable, in some lane, is small beside where it has been.
fn is_far<T: Scalar, const N: usize>(most: &[T; N], present: &[T; N]) -> bool {
    let mut any = T::ZERO;
    for (most, present) in most.iter().zip(present) {
        any = any.max(most.select_gt(present.abs() * T::from_f64(FAR), T::ONE, T::ZERO));
    }
    !T::ZERO.all_ge(any)
}

/// Whether what is left of some equation, in some lane, is no rounding beside its terms and less than half of what was before.
#[cold]
fn still_falls<T: Scalar, const N: usize, const M: usize>(
    present: &[T; N],
    moved: &[T; N],
    (before, left): (&[T; M], &[T; M]),
    residual: impl Fn(&[T; N]) -> [T; M],
) -> bool {
    let mut any = T::ZERO;
    for (is_known, (before, left)) in
        are_rounding(present, moved, residual).iter().zip(before.iter().zip(left))
    {
        let halves = (before.abs() * T::from_f64(0.5)).select_gt(left.abs(), T::ONE, T::ZERO);
        any = any.max(halves * (T::ONE - *is_known));
    }
    !T::ZERO.all_ge(any)
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

/// Whether, in every lane, what is left of each equation is rounding: beside its terms, or of lengths inside of it. Then it
/// follows a multiple of the change that led here as smooth equations do, nearly linearly, and it jumps before and behind
/// its way, as smooth equations do at poles alone.
#[cold]
pub(crate) fn is_rounding<T: Scalar, const N: usize, const M: usize>(
    present: &[T; N],
    moved: &[T; N],
    (before, left): (&[T; M], &[T; M]),
    residual: impl Fn(&[T; N]) -> [T; M],
) -> bool {
    let after = |part: T| {
        let mut there = *present;
        for (x, moved) in there.iter_mut().zip(moved) {
            *x += (part - T::ONE) * *moved;
        }
        residual(&there)
    };
    let is_known = are_rounding(present, moved, &residual);
    let multiple = T::from_f64(MULTIPLE);
    let beyond = after(multiple);
    let equations = is_known.iter().zip(before.iter().zip(left)).zip(&beyond).enumerate();
    let mut open = T::ZERO;
    for (row, ((is_known, (before, left)), beyond)) in equations {
        let size = before.abs().max(left.abs());
        let is_open = size.select_gt(T::ZERO, T::ONE - *is_known, T::ZERO);
        if T::ZERO.all_ge(is_open) {
            continue;
        }
        let off = (*beyond - (T::ONE - multiple) * *before).abs() * T::from_f64(8.0);
        let follows = (size * multiple).select_gt(off, T::ONE, T::ZERO);
        let of_row = |part: T| after(part).get(row).copied().unwrap_or(T::ZERO);
        let mut is_noise = follows;
        for near in [-SURROUNDINGS, 1.0] {
            // a search takes many evaluations, and one that nothing rests on any more is left out
            if !T::ZERO.all_ge(is_noise) {
                is_noise *=
                    jumps_between(of_row, (T::from_f64(near), T::from_f64(near + SURROUNDINGS)), size);
            }
        }
        open = open.max(is_open * (T::ONE - is_noise));
        if !T::ZERO.all_ge(open) {
            return false;
        }
    }
    T::ZERO.all_ge(open)
}

/// 1 in lanes where a function jumps between two places, by no less than 1/8 of a size and far from poles, else 0.
pub(crate) fn jumps_between<T: Scalar>(
    mut function: impl FnMut(T) -> T,
    (mut near, mut far): (T, T),
    size: T,
) -> T {
    let half = T::from_f64(0.5);
    // the half in which values differ more, again and again
    let (mut at_near, mut at_far) = (function(near), function(far));
    for _ in 0..HALVINGS {
        let middle = half * (near + far);
        let there = function(middle);
        let (first, second) = ((at_near - there).abs(), (there - at_far).abs());
        near = second.select_gt(first, middle, near);
        far = second.select_gt(first, far, middle);
        at_near = second.select_gt(first, there, at_near);
        at_far = second.select_gt(first, at_far, there);
    }
    let jumps = ((at_near - at_far).abs() * T::from_f64(8.0)).select_gt(size, T::ONE, T::ZERO);
    let pole = size * T::from_f64(4.0 * SURROUNDINGS);
    jumps * pole.select_gt(at_near.abs().max(at_far.abs()), T::ONE, T::ZERO)
}

/// How many times smaller than where it has been a variable may be for rounding there to be rounding here.
const FAR: f64 = 8.0;
/// A multiple of a change of the size of rounding that is beyond its noise, and nothing beside the lengths of a machine.
pub(crate) const MULTIPLE: f64 = 1024.0;
/// How many changes before and behind one are searched for jumps: a few steps of rounding.
pub(crate) const SURROUNDINGS: f64 = 32.0;
/// How often the way is halved in the search for a jump: then its ends are neighbours among the numbers.
const HALVINGS: u32 = 60;

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
        // what is no number is worse than any number, and nothing is worse
        let is_worse = residual.is_nan() || residual.abs() > worst.residual.abs();
        if worst.identity.is_empty() || (is_worse && !worst.residual.is_nan()) {
            worst = StateFault { identity, residual };
        }
    }
    worst
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Jet;
    use core::cell::Cell;

    /// x² + y² = 1, along the gradient.
    fn circle([x, y]: &[f64; 2]) -> [f64; 1] {
        [x * x + y * y - 1.0]
    }
    fn change(p: &[f64; 2]) -> [f64; 2] {
        let factor = circle(p)[0] / (2.0 * (p[0] * p[0] + p[1] * p[1]));
        [-factor * p[0], -factor * p[1]]
    }

    /// What is rounding of a place that is far away is not rounding of the circle.
    #[test]
    fn from_far_away_it_ends_on_the_circle_or_nowhere() {
        for power in 0..100 {
            let far = 2.0_f64.powi(power);
            let Ok([x, y]) = newton([0.6 * far, 0.8 * far], change, circle) else {
                assert!(power > 44, "{power}");
                continue;
            };
            assert!((x * x + y * y - 1.0).abs() < 4e-15, "{power}: {x} {y}");
        }
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

    /// A table that stays level beside a height of rounding: each step leaves rounding of that in its angle.
    #[test]
    fn rounding_of_rounding_is_nothing() {
        let height = |x: f64| ((x + 0.3) - 0.6) + 2e-17;
        for unit in [1.0, 1e100, 1e-100] {
            let residual = |p: &[f64; 3]| [height(p[0]), p[1] / unit, p[2], (p[1] / unit) * p[2]];
            let signs = Cell::new(1.0);
            let change = |p: &[f64; 3]| {
                signs.set(-signs.get());
                let noise = 1e-17 * signs.get() * height(p[0]);
                [-height(p[0]), noise * unit - p[1], noise - p[2]]
            };
            // where nothing tells of them but their squares they are what is looked for
            let of_squares = |p: &[f64; 3]| residual(p).map(|left| left * left);
            assert!(newton([0.3, 1e-33 * unit, -1e-33], change, of_squares).is_err());
            for start in [[0.3 + 1e-9, 0.0, 0.0], [0.3, 1e-33 * unit, -1e-33], [0.31, 0.3 * unit, 1e-3]] {
                let [x, angle, other] = newton(start, change, residual).unwrap();
                assert!((x - 0.3).abs() < 2e-16 && angle.abs() < 1e-30 * unit, "{start:?} {x} {angle}");
                assert!(other.abs() < 1e-30, "{start:?} {other}");
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

    /// A crank and what slides on it, in any unit of each and of the equations, and beside a variable that is large.
    #[test]
    fn units_matter_to_nothing() {
        let ended = |[turn, length, row]: [f64; 3], large: f64, start: [f64; 2]| {
            let steps = Cell::new(0);
            let residual = |&[a, s, _]: &[f64; 3]| {
                let (a, s) = (a / turn, s / length);
                [(a.sin() - 0.3 * s) * row, s - 0.8 - 0.5 * a.cos() * a.cos()]
            };
            let change = |x: &[f64; 3]| {
                steps.set(steps.get() + 1);
                let (a, [f, g]) = (x[0] / turn, residual(x));
                let (slope, bend, f) = (a.cos(), a.cos() * a.sin(), f / row);
                let change = -(f + 0.3 * g) / (slope + 0.3 * bend);
                [change * turn, (-g - bend * change) * length, 0.0]
            };
            let [a, s, _] = newton([start[0] * turn, start[1] * length, large], change, residual).unwrap();
            assert_eq!(residual(&[a, s, large]).map(|left| left.abs() < 4e-16 * row.max(1.0)), [true; 2]);
            ([a / turn, s / length].map(f64::to_bits), steps.get())
        };
        for start in [[0.31, 1.2], [0.4, 0.0], [-1e-9, 1.5]] {
            let plain = ended([1.0; 3], 0.0, start);
            for power in [-200, -27, -3, 3, 27, 200] {
                let unit = 2.0_f64.powi(power);
                for units in [[unit, 1.0, 1.0], [1.0, unit, 1.0], [1.0, 1.0, unit], [unit, 1.0 / unit, unit]]
                {
                    assert_eq!(ended(units, 0.0, start), plain, "{units:?}");
                }
                assert_eq!(ended([1.0; 3], unit, start), plain, "{unit}");
            }
        }
    }

    /// Partial derivatives of all orders, also from a start that is on the constraint.
    #[test]
    fn derivatives_converge_with_the_numbers() {
        type Twice = Jet<Jet<f64, 1>, 1>;
        // x with x² = p, along its own axis
        for (start, p) in [(3.0, 9.0), (2.9, 9.0), (3.0 + 1e-9, 9.0), (1.0, 9.0)] {
            let inner = Jet { value: p, by: [1.0], by_others: [] };
            let p = Twice { value: inner, by: [Jet::constant(1.0)], by_others: [] };
            let residual = |x: &[Twice; 1]| [x[0] * x[0] - p];
            let change = |x: &[Twice; 1]| [-residual(x)[0] / (x[0] + x[0])];
            let [x] = newton([Twice::constant(Jet::constant(start))], change, residual).unwrap();
            let found = [x.value.value, x.value.by[0], x.by[0].value, x.by[0].by[0]];
            for (found, exact) in found.iter().zip([3.0, 1.0 / 6.0, 1.0 / 6.0, -1.0 / 108.0]) {
                assert!((found - exact).abs() < 1e-15, "{start} {found} {exact}");
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

    /// What is far from rounding is seen to be so before jumps are searched for, which takes hundreds of evaluations.
    #[test]
    fn what_is_not_rounding_is_seen_at_once() {
        let evaluations = Cell::new(0);
        let curve = |[x, y]: &[f64; 2]| {
            evaluations.set(evaluations.get() + 1);
            [x * x + y * y - 1.0, x - y.sin()]
        };
        let (before, here, moved) = ([0.9, 0.5], [0.8, 0.7], [-0.1, 0.2]);
        assert!(!is_rounding(&here, &moved, (&curve(&before), &curve(&here)), curve));
        assert!(evaluations.get() < 25, "{}", evaluations.get());
    }
}

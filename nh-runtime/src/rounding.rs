//! Where iterations end: what is rounding of variables, and of equations.
//!
//! Variables and equations have units of their own. So a change of a variable is compared with that variable alone, what
//! is left of an equation with what it was before or with its own terms, and nothing else but ratios of these.

use crate::{Real, Scalar};

/// How many iterations lead from numbers that have converged to partial derivatives that have: each of Newton's doubles the
/// orders that are right.
#[inline]
pub(crate) const fn further<T: Scalar>() -> u32 {
    u32::BITS - T::DERIVATIVES.leading_zeros()
}

/// Takes over absolute values that are larger.
#[inline]
pub(crate) fn grow<T: Scalar, const N: usize>(sizes: &mut [T; N], x: &[T; N]) {
    for (size, x) in sizes.iter_mut().zip(x) {
        *size = size.max(x.abs());
    }
}

/// Absolute values.
#[inline]
pub(crate) fn sizes<T: Scalar, const N: usize>(x: &[T; N]) -> [T; N] {
    x.map(Scalar::abs)
}

/// Whether, in every lane, the change of every variable is round-off beside its size: at most four units of the last place,
/// or less than 5000 where it no longer halves. How large that is shows in the sum with the size: lanes have no number
/// for it.
#[inline]
pub(crate) fn is_settled<T: Scalar, const N: usize>(
    change: &[T; N],
    sizes: &[T; N],
    preceding: Option<&[T; N]>,
) -> bool {
    let mut preceding = preceding.map(|preceding| preceding.iter());
    let mut open = T::ZERO;
    for (change, size) in change.iter().zip(sizes) {
        let change = change.abs();
        let beyond =
            |fraction: f64, then: T| (*size + change * T::from_f64(fraction)).select_gt(*size, then, T::ZERO);
        let still_falls = match preceding.as_mut().and_then(Iterator::next) {
            Some(preceding) => (preceding.abs() * T::from_f64(0.5)).select_gt(change, T::ONE, T::ZERO),
            None => T::ONE,
        };
        let large = beyond(1e-4, T::ONE);
        open = open.max(beyond(0.125, still_falls.max(large)));
    }
    T::ZERO.all_ge(open)
}

/// What is left of equations by what was before, of all together: infinite where one held before and does not any more.
#[inline]
pub(crate) fn left_over<T: Scalar, const M: usize>(before: &[T; M], left: &[T; M]) -> T {
    let mut sum = T::ZERO;
    for (before, left) in before.iter().zip(left) {
        let left = left.abs();
        // what holds is nothing beside nothing, too
        sum += left.select_gt(T::ZERO, left / before.abs(), left);
    }
    sum
}

/// Whether, in every lane, the next change would be round-off: to first order it is to this one as what is left of the
/// equations is to what was before.
#[inline]
pub(crate) fn is_last<T: Scalar, const N: usize>(change: &[T; N], sizes: &[T; N], left_over: T) -> bool {
    let mut visible = T::ZERO;
    for (change, size) in change.iter().zip(sizes) {
        let change = change.abs();
        // a variable that does not move, whatever is left
        let next = change.select_gt(T::ZERO, change * left_over, T::ZERO);
        visible += (*size + next) - *size;
    }
    T::ZERO.all_ge(visible)
}

/// Whether some variable, in some lane, changes about as much as before.
#[inline]
pub(crate) fn is_level<T: Scalar, const N: usize>(preceding: &[T; N], change: &[T; N]) -> bool {
    let mut any = T::ZERO;
    for (preceding, change) in preceding.iter().zip(change) {
        let (preceding, change) = (preceding.abs(), change.abs());
        let falls = (preceding * T::from_f64(0.5)).select_gt(change, T::ZERO, T::ONE);
        let grows = change.select_gt(preceding * T::from_f64(64.0), T::ZERO, T::ONE);
        let moves = change.select_gt(T::ZERO, T::ONE, T::ZERO);
        any = any.max(falls * grows * moves);
    }
    !T::ZERO.all_ge(any)
}

/// How often the range of exponents is halved in a search for the distance at which an equation changes.
const HALVINGS: u32 = 24;

/// How little moves an equation, and by how much: rounding of the numbers that it is the sum of. `moved` is the size of its
/// change by a distance; 0 where that is no number.
pub(crate) fn grain<T: Real>(moved: impl Fn(T) -> T) -> (T, T) {
    let (mut near, mut far) = (T::MIN_POSITIVE, T::MIN_POSITIVE.recip());
    for _ in 0..HALVINGS {
        let middle = near.sqrt() * far.sqrt();
        let is_near = moved(middle) == T::ZERO;
        (near, far) = if is_near { (middle, far) } else { (near, middle) };
    }
    (far, moved(far))
}

/// How often the terms of equations are looked at.
const PATTERNS: u32 = 6;

/// For each equation whether it is rounding beside its terms: what is left of it, and what a change of the variables makes of it; 1 or 0 in every lane.
///
/// Terms show in what moving all variables by half of their digits makes of an equation, each by a number of its own, so
/// that terms which cancel are seen. Those of numbers inside of an equation that cancel whatever the variables are show in
/// what moving these by a few roundings makes of it.
#[cold]
pub(crate) fn are_rounding<T: Scalar, const N: usize, const M: usize>(
    present: &[T; N],
    moved: &[T; N],
    residual: impl Fn(&[T; N]) -> [T; M],
) -> [T; M] {
    let here = residual(present);
    // half of the digits, and by how much a change is enlarged to be seen
    let part = half_of_the_digits();
    let multiple = of_precision(1_048_576.0, 256.0);
    let few = few_roundings();
    let (mut terms, mut changes, mut noise) = ([T::ZERO; M], [T::ZERO; M], [T::ZERO; M]);
    for pattern in 0..PATTERNS {
        let displaced = |direction: &[T; N], by: T| residual(&displaced(present, direction, by, pattern));
        let note = |most: &mut [T; M], there: [T; M], unit: T| {
            for (most, (there, here)) in most.iter_mut().zip(there.iter().zip(&here)) {
                *most = most.max((*there - *here).abs() / unit);
            }
        };
        note(&mut terms, displaced(present, part), part);
        note(&mut changes, displaced(moved, multiple), multiple);
        note(&mut noise, displaced(present, few), T::ONE);
    }
    let mut all = [T::ZERO; M];
    let measures = terms.iter().zip(&changes).zip(&noise);
    for (all, (here, ((terms, change), noise))) in all.iter_mut().zip(here.iter().zip(measures)) {
        let most = here.abs().max(*change);
        let is_beside_terms = (*terms + most * T::from_f64(1.0 / 32.0)).select_gt(*terms, T::ZERO, T::ONE);
        *all = most.select_gt(T::from_f64(8.0) * *noise, is_beside_terms, T::ONE);
    }
    all
}

/// The variables with zero in the place of those that changed by as much as they are: where the others change by rounding, all
/// equations are rounding beside their terms with these zeros, some equation passes zero there with each of them, and a few
/// roundings of the variables alter the change of each by an eighth of it or more. What is left of such a variable is rounding
/// of the other ones, which no further step makes less, and no term of its own equation tells of.
#[cold]
pub(crate) fn without_noise<T: Scalar, const N: usize, const M: usize>(
    present: &[T; N],
    (preceding, moved): (&[T; N], &[T; N]),
    change: impl Fn(&[T; N]) -> [T; N],
    residual: impl Fn(&[T; N]) -> [T; M],
) -> Option<[T; N]> {
    let (zeroed, others) = without_digits(present, moved)?;
    let is_noise = || {
        let mut other = T::ZERO;
        let (here, few) = (change(present), few_roundings::<T>());
        let mut noise = [T::ZERO; N];
        for pattern in 0..PATTERNS {
            let there = change(&displaced(present, present, few, pattern));
            for (noise, (there, here)) in noise.iter_mut().zip(there.iter().zip(&here)) {
                *noise = noise.max((*there - *here).abs());
            }
        }
        for (noise, (all, kept)) in noise.iter().zip(moved.iter().zip(&others)) {
            other = other.max((*all - *kept).abs().select_gt(*noise * T::from_f64(8.0), T::ONE, T::ZERO));
        }
        T::ZERO.all_ge(other)
    };
    let holds = || are_rounding(&zeroed, &others, &residual).iter().all(|one| one.all_ge(T::ONE));
    let is_left = !is_nothing(&others);
    let is_still = || is_settled(&others, &sizes(present), Some(preceding));
    let is_met = || {
        let mut open = T::ZERO;
        let here = residual(&zeroed);
        for (variable, (all, kept)) in moved.iter().zip(&others).enumerate() {
            let by = (*all - *kept) * T::from_f64(1024.0);
            let there = |by: T| {
                let mut there = zeroed;
                there.iter_mut().skip(variable).take(1).for_each(|x| *x += by);
                residual(&there)
            };
            let rows = here.iter().zip(there(by)).zip(there(-by));
            let crosses = rows.fold(T::ZERO, |crosses, ((here, ahead), behind)| {
                let (ahead, behind) = (ahead - *here, behind - *here);
                let bend = (ahead + behind).abs() * T::from_f64(8.0);
                crosses.max(ahead.abs().select_gt(bend, T::ONE, T::ZERO))
            });
            open = open.max(by.abs().select_gt(T::ZERO, T::ONE - crosses, T::ZERO));
        }
        T::ZERO.all_ge(open)
    };
    (is_left && is_still() && holds() && is_met() && is_noise()).then_some(zeroed)
}

/// The variables, and their changes, with zero in the place of those that changed by no less than 2⁻¹⁰ of themselves; none if
/// there are none of these, in any lane.
fn without_digits<T: Scalar, const N: usize>(present: &[T; N], moved: &[T; N]) -> Option<([T; N], [T; N])> {
    let (mut zeroed, mut others) = (*present, *moved);
    let mut any = T::ZERO;
    for ((x, moved), change) in zeroed.iter_mut().zip(&mut others).zip(moved) {
        let change = change.abs() * T::from_f64(1024.0);
        let size = x.abs();
        any = any.max(change.select_gt(size, size, T::ZERO));
        *x = change.select_gt(size, T::ZERO, *x);
        *moved = change.select_gt(size, T::ZERO, *moved);
    }
    (!T::ZERO.all_ge(any)).then_some((zeroed, others))
}

/// The variables with zero in the place of those that the next change leaves no digits of, where the equations hold so as well:
/// velocities of a machine at rest, which a search comes near to without end.
pub(crate) fn with_zeros<T: Scalar, const N: usize, const M: usize>(
    present: [T; N],
    change: &[T; N],
    residual: impl Fn(&[T; N]) -> [T; M],
) -> [T; N] {
    let zeroed = without_digits(&present, change).map(|(zeroed, _)| zeroed);
    let holds = |x: &[T; N]| are_rounding(x, &[T::ZERO; N], &residual).iter().all(|one| one.all_ge(T::ONE));
    zeroed.filter(holds).unwrap_or(present)
}

/// Whether all are zero, in every lane.
fn is_nothing<T: Scalar>(all: &[T]) -> bool {
    all.iter().all(|x| T::ZERO.all_ge(x.abs()))
}

/// Whether numbers have as many digits as `f64`, else as `f32`: the first of two, or the second.
fn of_precision<T: Scalar>(long: f64, short: f64) -> T {
    let is_long = T::ONE + T::from_f64(1.0 / 1_099_511_627_776.0);
    is_long.select_gt(T::ONE, T::from_f64(long), T::from_f64(short))
}

/// The root of a rounding of 1.
pub(crate) fn half_of_the_digits<T: Scalar>() -> T {
    of_precision(1.0 / 67_108_864.0, 1.0 / 4096.0)
}

/// A few roundings of 1.
fn few_roundings<T: Scalar>() -> T {
    of_precision(1.0 / 2_251_799_813_685_248.0, 1.0 / 4_194_304.0)
}

/// The variables, moved along a direction, each by a number of its own.
pub(crate) fn displaced<T: Scalar, const N: usize>(
    present: &[T; N],
    direction: &[T; N],
    by: T,
    pattern: u32,
) -> [T; N] {
    let mut there = *present;
    for (index, (x, along)) in (0_u32..).zip(there.iter_mut().zip(direction)) {
        *x += by * T::from_f64(weight(index, pattern)) * *along;
    }
    there
}

/// A number between 1 and 2, or −2 and −1, for each variable and pattern.
fn weight(index: u32, pattern: u32) -> f64 {
    let turned = index.wrapping_add(1).wrapping_mul(pattern * 2 + 1).wrapping_mul(40_503) & 0xffff;
    let size = 1.0 + f64::from(turned) / 65_536.0;
    if (turned >> pattern) & 1 == 0 { size } else { -size }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_is_compared_with_its_own_variable() {
        for unit in [1e-200, 1e-9, 1.0, 1e9, 1e200] {
            let sizes = [1.0, 0.3 * unit];
            assert!(is_settled(&[0.0, 1e-16 * unit], &sizes, None));
            assert!(!is_settled(&[0.0, 1e-14 * unit], &sizes, None));
            assert!(is_settled(&[0.0, 1e-14 * unit], &sizes, Some(&[0.0, 1.5e-14 * unit])));
            let ends = |left: [f64; 2]| is_last(&[0.0, 1e-9 * unit], &sizes, left_over(&[1.0, 0.0], &left));
            assert!(ends([1e-9, 0.0]));
            assert!(!ends([1e-6, 0.0]));
            assert!(!ends([1e-9, unit * 1e-9]));
            assert!(!ends([f64::NAN, 0.0]) && !ends([1e-9, f64::NAN]));
        }
    }

    #[test]
    fn what_is_left_is_compared_with_the_terms_of_its_equation() {
        for (unit, row) in [(1.0, 1.0), (1e-12, 1.0), (1e9, 1e-200), (1e-150, 1e150)] {
            // x − y beside terms that are equal, and a variable near to zero
            let left = |x: &[f64; 3]| [(x[0] - x[1] / unit) * row, (x[2] / unit + x[0] - 1.0) * row];
            let found = |x: [f64; 3], moved: [f64; 3]| are_rounding(&x, &moved, left).map(|one| one > 0.5);
            assert_eq!(
                found([1.0 + 4e-16, unit, 1e-20 * unit], [0.0, 1e-17 * unit, 1e-17 * unit]),
                [true; 2]
            );
            assert_eq!(found([1.0 + 1e-13, unit, 1e-20 * unit], [0.0; 3]), [false; 2]);
            assert_eq!(found([1.0, unit, 1e-20 * unit], [0.0, 0.0, 1e-12 * unit]), [true, false]);
        }
    }
}

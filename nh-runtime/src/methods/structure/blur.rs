//! What rounding makes of equations: it shows where the numbers that they are evaluated at are moved.

use crate::Real;
use crate::arrays::{Array, displaced};

/// The patterns in which numbers are moved apart: those at multiples of a period up, the others down.
pub(super) const PERIODS: [usize; 2] = [2, 3];
/// The part of numbers by which they are moved apart so that the terms of a sum show, also where it has a turning point.
pub(super) const PART: f64 = 1.0 / 8.0;

/// Four units of the last place of 1.
pub(super) fn few<T: Real>() -> T {
    T::from_f64(4.0) * T::EPSILON
}

/// Numbers with the signs of a pattern.
pub(super) fn signed<T: Real, V: Array<T>>(numbers: &V, period: usize) -> V {
    let mut signed = *numbers;
    let n = (signed.as_ref().len() / 2).max(1);
    for (place, number) in signed.as_mut().iter_mut().enumerate() {
        *number = if (place % n).is_multiple_of(period) { *number } else { -*number };
    }
    signed
}

/// Numbers moved apart by a part of each.
pub(super) fn apart<T: Real, V: Array<T>>(numbers: &V, part: T, period: usize) -> V {
    displaced(numbers, part, &signed(numbers, period))
}

/// Adds what moving apart makes of functions, by four units of what is moved by; what is no number there says nothing.
pub(super) fn add_changes<T: Real, V: Array<T>>(
    sum: &mut V,
    here: &V,
    part: T,
    moved: impl Fn(usize, T) -> V,
) {
    for period in PERIODS {
        let there = moved(period, part);
        for (sum, (there, here)) in sum.as_mut().iter_mut().zip(there.as_ref().iter().zip(here.as_ref())) {
            let change = (*there - *here).abs() * (few::<T>() / part);
            *sum += if change.is_finite() { change } else { T::ZERO };
        }
    }
}

/// What rounding makes of equations: four units of the last places of the numbers, which are as large as given, and of what
/// the equations are the sum of, which moving the numbers far apart shows.
pub(super) fn blur<T: Real, V: Array<T>>(numbers: &V, sizes: &V, equations: impl Fn(&V) -> V) -> V {
    let here = equations(numbers);
    let mut blur = here;
    blur.as_mut().fill(T::ZERO);
    for part in [T::from_f64(PART), few()] {
        add_changes(&mut blur, &here, part, |period, part| {
            equations(&displaced(numbers, part, &signed(sizes, period)))
        });
    }
    blur
}

/// Whether a number is no more than some times another, of two lists.
pub(super) fn is_within<T: Real, V: Array<T>>(row: usize, numbers: &V, others: &V) -> bool {
    let of = |list: &V| list.as_ref().get(row).map_or(T::ZERO, |number| number.abs());
    of(numbers) <= T::from_f64(MOST) * of(others)
}

/// How many times what rounding has been seen to do it may do at other places.
const MOST: f64 = 16.0;

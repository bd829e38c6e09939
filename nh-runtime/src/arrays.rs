//! Arithmetic on the arrays of a [`Dim`](crate::Dim).
//!
//! Loops run over zipped slices whose lengths are constants after inlining: they unroll, and there
//! is no index that could be out of bounds.

use crate::Scalar;

/// An array of numbers: `Dim::Vec<T>`.
pub trait Array<T>: Copy + AsRef<[T]> + AsMut<[T]> {}
impl<T, V: Copy + AsRef<[T]> + AsMut<[T]>> Array<T> for V {}

/// x + h k.
#[inline]
pub(crate) fn displaced<T: Scalar, V: Array<T>>(x: &V, h: T, k: &V) -> V {
    let mut sum = *x;
    for (s, k) in sum.as_mut().iter_mut().zip(k.as_ref()) {
        *s = k.mul_add(h, *s);
    }
    sum
}

/// c₀ k₀ + Σ c k over `rest`, in this order. The small increments are summed before they meet the
/// state, so that a step rounds against the size of the state only once.
#[inline]
pub(crate) fn combined<T: Scalar, V: Array<T>, const M: usize>((c0, k0): (T, &V), rest: [(T, &V); M]) -> V {
    let mut sum = *k0;
    for s in sum.as_mut() {
        *s *= c0;
    }
    for (c, k) in rest {
        for (s, k) in sum.as_mut().iter_mut().zip(k.as_ref()) {
            *s = k.mul_add(c, *s);
        }
    }
    sum
}

/// x + h (c₀ k₀ + Σ c k).
#[inline]
pub(crate) fn ahead<T: Scalar, V: Array<T>, const M: usize>(
    x: &V,
    h: T,
    first: (T, &V),
    rest: [(T, &V); M],
) -> V {
    if M == 0 { displaced(x, h * first.0, first.1) } else { displaced(x, h, &combined(first, rest)) }
}

/// Zero if every component is finite, and NaN otherwise.
#[inline]
#[allow(clippy::eq_op)] // x − x is NaN where x is not finite
pub(crate) fn nought<T: Scalar, V: Array<T>>(x: &V) -> T {
    x.as_ref().iter().fold(T::ZERO, |sum, x| sum + (*x - *x))
}

/// a − b.
#[inline]
pub(crate) fn difference<T: Scalar, V: Array<T>>(a: &V, b: &V) -> V {
    let mut d = *a;
    for (d, b) in d.as_mut().iter_mut().zip(b.as_ref()) {
        *d -= *b;
    }
    d
}

/// Whether every component is finite.
#[inline]
pub(crate) fn all_finite<T: Scalar, V: Array<T>>(x: &V) -> bool {
    x.as_ref().iter().fold(true, |finite, x| finite & x.is_finite())
}

/// The first component that is not finite, with its number.
#[cold]
pub(crate) fn first_non_finite<T: Scalar>(x: &[T]) -> Option<(usize, f64)> {
    x.iter().enumerate().find(|(_, x)| !x.is_finite()).map(|(i, x)| (i, x.to_f64()))
}

//! The inner sums of Taylor recurrences: what generated code keeps from order to order.
//!
//! A Cauchy product of order k is `a₀ b_k + a_k b₀ + Σ_{j=1}^{k−1} a_j b_{k−j}`. The inner sums of a whole
//! system depend on nothing of order k, so they are taken together, side by side in the lanes of
//! vector registers: the series of all left factors and those of all right factors are stored
//! order by order.

use crate::Scalar;

/// Up to so many products are summed where they are used.
const FEW: usize = 8;
/// Up to so many products are summed in two halves: there are registers for both.
const PAIRED: usize = 24;
/// Up to so many are summed at once, and blocks of so many where there are more.
const BLOCK: usize = 48;

/// sums + a b, lane by lane.
#[inline]
fn multiply_add<T: Scalar>(sums: &mut [T], a: &[T], b: &[T]) {
    for ((sum, a), b) in sums.iter_mut().zip(a).zip(b) {
        *sum = a.mul_add(*b, *sum);
    }
}

/// The products of `M` pairs of series and the squares of `N` series, in up to `P` orders.
///
/// It is made once and used for many expansions, each of which begins with
/// [`restart`](Self::restart): clearing it would cost as much as a good part of one.
#[derive(Clone, Copy, Debug)]
pub struct History<T, const M: usize, const N: usize, const P: usize> {
    left: [[T; M]; P],
    right: [[T; M]; P],
    squared: [[T; N]; P],
    orders: usize,
}

impl<T: Scalar, const M: usize, const N: usize, const P: usize> Default for History<T, M, N, P> {
    fn default() -> Self {
        let (products, squares) = ([T::ZERO; M], [T::ZERO; N]);
        Self { left: [products; P], right: [products; P], squared: [squares; P], orders: 0 }
    }
}

impl<T: Scalar, const M: usize, const N: usize, const P: usize> History<T, M, N, P> {
    /// Drops all orders: the first one added is order 1.
    #[inline]
    pub fn restart(&mut self) {
        self.orders = 0;
    }

    /// The inner sums of the products for the order after the last one added.
    #[inline]
    #[must_use]
    pub fn products(&self) -> [T; M] {
        if M <= FEW { self.paired() } else { self.many() }
    }

    /// Every other term in a sum of its own, so that neither waits for the other.
    #[inline]
    fn paired(&self) -> [T; M] {
        let left = self.left.get(..self.orders).unwrap_or_default();
        let right = self.right.get(..self.orders).unwrap_or_default();
        let (mut sums, mut others) = ([T::ZERO; M], [T::ZERO; M]);
        let (pairs, rest) = left.as_chunks::<2>();
        let (mirrored_rest, mirrored) = right.as_rchunks::<2>();
        for ([a0, a1], [b1, b0]) in pairs.iter().zip(mirrored.iter().rev()) {
            multiply_add(&mut sums, a0, b0);
            multiply_add(&mut others, a1, b1);
        }
        for (sum, other) in sums.iter_mut().zip(&others) {
            *sum += *other;
        }
        for (a, b) in rest.iter().zip(mirrored_rest) {
            multiply_add(&mut sums, a, b);
        }
        sums
    }

    /// Never inlined: what uses the sums one by one would keep the compiler from using vectors.
    #[inline(never)]
    fn many(&self) -> [T; M] {
        if M <= PAIRED {
            return self.paired();
        }
        let left = self.left.get(..self.orders).unwrap_or_default();
        let right = self.right.get(..self.orders).unwrap_or_default();
        let mut sums = [T::ZERO; M];
        if M <= BLOCK {
            for (a, b) in left.iter().zip(right.iter().rev()) {
                multiply_add(&mut sums, a, b);
            }
            return sums;
        }
        let (blocks, rest) = sums.as_chunks_mut::<BLOCK>();
        for (index, block) in blocks.iter_mut().enumerate() {
            let mut sums = [T::ZERO; BLOCK];
            for (a, b) in left.iter().zip(right.iter().rev()) {
                let of = |row: &[T; M]| row.as_chunks::<BLOCK>().0.get(index).copied();
                if let (Some(a), Some(b)) = (of(a), of(b)) {
                    multiply_add(&mut sums, &a, &b);
                }
            }
            *block = sums;
        }
        for (a, b) in left.iter().zip(right.iter().rev()) {
            multiply_add(rest, a.as_chunks::<BLOCK>().1, b.as_chunks::<BLOCK>().1);
        }
        sums
    }

    /// Those of the squares, at half the work: 2 Σ_{j<k/2} a_j a_{k−j}, and the square in the middle.
    #[inline(never)]
    #[must_use]
    pub fn squares(&self) -> [T; N] {
        let mut sums = [T::ZERO; N];
        let series = self.squared.get(..self.orders).unwrap_or_default();
        let half = series.get(..self.orders / 2).unwrap_or_default();
        for (a, b) in half.iter().zip(series.iter().rev()) {
            multiply_add(&mut sums, a, b);
        }
        for sum in &mut sums {
            *sum += *sum;
        }
        if self.orders % 2 == 1
            && let Some(middle) = series.get(self.orders / 2)
        {
            multiply_add(&mut sums, middle, middle);
        }
        sums
    }

    /// Adds an order, as long as there is room.
    #[inline]
    pub fn add(&mut self, left: [T; M], right: [T; M], squared: [T; N]) {
        let at = self.orders;
        if let (Some(l), Some(r), Some(s)) =
            (self.left.get_mut(at), self.right.get_mut(at), self.squared.get_mut(at))
        {
            (*l, *r, *s) = (left, right, squared);
            self.orders += 1;
        }
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp)] // small integers are exact
mod tests {
    use super::*;

    #[test]
    fn inner_sums_are_those_of_the_cauchy_product() {
        let a = [2.0_f64, 3.0, 5.0, 7.0];
        let b = [11.0, 13.0, 17.0, 19.0];
        let mut history = History::<_, 1, 1, 4>::default();
        for _ in 0..2 {
            history.restart();
            for k in 0..=4 {
                let product: f64 = (0..k).map(|j| a[j] * b[k - 1 - j]).sum();
                let square: f64 = (0..k).map(|j| a[j] * a[k - 1 - j]).sum();
                assert_eq!((history.products(), history.squares()), ([product], [square]), "{k}");
                if k < 4 {
                    history.add([a[k]], [b[k]], [a[k]]);
                }
            }
            // beyond the capacity nothing happens
            history.add([1.0], [1.0], [1.0]);
            assert_eq!(history.squares(), [2.0 * 2.0 * 7.0 + 2.0 * 3.0 * 5.0]);
        }
    }
}

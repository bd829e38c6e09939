//! First order in all variables, a few directions at a time.

use core::array;

use super::Parts;
use crate::{Jet, Scalar};

/// Directions at a time: as many numbers as a register of four holds.
///
/// With all of a machine's variables at once its equations are one block of tens of thousands of operations, for which a
/// compiler that optimises takes minutes.
const AT_ONCE: usize = 4;

/// A number with its derivatives in some directions.
pub type Directed<T> = Jet<T, AT_ONCE>;

/// Everything to first order in N components of the state and M inputs, from what is the same in some directions.
#[must_use]
pub fn to_first_order<T: Scalar, const N: usize, const M: usize, const R: usize, const P: usize>(
    state: [T; N],
    input: [T; M],
    parts: impl Fn([Directed<T>; N], [Directed<T>; M]) -> Parts<Directed<T>, N, R, P>,
) -> Parts<Jet<T, N, M>, N, R, P> {
    let mut all = Parts { residuals: [Jet::ZERO; R], rates: [Jet::ZERO; N], outputs: [Jet::ZERO; P] };
    for first in (0..(N + M).max(1)).step_by(AT_ONCE) {
        let found = parts(
            array::from_fn(|index| variable(&state, index, index, first)),
            array::from_fn(|index| variable(&input, index, N + index, first)),
        );
        take(&mut all.residuals, &found.residuals, first);
        take(&mut all.rates, &found.rates, first);
        take(&mut all.outputs, &found.outputs, first);
    }
    all
}

/// The variable number `own` of all, where the directions are those from `first` on.
fn variable<T: Scalar, const K: usize>(
    values: &[T; K],
    index: usize,
    own: usize,
    first: usize,
) -> Directed<T> {
    let value = values.get(index).copied().unwrap_or(T::ZERO);
    let by = array::from_fn(|direction| if first + direction == own { T::ONE } else { T::ZERO });
    Jet { by, ..Jet::constant(value) }
}

/// Takes up the values and their derivatives in the directions from `first` on.
fn take<T: Scalar, const N: usize, const M: usize, const K: usize>(
    all: &mut [Jet<T, N, M>; K],
    found: &[Directed<T>; K],
    first: usize,
) {
    for (jet, found) in all.iter_mut().zip(found) {
        jet.value = found.value;
        let entries = jet.by.iter_mut().chain(&mut jet.by_others).skip(first);
        for (entry, derivative) in entries.zip(found.by) {
            *entry = derivative;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The same bits as with all directions at once, for fewer and for more of them than are taken at a time.
    #[test]
    fn some_directions_at_a_time_are_all_of_them() {
        fn parts<J: Scalar, const N: usize, const M: usize>(x: [J; N], u: [J; M]) -> Parts<J, N, 1, 2> {
            let sum =
                x.into_iter().chain(u).fold(J::ONE, |sum, x| sum.mul_add(x, x.sin()) / (J::ONE + x * x));
            Parts { residuals: [sum * sum], rates: x.map(|x| x * sum), outputs: [sum, sum.exp()] }
        }
        fn compare<const N: usize, const M: usize>() {
            let numbers =
                |from: usize, index: usize| 0.375 + f64::from(u8::try_from(from + index).unwrap()) / 8.0;
            let x: [f64; N] = array::from_fn(|i| numbers(0, i));
            let u: [f64; M] = array::from_fn(|i| numbers(N, i));
            let found = to_first_order(x, u, parts);
            let inputs: [Jet<f64, N, M>; M] = array::from_fn(|i| Jet {
                by_others: array::from_fn(|j| if i == j { 1.0 } else { 0.0 }),
                ..Jet::constant(u[i])
            });
            let at_once = parts(Jet::<f64, N, M>::variables(x), inputs);
            assert_eq!(found.residuals, at_once.residuals);
            assert_eq!(found.rates, at_once.rates);
            assert_eq!(found.outputs, at_once.outputs);
        }
        compare::<1, 0>();
        compare::<2, 2>();
        compare::<3, 2>();
        compare::<8, 0>();
        compare::<11, 4>();
    }
}

//! What derivatives of a motion may err by.

use super::motion::WithColumns;
use super::stack::{Columns, Stacked};
use crate::tolerance::{Tolerance, Uniform};
use crate::{D, IntegrationError, Real, State};

/// Tolerances of a state and, beside them, of its columns of derivatives: a step is accepted if the error of the state
/// and that of every column are permitted, each by the mean over its own components.
///
/// A column ∂x/∂s has other units than the state: its tolerance is that of s times the column, for a given size of s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ColumnTolerance<T, W, V, const K: usize> {
    state: W,
    columns: Option<V>,
    sizes: [T; K],
}

impl<T: Real, const K: usize> ColumnTolerance<T, Uniform<T>, Uniform<T>, K> {
    /// This relative tolerance for the state and the columns, and the same absolute one.
    #[must_use]
    pub fn new(state: T, columns: T) -> Self {
        let uniform = |rtol| Uniform { rtol, atol: None };
        Self { state: uniform(state), columns: Some(uniform(columns)), sizes: [T::ONE; K] }
    }
}

impl<T: Real, W, const K: usize> ColumnTolerance<T, W, Uniform<T>, K> {
    /// The error of the state alone decides about steps, which are then those of an integration without columns, to
    /// rounding where a derivative and its Jacobians are one program, as in generated systems: these
    /// become the derivatives of the steps that are taken.
    #[must_use]
    pub fn of_state(state: W) -> Self {
        Self { state, columns: None, sizes: [T::ONE; K] }
    }
}

impl<T: Real, W, V, const K: usize> ColumnTolerance<T, W, V, K> {
    /// Tolerances of the state and of the columns, [`Uniform`](crate::methods::Uniform) or
    /// [`PerComponent`](crate::methods::PerComponent).
    #[must_use]
    pub fn of_both(state: W, columns: V) -> Self {
        Self { state, columns: Some(columns), sizes: [T::ONE; K] }
    }

    /// How large what each column is taken by is: the column times this is measured by the tolerance. 1 if not given.
    #[must_use]
    pub fn sizes(mut self, sizes: [T; K]) -> Self {
        self.sizes = sizes;
        self
    }
}

impl<X, T, W, V, const N: usize, const K: usize> Tolerance<WithColumns<X, K>> for ColumnTolerance<T, W, V, K>
where
    T: Real,
    X: State<Scalar = T, Dim = D<N>>,
    W: Tolerance<X>,
    V: Tolerance<X>,
    D<K>: Columns,
{
    fn check(&self) -> Result<(), IntegrationError> {
        self.state.check()?;
        let Some(columns) = &self.columns else { return Ok(()) };
        columns.check()?;
        match self.sizes.iter().find(|size| !(**size > T::ZERO && size.is_finite())) {
            None => Ok(()),
            Some(size) => Err(IntegrationError::Setting {
                setting: "sizes",
                value: size.to_f64(),
                expected: "positive and finite",
            }),
        }
    }

    fn permitted(&self, x: &Stacked<T, N, K>) -> Stacked<T, N, K> {
        let mut permitted = *x;
        let (state, columns) = permitted.parts_mut();
        *state = self.state.permitted(state);
        for (column, size) in columns.iter_mut().zip(self.sizes) {
            *column = match &self.columns {
                Some(tolerance) => tolerance.permitted(&column.map(|x| x * size)).map(|x| x / size),
                // what is not looked at may be anything
                None => [T::from_f64(f64::INFINITY); N],
            };
        }
        permitted
    }

    #[inline]
    fn mean_square(&self, e: &Stacked<T, N, K>, x0: &Stacked<T, N, K>, x1: &Stacked<T, N, K>) -> T {
        let (e, x0, x1) = (e.parts(), x0.parts(), x1.parts());
        let mut worst = self.state.mean_square(e.0, x0.0, x1.0);
        if let Some(tolerance) = &self.columns {
            for (((e, x0), x1), size) in e.1.iter().zip(x0.1).zip(x1.1).zip(self.sizes) {
                let sized = |x: &[T; N]| x.map(|x| x * size);
                worst = worst.max(tolerance.mean_square(&sized(e), &sized(x0), &sized(x1)));
            }
        }
        worst
    }
}

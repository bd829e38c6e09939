//! Symmetric positive definite systems: A = L Lᵀ (Golub, Van Loan, Matrix Computations, 4.2.5).

use nalgebra::{SMatrix, SVector};

use super::{ControlError, Entry};

/// The lower triangular factor of a positive definite matrix.
pub(super) struct Cholesky<T, const N: usize> {
    lower: SMatrix<T, N, N>,
}

impl<T: Entry, const N: usize> Cholesky<T, N> {
    /// Factorizes a symmetric matrix, of which the lower triangle is read.
    pub(super) fn new(name: &'static str, a: &SMatrix<T, N, N>) -> Result<Self, ControlError> {
        let mut lower = SMatrix::<T, N, N>::zeros();
        for j in 0..N {
            let dot = |rows: &SMatrix<T, N, N>, i: usize| {
                (0..j).fold(T::ZERO, |sum, k| sum + rows[(i, k)] * rows[(j, k)])
            };
            let pivot = a[(j, j)] - dot(&lower, j);
            if !(pivot > T::ZERO && pivot.is_finite()) {
                return Err(ControlError::NotDefinite { matrix: name, pivot: pivot.to_f64() });
            }
            let root = pivot.sqrt();
            lower[(j, j)] = root;
            for i in j + 1..N {
                lower[(i, j)] = (a[(i, j)] - dot(&lower, i)) / root;
            }
        }
        Ok(Self { lower })
    }

    /// L.
    pub(super) fn lower(&self) -> &SMatrix<T, N, N> {
        &self.lower
    }

    /// L⁻¹ b.
    pub(super) fn whitened(&self, b: &SVector<T, N>) -> SVector<T, N> {
        let mut x = *b;
        for i in 0..N {
            let known = (0..i).fold(T::ZERO, |sum, k| sum + self.lower[(i, k)] * x[k]);
            x[i] = (x[i] - known) / self.lower[(i, i)];
        }
        x
    }

    /// A⁻¹ b for every column b.
    pub(super) fn solve<const C: usize>(&self, b: &SMatrix<T, N, C>) -> SMatrix<T, N, C> {
        let mut x = *b;
        for c in 0..C {
            for i in 0..N {
                let known = (0..i).fold(T::ZERO, |sum, k| sum + self.lower[(i, k)] * x[(k, c)]);
                x[(i, c)] = (x[(i, c)] - known) / self.lower[(i, i)];
            }
            for i in (0..N).rev() {
                let known = (i + 1..N).fold(T::ZERO, |sum, k| sum + self.lower[(k, i)] * x[(k, c)]);
                x[(i, c)] = (x[(i, c)] - known) / self.lower[(i, i)];
            }
        }
        x
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{matrix, vector};

    #[test]
    fn it_solves_and_refuses() {
        let a = matrix![4.0, 2.0, 1.0; 2.0, 5.0, 3.0; 1.0, 3.0, 6.0];
        let x = vector![1.0, -2.0, 0.5];
        let factors = Cholesky::new("a", &a).unwrap();
        assert!((factors.solve(&(a * x)) - x).norm() < 1e-14);
        let white = factors.whitened(&x);
        assert!((factors.lower() * white - x).norm() < 1e-14);
        let indefinite = matrix![1.0, 2.0; 2.0, 1.0];
        assert_eq!(
            Cholesky::new("a", &indefinite).err(),
            Some(ControlError::NotDefinite { matrix: "a", pivot: -3.0 })
        );
    }
}

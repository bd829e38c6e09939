//! Costs that are sums of squares, differentiated exactly.

use nalgebra::{SMatrix, SVector};

use super::{Cost, Entry, Expansion};
use crate::{Jet, Scalar};

/// The numbers whose squares are to be small, each weighted by the user: the residuals.
///
/// They are handed over one by one, and written once for any [`Scalar`]: [`Squares`] differentiates
/// them.
pub trait Residuals<const N: usize, const M: usize> {
    /// The residuals of a tick.
    fn stage<S: Scalar>(&self, tick: usize, x: &[S; N], u: &[S; M], add: impl FnMut(S));
    /// The residuals of the state at the end.
    fn end<S: Scalar>(&self, x: &[S; N], add: impl FnMut(S));
}

/// ½ Σ r² over all [`Residuals`] r, as a [`Cost`].
///
/// The first derivatives are exact, by [`Jet`]s; the second ones are those of Gauss and Newton, Σ ∇r ∇rᵀ,
/// which are never indefinite, and exact where the residuals are linear or vanish (Nocedal, Wright,
/// Numerical Optimization, 2006, 10.3). A bound on states becomes the residual
/// `weight * max(0, by how much it is exceeded)`.
///
/// ```
/// use nalgebra::{Vector2, vector};
/// use nonholonomic::Scalar;
/// use nonholonomic::control::{Cost, Residuals, Squares};
///
/// /// At the end a swing should be high and at rest; on the way the torque should be small.
/// struct Swing;
///
/// impl Residuals<2, 1> for Swing {
///     fn stage<S: Scalar>(&self, _tick: usize, _x: &[S; 2], [torque]: &[S; 1], mut add: impl FnMut(S)) {
///         add(S::from_f64(0.1) * *torque);
///     }
///     fn end<S: Scalar>(&self, [angle, rate]: &[S; 2], mut add: impl FnMut(S)) {
///         add(S::from_f64(10.0) * (S::ONE + angle.cos()));
///         add(*rate);
///     }
/// }
///
/// let x: Vector2<f64> = vector![0.0, 1.0];
/// let cost = Squares(Swing);
/// # let end = Cost::<f64, 2, 1>::end(&cost, &x);
/// # let slope = Cost::<f64, 2, 1>::end_expansion(&cost, &x).x;
/// assert_eq!(end, 200.5);
/// assert_eq!(slope, vector![0.0, 1.0]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Squares<R>(pub R);

impl<R, T, const N: usize, const M: usize> Cost<T, N, M> for Squares<R>
where
    R: Residuals<N, M>,
    T: Entry,
{
    fn stage(&self, tick: usize, x: &SVector<T, N>, u: &SVector<T, M>) -> T {
        let (x, u): ([T; N], [T; M]) = ((*x).into(), (*u).into());
        let mut sum = T::ZERO;
        self.0.stage(tick, &x, &u, |r| sum += r * r);
        sum * T::from_f64(0.5)
    }

    fn stage_expansion(&self, tick: usize, x: &SVector<T, N>, u: &SVector<T, M>) -> Expansion<T, N, M> {
        let mut sum = Expansion::zero();
        self.0.stage(tick, &by_state(x), &by_input(u), |r| add(&mut sum, &r));
        sum
    }

    fn end(&self, x: &SVector<T, N>) -> T {
        let x: [T; N] = (*x).into();
        let mut sum = T::ZERO;
        self.0.end(&x, |r| sum += r * r);
        sum * T::from_f64(0.5)
    }

    fn end_expansion(&self, x: &SVector<T, N>) -> Expansion<T, N, M> {
        let mut sum = Expansion::zero();
        self.0.end(&by_state(x), |r| add(&mut sum, &r));
        sum
    }
}

/// The components of the state as the first variables of jets.
fn by_state<T: Entry, const N: usize, const M: usize>(x: &SVector<T, N>) -> [Jet<T, N, M>; N] {
    Jet::variables((*x).into())
}

/// The components of the input as the other variables of jets.
fn by_input<T: Entry, const N: usize, const M: usize>(u: &SVector<T, M>) -> [Jet<T, N, M>; M] {
    let jets: [Jet<T, M, N>; M] = Jet::variables((*u).into());
    jets.map(|jet| Jet { value: jet.value, by: jet.by_others, by_others: jet.by })
}

/// Adds ½ r².
fn add<T: Entry, const N: usize, const M: usize>(sum: &mut Expansion<T, N, M>, r: &Jet<T, N, M>) {
    let (x, u) = (SVector::from(r.by), SVector::from(r.by_others));
    sum.x += x * r.value;
    sum.u += u * r.value;
    sum.xx += product(&x, &x);
    sum.ux += product(&u, &x);
    sum.uu += product(&u, &u);
}

/// a bᵀ.
fn product<T: Entry, const N: usize, const M: usize>(
    a: &SVector<T, N>,
    b: &SVector<T, M>,
) -> SMatrix<T, N, M> {
    a * b.transpose()
}

#[cfg(test)]
mod tests {
    use super::super::Quadratic;
    use super::*;
    use nalgebra::vector;

    /// The same as a [`Quadratic`], and a product of state and input.
    struct Mixed {
        product: f64,
    }

    impl Residuals<2, 1> for Mixed {
        fn stage<S: Scalar>(&self, _tick: usize, x: &[S; 2], u: &[S; 1], mut add: impl FnMut(S)) {
            add(S::from_f64(2.0) * (x[0] - S::from_f64(1.0)));
            add(S::from_f64(3.0) * x[1]);
            add(S::from_f64(0.5) * u[0]);
            add(S::from_f64(self.product) * x[0] * u[0]);
        }
        fn end<S: Scalar>(&self, x: &[S; 2], mut add: impl FnMut(S)) {
            add(S::from_f64(5.0) * (x[0] - S::from_f64(1.0)));
        }
    }

    #[test]
    fn linear_residuals_are_a_quadratic_cost() {
        let weights = Quadratic {
            goal: vector![1.0, 0.0],
            state: vector![4.0, 9.0],
            input: vector![0.25],
            end: vector![25.0, 0.0],
        };
        let squares = Squares(Mixed { product: 0.0 });
        let (x, u) = (vector![0.3, -0.7], vector![1.5]);
        let difference = squares.stage(0, &x, &u) - weights.stage(0, &x, &u);
        assert!(difference.abs() < 1e-15);
        let (ours, theirs) = (squares.stage_expansion(0, &x, &u), weights.stage_expansion(0, &x, &u));
        assert!((ours.x - theirs.x).norm() < 1e-15 && (ours.u - theirs.u).norm() < 1e-15);
        assert_eq!((ours.xx, ours.ux, ours.uu), (theirs.xx, theirs.ux, theirs.uu));
        let end: Expansion<f64, 2, 1> = squares.end_expansion(&x);
        assert!((end.x - weights.end_expansion(&x).x).norm() < 1e-14);
        assert_eq!(end.xx, weights.end_expansion(&x).xx);
    }

    #[test]
    fn state_and_input_of_a_product_are_told_apart() {
        let squares = Squares(Mixed { product: 2.0 });
        let (x, u) = (vector![0.3, -0.7], vector![1.5]);
        let with: Expansion<f64, 2, 1> = squares.stage_expansion(0, &x, &u);
        let without = Squares(Mixed { product: 0.0 }).stage_expansion(0, &x, &u);
        // r = 2 x u = 0.9, ∂r/∂x = 3, ∂r/∂u = 0.6
        assert!((with.x - without.x - vector![2.7, 0.0]).norm() < 1e-14);
        assert!((with.u - without.u - vector![0.54]).norm() < 1e-14);
        assert!((with.ux[(0, 0)] - 1.8).abs() < 1e-14 && with.ux[(0, 1)].abs() < 1e-14);
        assert!((with.xx[(0, 0)] - without.xx[(0, 0)] - 9.0).abs() < 1e-14);
        assert!((with.uu[(0, 0)] - without.uu[(0, 0)] - 0.36).abs() < 1e-14);
    }
}

//! Linearisation where constraints hold: the derivative of motions in coordinates of the constraint manifold.

use core::error::Error;
use core::fmt::{self, Display, Formatter};

use nalgebra::SMatrix;

use crate::linear::Factors;
use crate::{D, Dynamics, Jet, Real, State};

/// δż = A δz + B δu: a motion to first order, in coordinates z of the manifold where the constraints hold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OnConstraints<T, const K: usize, const M: usize> {
    /// In row i, the derivatives of ż_i by the coordinates z.
    pub a: SMatrix<T, K, K>,
    /// In row i, the derivatives of ż_i by the inputs.
    pub b: SMatrix<T, K, M>,
}

/// Why a motion could not be linearised where its constraints hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ChartError {
    /// A component of the state was chosen that it does not have.
    NoSuchComponent {
        /// The number of the component.
        index: usize,
    },
    /// The constraints leave another number of components free than were chosen.
    WrongNumber {
        /// How many were chosen.
        chosen: usize,
        /// How many there are to choose.
        free: usize,
    },
    /// The chosen components do not determine the others at the state.
    Singular,
    /// The derivatives at the state are not finite.
    NonFinite,
}

impl Display for ChartError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match *self {
            Self::NoSuchComponent { index } => {
                write!(f, "the state has no component number {index}: count from 0")
            }
            Self::WrongNumber { chosen, free } => {
                write!(
                    f,
                    "{chosen} components are chosen where the constraints leave {free} free: choose {free}"
                )
            }
            Self::Singular => {
                write!(f, "the chosen components do not determine the others at this state: choose others")
            }
            Self::NonFinite => write!(
                f,
                "the derivatives are not finite at this state: the mass matrix or the constraints may be singular"
            ),
        }
    }
}

impl Error for ChartError {}

/// The derivative of ẋ = F(t, x, u) in chosen components z of the state, as many as the constraints leave free:
///
/// A = Z ∂F/∂x T, B = Z ∂F/∂u, mathematics (36), where Z picks z from the state, and the columns of T are the
/// changes of the state that keep all constraints and change one z by 1 each.
///
/// The system computes with [`Jet`]s, whose partial derivatives are exact; the state has to be where its constraints
/// hold, and the inputs are numbers and what makes the system's inputs of them (`PendulumInput::from`). `chart` lists the components z by their numbers. The eigenvalues of A do not depend on the choice at
/// equilibria and relative equilibria. Systems over an embedded base (`on`) are not meant.
///
/// # Errors
/// If the chosen components are no coordinates of the manifold there.
///
/// # Examples
///
/// ```
/// use nonholonomic::prelude::*;
/// use nonholonomic::{Jet, linearize_on_constraints};
///
/// #[nonholonomic(
///     base { x, y }
///     holonomic { rope: x^2 + y^2 = l^2; }
///     lagrangian { m / 2 * (der(x)^2 + der(y)^2) - m * g * y }
/// )]
/// #[derive(Clone, Copy, Debug)]
/// struct Pendulum<T> { m: T, l: T, g: T }
///
/// let pendulum = Pendulum { m: 2.0, l: 0.5, g: 9.81 }.map(Jet::<f64, 4>::constant);
/// // hanging, by its deflection and the rate of that
/// let found = linearize_on_constraints(&pendulum, 0.0, &[0.0, -0.5, 0.0, 0.0], (&[], |[]| ()), &[0, 2])?;
/// assert!((found.a[(1, 0)] + 9.81 / 0.5).abs() < 1e-13);
/// # impl<T> Pendulum<T> {
/// #     fn map<U>(self, f: impl Fn(T) -> U) -> Pendulum<U> { Pendulum { m: f(self.m), l: f(self.l), g: f(self.g) } }
/// # }
/// # Ok::<(), nonholonomic::ChartError>(())
/// ```
pub fn linearize_on_constraints<S, T, const N: usize, const M: usize, const K: usize>(
    system: &S,
    t: T,
    state: &[T; N],
    (input, named): (&[T; M], impl FnOnce([Jet<T, N, M>; M]) -> S::Input),
    chart: &[usize; K],
) -> Result<OnConstraints<T, K, M>, ChartError>
where
    T: Real,
    S: Dynamics,
    S::State: State<Scalar = Jet<T, N, M>, Dim = D<N>>,
{
    if let Some(index) = chart.iter().copied().find(|index| *index >= N) {
        return Err(ChartError::NoSuchComponent { index });
    }
    let jets = S::State::from_array(Jet::variables(*state));
    let time = Jet::constant(t);
    let mut inputs = input.map(Jet::constant);
    for (index, input) in inputs.iter_mut().enumerate() {
        if let Some(own) = input.by_others.get_mut(index) {
            *own = T::ONE;
        }
    }
    // one step of the return is the identity along the manifold, and leads there from beside it
    let mut returned = jets;
    system.correct_positions(time, &mut returned);
    let tangent = returned.to_array().map(|component| component.by);
    let rate = system.derivative(time, &jets, &named(inputs)).to_array();
    let rows = tangent.iter().chain(rate.iter().map(|component| &component.by));
    if !rows.flatten().all(|entry| entry.is_finite()) {
        return Err(ChartError::NonFinite);
    }
    let trace = tangent.iter().enumerate().filter_map(|(index, row)| row.get(index));
    let free = trace.fold(T::ZERO, |sum, entry| sum + *entry).to_f64();
    if (free - as_number(K)).abs() > 0.5 {
        return Err(ChartError::WrongNumber { chosen: K, free: nearest(free, N) });
    }
    let picked = chart.map(|index| tangent.get(index).copied().unwrap_or([T::ZERO; N]));
    let columns = columns(&tangent, &picked).ok_or(ChartError::Singular)?;
    let by = |index: usize| chart.get(index).and_then(|component| rate.get(*component));
    let along = |i: usize, j: usize| {
        let (Some(rate), Some(column)) = (by(i), columns.get(j)) else { return T::ZERO };
        rate.by.iter().zip(column).fold(T::ZERO, |sum, (a, x)| a.mul_add(*x, sum))
    };
    let of_input =
        |i: usize, j: usize| by(i).and_then(|rate| rate.by_others.get(j)).copied().unwrap_or(T::ZERO);
    let a = core::array::from_fn(|j| core::array::from_fn(|i| along(i, j)));
    let b = core::array::from_fn(|j| core::array::from_fn(|i| of_input(i, j)));
    Ok(OnConstraints { a: SMatrix::from(a), b: SMatrix::from(b) })
}

/// The columns of T = P Y with Z P Y = 1, where P leads to the manifold and `picked` is Z P.
fn columns<T: Real, const N: usize, const K: usize>(
    tangent: &[[T; N]; N],
    picked: &[[T; N]; K],
) -> Option<[[T; N]; K]> {
    let product = |a: &[T; N], b: &[T; N]| a.iter().zip(b).fold(T::ZERO, |sum, (a, b)| a.mul_add(*b, sum));
    let gram = picked.map(|row| picked.map(|other| product(&row, &other)));
    let factors = Factors::<D<K>, T>::new(&gram);
    let mut columns = [[T::ZERO; N]; K];
    for (index, column) in columns.iter_mut().enumerate() {
        let mut unit = [T::ZERO; K];
        if let Some(entry) = unit.get_mut(index) {
            *entry = T::ONE;
        }
        let weights = factors.solve(&unit);
        let mut through = [T::ZERO; N];
        for (row, weight) in picked.iter().zip(&weights) {
            for (sum, entry) in through.iter_mut().zip(row) {
                *sum = entry.mul_add(*weight, *sum);
            }
        }
        *column = tangent.map(|row| product(&row, &through));
        if !column.iter().all(|entry| entry.is_finite()) {
            return None;
        }
    }
    Some(columns)
}

fn as_number(count: usize) -> f64 {
    u32::try_from(count).map_or(f64::INFINITY, f64::from)
}

/// The count up to `most` that is nearest to a number.
fn nearest(number: f64, most: usize) -> usize {
    (0..=most).find(|count| number < as_number(*count) + 0.5).unwrap_or(most)
}

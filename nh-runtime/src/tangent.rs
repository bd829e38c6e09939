//! Linearisation where constraints hold: the derivative of motions in coordinates of the constraint manifold.

use core::error::Error;
use core::fmt::{self, Display, Formatter};

use nalgebra::SMatrix;

use crate::linear_model::{Uncertain, beside, reduce};
use crate::{D, Dynamics, Jet, Real, State};

/// δż = A δz + B δu: a motion to first order, in coordinates z of the manifold where the constraints hold.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
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
    /// There are no position constraints whose return shows the manifold.
    NoPositions,
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
            Self::NoPositions => write!(
                f,
                "the system has no position constraints, whose return shows the manifold: name variables in \
                 `linearization {{ keep: … }}` and call `linearize`"
            ),
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

/// The derivative of ẋ = F(t, x, u) of a system with position constraints in chosen components z of the state, as many as the constraints leave free:
///
/// A = Z ∂F/∂x T, B = Z ∂F/∂u, mathematics (36), where Z picks z from the state, and the columns of T are the
/// changes of the state that keep all constraints and change one z by 1 each.
///
/// The system computes with [`Jet`]s, whose partial derivatives are exact; the state has to be where its constraints
/// hold. `input` has the numbers of the inputs, and `named` makes the system's inputs of them (`PendulumInput::from`).
/// `chart` lists the components z by their numbers. The eigenvalues of A do not depend on the choice at
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
/// let found = linearize_on_constraints(&pendulum, 0.0, &[0.0, -0.5, 0.0, 0.0], &[], |[]| (), &[0, 2])?;
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
    input: &[T; M],
    named: impl FnOnce([Jet<T, N, M>; M]) -> S::Input,
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
    if !system.has_positions() {
        return Err(ChartError::NoPositions);
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
    let leads = |state: [T; N]| {
        let mut returned = S::State::from_array(Jet::variables(state));
        system.correct_positions(time, &mut returned);
        returned.to_array().map(|component: Jet<T, N, M>| component.by)
    };
    let tangent = leads(*state);
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
    let [one, other] = beside(state).map(leads);
    let columns =
        columns(&tangent, &[one, other, as_product(&tangent)], chart).ok_or(ChartError::Singular)?;
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

/// The columns of T: those of P in echelon form, with 1 in the row of one chosen component and 0 in those of the others.
/// `nearby` is P at other roundings of the state.
fn columns<T: Real, const N: usize, const K: usize>(
    tangent: &[[T; N]; N],
    nearby: &[[[T; N]; N]; 3],
    chart: &[usize; K],
) -> Option<[[T; N]; K]> {
    let is_chosen = |component: usize| chart.contains(&component);
    let spanning =
        Uncertain::new(&transposed(tangent), &[T::ZERO; N], &nearby.map(|p| transposed(&p)), is_chosen);
    let reduced = reduce(&spanning, |_| true, |component| is_chosen(component).then_some(0));
    if !chart.iter().all(|component| reduced.is_pivot(*component)) {
        return None;
    }
    let change = |of: usize, component: usize| {
        if of == component { T::ONE } else { -reduced.change(of, component) }
    };
    Some(chart.map(|of| core::array::from_fn(|component| change(of, component))))
}

/// P with the rounding added to it of P P and (1 − P)², which are P and 1 − P themselves: it is what a part of 1 is left of.
fn as_product<T: Real, const N: usize>(tangent: &[[T; N]; N]) -> [[T; N]; N] {
    let at = |i: usize, j: usize| tangent.get(i).and_then(|row| row.get(j)).copied().unwrap_or(T::ZERO);
    core::array::from_fn(|i| {
        core::array::from_fn(|j| {
            let rest = |i: usize, j: usize| if i == j { T::ONE - at(i, j) } else { -at(i, j) };
            let product = |k: usize| (at(i, k) * at(k, j)).abs() + (rest(i, k) * rest(k, j)).abs();
            let terms = (0..N).fold(T::ZERO, |sum, k| sum + product(k));
            at(i, j) + T::EPSILON * terms
        })
    })
}

fn transposed<T: Real, const N: usize>(rows: &[[T; N]; N]) -> [[T; N]; N] {
    core::array::from_fn(|i| {
        core::array::from_fn(|j| rows.get(j).and_then(|row| row.get(i)).copied().unwrap_or(T::ZERO))
    })
}

fn as_number(count: usize) -> f64 {
    u32::try_from(count).map_or(f64::INFINITY, f64::from)
}

/// The count up to `most` that is nearest to a number.
fn nearest(number: f64, most: usize) -> usize {
    (0..=most).find(|count| number < as_number(*count) + 0.5).unwrap_or(most)
}

//! A convex quadratic between bounds: the projected Newton method (Bertsekas, SIAM J. Control Optim.
//! 20 (1982) 221–246, as used by Tassa, Mansard, Todorov, ICRA 2014), with the steps of an active set (Nocedal, Wright,
//! Numerical Optimization, 2006, section 16.5) where what bounds leave of Newton's step does not lead down.

use nalgebra::{SMatrix, SVector};

use super::cholesky::Cholesky;
use super::{ControlError, Entry};
use crate::Scalar;

/// What a regularization makes positive, and what is finite where it is.
pub(super) const CURVATURE: &str = "the second derivative by the input";
/// Iterations that a problem may take; each fixes the set of active bounds anew.
const MOST_ITERATIONS: u32 = 40;

/// The minimum of ½ uᵀQu + qᵀu between bounds.
pub(super) struct Minimum<T, const M: usize> {
    /// Where it is.
    pub(super) at: SVector<T, M>,
    /// The components that are not held by a bound.
    pub(super) free: [bool; M],
    /// Q with the rows and columns of the others replaced by those of the unit matrix.
    pub(super) factors: Cholesky<T, M>,
}

/// Finds it, from `guess`. A lower bound above its upper one counts as equal to it.
pub(super) fn minimum<T: Entry, const M: usize>(
    hessian: &SMatrix<T, M, M>,
    slope: &SVector<T, M>,
    [lower, upper]: [&SVector<T, M>; 2],
    guess: &SVector<T, M>,
) -> Result<Minimum<T, M>, ControlError> {
    let clamp = |u: SVector<T, M>| u.zip_zip_map(lower, upper, |u, low, high| between(u, low, high));
    let value = |u: &SVector<T, M>| (u.dot(&(hessian * u))) * T::from_f64(0.5) + u.dot(slope);
    let mut at = clamp(*guess);
    let mut size = at.map(Scalar::abs);
    // the free components on which a whole step of Newton's has ended
    let mut ended: Option<[bool; M]> = None;
    for _ in 0..MOST_ITERATIONS {
        let gradient = hessian * at + slope;
        let free = held_by_none(&at, &gradient, lower, upper);
        let factors = Cholesky::new(CURVATURE, &masked(hessian, free))?;
        if ended == Some(free) {
            return Ok(Minimum { at, free, factors });
        }
        let newton = inwards(hessian, &gradient, (free, &factors), &at, [lower, upper])?;
        // Newton's step on the free components ends there, unless it meets a bound: behind that it goes on along the bounds
        // if this leads as far down as was promised, and ends there otherwise, which is down however bent the function is
        let promised = gradient.dot(&newton);
        let mut next = clamp(at + newton);
        if next != at + newton && value(&next) > value(&at) + T::from_f64(0.1) * promised {
            next = clamp(up_to_a_bound(&at, &newton, [lower, upper]));
        }
        let moved = (next - at).map(Scalar::abs);
        size = size.zip_map(&next, |size, next| size.max(Scalar::abs(next)));
        ended = (next == at + newton).then_some(free);
        at = next;
        // of each input in its own unit
        if moved.iter().zip(&size).all(|(moved, size)| *moved <= T::from_f64(4.0) * T::EPSILON * *size) {
            return Ok(Minimum { at, free, factors });
        }
    }
    let gradient = hessian * at + slope;
    let free = held_by_none(&at, &gradient, lower, upper);
    let factors = Cholesky::new(CURVATURE, &masked(hessian, free))?;
    Ok(Minimum { at, free, factors })
}

/// Newton's step on the free components, less those that stand at a bound and would leave by it: they are held as well.
/// Of what is free some component always moves away from its bound, as the step goes down.
fn inwards<T: Entry, const M: usize>(
    hessian: &SMatrix<T, M, M>,
    gradient: &SVector<T, M>,
    (mut free, factors): ([bool; M], &Cholesky<T, M>),
    at: &SVector<T, M>,
    [lower, upper]: [&SVector<T, M>; 2],
) -> Result<SVector<T, M>, ControlError> {
    let mut of_fewer = None;
    loop {
        let target = SVector::from_fn(|i, _| if is(free, i) { -gradient[i] } else { T::ZERO });
        let newton = of_fewer.as_ref().unwrap_or(factors).solve(&target);
        let leaves = |i: usize| {
            let is_down = newton[i] < T::ZERO && at[i] <= lower[i];
            is_down || (newton[i] > T::ZERO && at[i] >= upper[i])
        };
        let Some(leaving) = (0..M).find(|i| is(free, *i) && leaves(*i)) else { return Ok(newton) };
        free.iter_mut().skip(leaving).take(1).for_each(|free| *free = false);
        of_fewer = Some(Cholesky::new(CURVATURE, &masked(hessian, free))?);
    }
}

/// Where a step comes to the first bound, or ends.
fn up_to_a_bound<T: Entry, const M: usize>(
    at: &SVector<T, M>,
    step: &SVector<T, M>,
    [lower, upper]: [&SVector<T, M>; 2],
) -> SVector<T, M> {
    let bound = |i: usize| if step[i] < T::ZERO { lower[i] } else { upper[i] };
    let to_bound = |i: usize| if step[i] == T::ZERO { T::ONE } else { (bound(i) - at[i]) / step[i] };
    let shares = SVector::<T, M>::from_fn(|i, _| to_bound(i));
    let share = shares.iter().fold(T::ONE, |least, share| if *share < least { *share } else { least });
    // on the bound, not beside it by rounding
    SVector::from_fn(|i, _| {
        if step[i] != T::ZERO && shares[i] <= share { bound(i) } else { at[i] + step[i] * share }
    })
}

pub(super) fn between<T: Entry>(u: T, low: T, high: T) -> T {
    // a bound that is not a number holds nothing
    let above = if u < low { low } else { u };
    if above > high { high } else { above }
}

fn is<const M: usize>(free: [bool; M], i: usize) -> bool {
    free.get(i).copied().unwrap_or(false)
}

/// The components that neither bound holds against the gradient.
fn held_by_none<T: Entry, const M: usize>(
    at: &SVector<T, M>,
    gradient: &SVector<T, M>,
    lower: &SVector<T, M>,
    upper: &SVector<T, M>,
) -> [bool; M] {
    core::array::from_fn(|i| {
        let at_lower = at[i] <= lower[i] && gradient[i] > T::ZERO;
        let at_upper = at[i] >= upper[i] && gradient[i] < T::ZERO;
        !(at_lower || at_upper)
    })
}

fn masked<T: Entry, const M: usize>(hessian: &SMatrix<T, M, M>, free: [bool; M]) -> SMatrix<T, M, M> {
    SMatrix::from_fn(|i, j| match (is(free, i) && is(free, j), i == j) {
        (true, _) => hessian[(i, j)],
        (false, true) => T::ONE,
        (false, false) => T::ZERO,
    })
}

#[cfg(test)]
mod tests {
    use super::super::draws::Draws;
    use super::*;
    use nalgebra::{matrix, vector};

    /// The minimum over a grid of the box is never below what is found.
    #[test]
    fn nothing_in_the_box_is_lower() {
        let hessian = matrix![2.0, 1.9; 1.9, 2.5];
        let (lower, upper) = (vector![-1.0, -0.5], vector![0.3, 2.0]);
        let value = |u: SVector<f64, 2>, q: SVector<f64, 2>| 0.5 * u.dot(&(hessian * u)) + u.dot(&q);
        for k in 0..64 {
            let angle = f64::from(k) * 0.098_174_770_424_681_03;
            let q = vector![4.0 * angle.cos(), 4.0 * angle.sin()];
            let found = minimum(&hessian, &q, [&lower, &upper], &vector![9.0, -9.0]).unwrap();
            for i in 0..=40 {
                for j in 0..=40 {
                    let u = vector![-1.0 + 1.3 * f64::from(i) / 40.0, -0.5 + 2.5 * f64::from(j) / 40.0];
                    assert!(value(found.at, q) <= value(u, q) + 1e-12, "{q} {u} {}", found.at);
                }
            }
        }
    }

    /// Between bounds no component wants to move at the minimum, however unlike the curvatures are, and what bounds leave
    /// of Newton's step may lead upwards.
    #[test]
    fn it_is_found_however_unlike_the_curvatures_are() {
        let mut draws = Draws(1);
        for _ in 0..2000 {
            let mut half = SMatrix::<f64, 6, 6>::from_fn(|_, _| draws.draw() - 0.5);
            for mut column in half.column_iter_mut() {
                column *= 10.0_f64.powf(4.0 * draws.draw() - 2.0);
            }
            let hessian = super::super::symmetrized(&super::super::squares(&half));
            let size = hessian.trace().sqrt();
            let slope = SVector::<f64, 6>::from_fn(|_, _| (draws.draw() - 0.5) * size);
            let lower = SVector::<f64, 6>::from_fn(|_, _| (0.2 - draws.draw()).min(0.0));
            let upper = SVector::<f64, 6>::from_fn(|_, _| draws.draw());
            let Ok(found) = minimum(&hessian, &slope, [&lower, &upper], &SVector::zeros()) else { continue };
            let gradient = hessian * found.at + slope;
            for i in 0..6 {
                let wanted = between(found.at[i] - gradient[i] / hessian[(i, i)], lower[i], upper[i]);
                assert!((wanted - found.at[i]).abs() < 1e-6, "{hessian} {slope} {}", found.at);
            }
        }
    }

    #[test]
    fn without_bounds_in_the_way_it_is_newtons() {
        let hessian = matrix![2.0, 0.5; 0.5, 1.0];
        let (lower, upper) = (vector![-1e9, -1e9], vector![1e9, 1e9]);
        let found = minimum(&hessian, &vector![1.0, -3.0], [&lower, &upper], &vector![0.0, 0.0]).unwrap();
        assert!((hessian * found.at - vector![-1.0, 3.0]).norm() < 1e-14);
        assert_eq!(found.free, [true, true]);
    }
}

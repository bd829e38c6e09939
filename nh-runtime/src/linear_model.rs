//! Linearisation where constraints hold, by named variables: what `linearization { keep: …; }` generates stands on it.

mod directions;
mod elimination;
mod linearization_error;
mod scales;

use nalgebra::SMatrix;

use crate::{Dynamics, Jet, Real, Scalar, ScalarOf, rounding};
pub use directions::{Directed, to_first_order};
pub(crate) use elimination::{Reduced, Uncertain, beside, reduce};
pub use linearization_error::LinearizationError;
use scales::Scales;

/// What is taken for rounding of derivatives, in units of the last place: of the terms that they are the sum of, and of the
/// others, where these have no units.
const ROUNDING: f64 = 4096.0;

/// A motion to first order in some variables z of the state, δż = A δz + B δu and δh = C δz + D δu, with what rows and
/// columns are called.
///
/// Made by the method `linearize` that `linearization { keep: …; }` generates: A = Z (∂F/∂x) T, B = Z ∂F/∂u,
/// C = (∂h/∂x) T and D = ∂h/∂u, mathematics (36), where T leads along the manifold of all constraints.
///
/// # Examples
///
/// ```
/// use nonholonomic::prelude::*;
///
/// /// A cart with a pole on it; the place of the cart matters to nothing.
/// #[nonholonomic(
///     base { x, tilt }
///     lagrangian {
///         (M + m) / 2 * der(x)^2 + m * l * cos(tilt) * der(x) * der(tilt) + m * l^2 / 2 * der(tilt)^2
///             - m * g * l * cos(tilt)
///     }
///     forces { x: push; }
///     inputs { push }
///     outputs { height = l * cos(tilt); aside = l * sin(tilt); }
///     linearization { keep: tilt, der(x), der(tilt); }
/// )]
/// #[derive(Clone, Copy, Debug)]
/// struct Cart { M: f64, m: f64, l: f64, g: f64 }
///
/// let cart = Cart { M: 2.0, m: 1.0, l: 0.5, g: 9.81 };
/// let upright = CartState::default();
/// let found = cart.linearize(0.0, &upright, &CartInput::default())?;
/// assert_eq!(found.states, ["tilt", "x_dot", "tilt_dot"]);
/// assert_eq!((found.inputs, found.outputs), (["push"], ["height", "aside"]));
/// // l δẗ = (M + m)/M g δtilt − δpush/M
/// assert!((found.a[(2, 0)] - 3.0 / 2.0 * 9.81 / 0.5).abs() < 1e-13);
/// assert!((found.b[(2, 0)] + 1.0 / (2.0 * 0.5)).abs() < 1e-15);
/// assert_eq!((found.c[(0, 0)], found.c[(1, 0)]), (0.0, 0.5));
/// # Ok::<(), nonholonomic::LinearizationError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Linearization<T, const K: usize, const M: usize, const P: usize> {
    /// In row i, the derivatives of ż_i by the variables z.
    pub a: SMatrix<T, K, K>,
    /// In row i, the derivatives of ż_i by the inputs.
    pub b: SMatrix<T, K, M>,
    /// In row i, the derivatives of the output h_i by the variables z; what is not kept is held.
    pub c: SMatrix<T, P, K>,
    /// In row i, the derivatives of the output h_i by the inputs.
    pub d: SMatrix<T, P, M>,
    /// What the variables z are called.
    pub states: [&'static str; K],
    /// What the inputs are called.
    pub inputs: [&'static str; M],
    /// What the outputs are called.
    pub outputs: [&'static str; P],
}

/// What components are called: those of the state, the inputs, the outputs.
#[derive(Clone, Copy, Debug)]
pub struct Names<const N: usize, const M: usize, const P: usize> {
    /// Those of the state.
    pub states: [&'static str; N],
    /// Those of the inputs.
    pub inputs: [&'static str; M],
    /// Those of the outputs.
    pub outputs: [&'static str; P],
}

/// A motion of N components of a state with its outputs and with what vanishes on the constraint manifold, as numbers `J`
/// that carry derivatives.
#[derive(Clone, Copy, Debug)]
pub struct Parts<J, const N: usize, const R: usize, const P: usize> {
    /// What vanishes on the manifold.
    pub residuals: [J; R],
    /// The rates of the components.
    pub rates: [J; N],
    /// The outputs.
    pub outputs: [J; P],
}

/// A system that gives these.
pub trait FirstOrder: Dynamics {
    /// What vanishes on the manifold.
    type Residuals;
    /// [`Parts`] of its numbers of components.
    type Parts;

    /// Everything to first order at a state.
    fn first_order(&self, t: ScalarOf<Self>, state: &Self::State, input: &Self::Input) -> Self::Parts;

    /// What vanishes on the manifold, without derivatives.
    fn residuals(&self, t: ScalarOf<Self>, state: &Self::State, input: &Self::Input) -> Self::Residuals;
}

/// The linearisation in the components `kept`: mathematics (36).
///
/// # Errors
/// Where the state is not on the constraints, by more than the rounding of a number in single precision or of what the
/// constraints are made of; where the kept components are not free, or move with components that are not kept, by more
/// than rounding.
pub fn linearize<
    T: Real + nalgebra::Scalar,
    const N: usize,
    const M: usize,
    const P: usize,
    const R: usize,
    const K: usize,
>(
    (names, constraint_names): (&Names<N, M, P>, &[&'static str; R]),
    kept: &[usize; K],
    state: &[T; N],
    parts: impl FnOnce(&[T; N]) -> Parts<Jet<T, N, M>, N, R, P>,
    residuals_at: impl Fn(&[T; N]) -> [T; R],
) -> Result<Linearization<T, K, M, P>, LinearizationError> {
    let all = parts(state);
    check_numbers(names, constraint_names, &all)?;
    check_constraints(constraint_names, state, &all.residuals, residuals_at)?;
    let Parts { residuals, rates, outputs } = &all;
    let constraints = residuals.map(|residual| residual.by);
    let (by_state, by_input) = (rates.map(|rate| rate.by), rates.map(|rate| rate.by_others));
    let is_kept = |column: usize| kept.contains(&column);
    let equations = Uncertain::new(&constraints, &[T::ZERO; R], &[], |column| !is_kept(column));
    let reduced = reduce(&equations, |_| true, |column| (!is_kept(column)).then_some(0));
    if let Some(column) = reduced.bound() {
        return Err(LinearizationError::NotFree { kept: name(&names.states, column) });
    }
    // the change of what f = 0 determines, by a component that is free
    let change = |of: usize, column: usize| reduced.change(of, column);
    let along = |row: &dyn Fn(usize) -> T, column: usize| {
        (0..N).filter(|of| reduced.is_pivot(*of)).fold(row(column), |sum, of| {
            let change = change(of, column);
            if change == T::ZERO { sum } else { row(of).mul_add(change, sum) }
        })
    };
    let rate = |i: usize, column: usize| entry(&by_state, i, column);
    let output = |i: usize, column: usize| outputs.get(i).and_then(|output| output.by.get(column)).copied();
    let a = SMatrix::<T, K, K>::from_fn(|i, j| along(&|c| rate(at(kept, i), c), at(kept, j)));
    let c = SMatrix::<T, P, K>::from_fn(|i, j| along(&|c| output(i, c).unwrap_or(T::ZERO), at(kept, j)));
    let mut scales = None;
    let least = T::from_f64(ROUNDING) * T::EPSILON;
    for row in kept {
        let mut worst = None;
        for column in (0..N).filter(|column| !is_kept(*column) && !reduced.is_pivot(*column)) {
            let value = along(&|c| rate(*row, c), column);
            let terms =
                (0..N).filter(|of| reduced.is_pivot(*of)).map(|of| rate(*row, of) * change(of, column));
            let terms = terms.fold(rate(*row, column).abs(), |sum, term| sum + term.abs());
            if value.abs() <= least * terms {
                continue;
            }
            let scales = scales.get_or_insert_with(|| Scales::of_rates(&by_state));
            let size = scales.size(value, (*row, column));
            if size > least && worst.is_none_or(|(_, _, most): (usize, T, T)| size > most) {
                worst = Some((column, value, size));
            }
        }
        if let Some((column, value, _)) = worst {
            return Err(LinearizationError::DependsOnOthers {
                kept: name(&names.states, *row),
                other: name(&names.states, column),
                value: value.to_f64(),
            });
        }
    }
    let b = SMatrix::<T, K, M>::from_fn(|i, j| entry(&by_input, at(kept, i), j));
    let d = SMatrix::<T, P, M>::from_fn(|i, j| {
        outputs.get(i).and_then(|output| output.by_others.get(j)).copied().unwrap_or(T::ZERO)
    });
    let states = kept.map(|component| name(&names.states, component));
    Ok(Linearization { a, b, c, d, states, inputs: names.inputs, outputs: names.outputs })
}

/// Refuses what is not finite, by name where it has a value.
fn check_numbers<T: Real, const N: usize, const M: usize, const R: usize, const P: usize>(
    names: &Names<N, M, P>,
    constraints: &[&'static str; R],
    Parts { residuals, rates, outputs }: &Parts<Jet<T, N, M>, N, R, P>,
) -> Result<(), LinearizationError> {
    let named = residuals.iter().zip(constraints);
    let mut all = named.chain(rates.iter().zip(&names.states)).chain(outputs.iter().zip(&names.outputs));
    match all.find(|(jet, _)| !jet.is_finite()) {
        None => Ok(()),
        Some((jet, of)) if jet.value.is_finite() => Err(LinearizationError::NotDifferentiable { of }),
        Some(_) => Err(LinearizationError::NotFinite),
    }
}

/// How far, relative to the terms of a constraint, a state that is given may be off it: far enough for what is rounded to
/// single precision.
const GIVEN: f64 = 1e-6;
/// So many roundings of the numbers that it is the sum of may be left of a constraint.
const GRAINS: f64 = 16.0;

/// Refuses a state that is off the constraints: each is compared with its own terms, and where these are near to zero with
/// the rounding of numbers inside of it.
fn check_constraints<T: Real, const N: usize, const M: usize, const R: usize>(
    names: &[&'static str; R],
    state: &[T; N],
    residuals: &[Jet<T, N, M>; R],
    values: impl Fn(&[T; N]) -> [T; R],
) -> Result<(), LinearizationError> {
    let permitted = Scalar::max(T::from_f64(GIVEN), T::EPSILON.sqrt());
    for (row, (residual, name)) in residuals.iter().zip(names).enumerate() {
        let term = |sum: T, (slope, x): (&T, &T)| sum + (*slope * *x).abs();
        let terms = residual.by.iter().zip(state).fold(T::ZERO, term);
        let left = residual.value;
        if left.abs() <= permitted * terms {
            continue;
        }
        let grain = |variable: usize| {
            let moved = |by: T| {
                let mut there = *state;
                if let Some(x) = there.get_mut(variable) {
                    *x += by;
                }
                let there = values(&there).get(row).copied().unwrap_or(left);
                if there.is_finite() { (there - left).abs() } else { T::ZERO }
            };
            rounding::grain(moved).1
        };
        let grain = (0..N).map(grain).fold(T::ZERO, Scalar::max);
        if left.abs() > T::from_f64(GRAINS) * grain {
            return Err(LinearizationError::OffConstraints { constraint: name, residual: left.to_f64() });
        }
    }
    Ok(())
}

fn at<const K: usize>(kept: &[usize; K], index: usize) -> usize {
    kept.get(index).copied().unwrap_or(usize::MAX)
}

fn entry<T: Real, const C: usize, const R: usize>(rows: &[[T; C]; R], row: usize, column: usize) -> T {
    rows.get(row).and_then(|row| row.get(column)).copied().unwrap_or(T::ZERO)
}

fn name<const N: usize>(names: &[&'static str; N], index: usize) -> &'static str {
    names.get(index).copied().unwrap_or("")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A mass with a weak spring to a place that is not kept, and an input in any unit.
    fn coupled(spring: f64, by_input: f64, unit: f64) -> Result<(), LinearizationError> {
        let jet = |by: [f64; 3], input: f64| Jet { value: 0.0, by, by_others: [input] };
        let rates = [
            jet([0.0, 0.0, 1.0], 0.0),
            jet([0.0, -1.0 / unit, 0.0], 0.0),
            jet([spring, -2.0 / unit, -0.3], by_input),
        ];
        let names = Names { states: ["place", "angle", "speed"], inputs: ["force"], outputs: [] };
        let parts = Parts::<_, 3, 0, 0> { residuals: [], rates, outputs: [] };
        linearize((&names, &[]), &[1, 2], &[0.0; 3], |_| parts, |_| []).map(|_| ())
    }

    #[test]
    fn a_weak_coupling_is_told_whatever_the_units_of_others_are() {
        for (by_input, unit) in [(1.0, 1.0), (1e16, 1.0), (1.0, 1e-12), (1e-16, 1e9)] {
            for spring in [1e-10, -3.0] {
                let told = coupled(spring, by_input, unit).unwrap_err();
                let expected =
                    LinearizationError::DependsOnOthers { kept: "speed", other: "place", value: spring };
                assert_eq!(told, expected, "{by_input} {unit}");
            }
            assert_eq!(coupled(0.0, by_input, unit), Ok(()));
        }
    }
}

//! Newton's iteration with steps that are halved until residuals fall.

use super::AssemblyError;
use crate::arrays::all_finite;
use crate::linear::Factors;
use crate::newton_return::worst;
use crate::projection::{is_settled, largest};
use crate::{D, Real, StateFault};

/// The iterations after which an assembly is given up.
const MOST_ITERATIONS: u32 = 200;
/// A step is halved so often at most.
const MOST_HALVINGS: u32 = 40;

/// Functions and their derivatives, row by row.
pub(crate) type Linearized<T, const N: usize, const M: usize> = ([T; M], [[T; N]; M]);

/// The equations of positions: the first `independent` of them determine where to go, the others follow.
#[derive(Clone, Copy, Debug)]
pub struct Loops<const N: usize, const M: usize> {
    /// What the equations are called.
    pub names: [&'static str; M],
    /// How many of them are independent.
    pub independent: usize,
    /// Whether they depend on each coordinate.
    pub depends: [bool; N],
}

/// Newton's iteration from `start`, with steps halved until the residuals fall: each is measured by how much the
/// full step would change its equation, so that units do not matter.
pub(crate) fn descend<T: Real, const N: usize, const M: usize>(
    start: &[T; N],
    equations: impl Fn(&[T; N]) -> Linearized<T, N, M>,
    step: impl Fn(&[T; N], &Linearized<T, N, M>) -> [T; N],
    settle: impl Fn(&[T; N]) -> Option<[T; N]>,
    admits: impl Fn(&[[T; N]; M]) -> bool,
    loops: &Loops<N, M>,
) -> Result<[T; N], AssemblyError> {
    let mut present = *start;
    let mut here = equations(&present);
    let half = T::from_f64(0.5);
    let (mut scale, mut preceding) = (largest(&present), None);
    for _ in 0..MOST_ITERATIONS {
        let left = || here.0.iter().take(loops.independent);
        if left().all(|left| *left == T::ZERO) {
            return Ok(present);
        }
        let change = step(&present, &here);
        if !all_finite::<T, _>(&change) {
            return Err(singular(&here.0, &loops.names));
        }
        let size = largest(&change);
        // what the step makes of an equation, and its rounding: one that already holds has nothing but that
        let rounding = T::from_f64(16.0) * T::EPSILON * scale.max(size);
        let weights = here.1.map(|row| {
            row.iter().zip(&change).fold(T::ZERO, |sum, (a, x)| sum + a.abs() * (x.abs() + rounding))
        });
        let excess = |left: [T; M]| {
            let rows = left.iter().zip(&weights).take(loops.independent);
            let rows = rows.filter(|(_, weight)| **weight > T::ZERO);
            rows.fold(T::ZERO, |largest, (left, weight)| largest.max(left.abs() / *weight))
        };
        let before = excess(here.0);
        let is_settled = is_settled(size, scale.max(size), preceding);
        // so near a regular solution a step that does not take the residuals away meets their rounding
        let is_near = preceding.is_some() && size <= T::EPSILON.sqrt() * scale;
        let mut is_last = is_settled;
        let mut part = T::ONE;
        let mut accepted = None;
        for _ in 0..MOST_HALVINGS {
            let mut trial = present;
            for (x, change) in trial.iter_mut().zip(&change) {
                *x += part * *change;
            }
            let trial = settle(&trial).filter(all_finite::<T, _>);
            accepted = trial.map(|trial| (trial, equations(&trial))).filter(|(_, there)| {
                // residuals are what is left of a step in part, but for half of what it takes away
                let mut beyond = there.0;
                for (beyond, left) in beyond.iter_mut().zip(&here.0) {
                    *beyond -= (T::ONE - part) * *left;
                }
                let falls = excess(beyond) <= half * part * before;
                is_last |= !falls && is_near;
                admits(&there.1) && (falls || is_last)
            });
            if accepted.is_some() {
                break;
            }
            part *= half;
        }
        let Some((next, there)) = accepted else {
            return Err(no_solution(&here.0, &loops.names));
        };
        (present, here) = (next, there);
        if is_last {
            return Ok(present);
        }
        scale = scale.max(largest(&present));
        preceding = (part == T::ONE).then_some(size);
    }
    Err(no_solution(&here.0, &loops.names))
}

/// That equations which follow from the others do.
pub(super) fn follow<T: Real, const N: usize, const M: usize>(
    (left, slopes): &Linearized<T, N, M>,
    loops: &Loops<N, M>,
    found: &[T; N],
    start: &[T; N],
) -> Result<(), AssemblyError> {
    let scale = largest(found).max(largest(start)) * T::EPSILON.sqrt();
    let rows = left.iter().zip(slopes).skip(loops.independent);
    let mut bounds = rows.map(|(left, slopes)| {
        let slope = slopes.iter().fold(T::ZERO, |sum, slope| sum + slope.abs());
        left.abs() <= slope * scale
    });
    if bounds.all(|holds| holds) { Ok(()) } else { Err(no_solution(left, &loops.names)) }
}

/// The sign of a determinant; 0 where rounding alone keeps the matrix from being singular, with the rows and columns
/// brought to the same size.
pub(super) fn sign<T: Real, const N: usize>(mut matrix: [[T; N]; N]) -> i8 {
    for column in 0..N {
        let largest = matrix.iter().filter_map(|row| row.get(column)).fold(T::ZERO, |m, x| m.max(x.abs()));
        for entry in matrix.iter_mut().filter_map(|row| row.get_mut(column)) {
            *entry = *entry / largest;
        }
    }
    for row in &mut matrix {
        let largest = largest(row);
        for entry in row {
            *entry = *entry / largest;
        }
    }
    Factors::<D<N>, T>::new(&matrix).sign(T::from_f64(8.0) * T::EPSILON)
}

/// Rows of equations, and above them one for each variable that keeps its value: as many as there are variables.
pub(super) fn square<'a, T: Real, const N: usize>(
    equations: impl Iterator<Item = &'a [T; N]>,
    is_fixed: impl Fn(usize) -> bool,
) -> [[T; N]; N] {
    let mut matrix = [[T::ZERO; N]; N];
    let units = (0..N).filter(|index| is_fixed(*index)).map(|index| {
        let mut unit = [T::ZERO; N];
        if let Some(entry) = unit.get_mut(index) {
            *entry = T::ONE;
        }
        unit
    });
    for (place, row) in matrix.iter_mut().zip(units.chain(equations.copied())) {
        *place = row;
    }
    matrix
}

/// The right side that belongs to [`square`]: −f below the variables that keep their values.
pub(super) fn lower<'a, T: Real, const N: usize>(
    left: impl Iterator<Item = &'a T>,
    is_fixed: impl Fn(usize) -> bool,
) -> [T; N] {
    let mut right = [T::ZERO; N];
    let above = (0..N).filter(|index| is_fixed(*index)).count();
    for (place, left) in right.iter_mut().skip(above).zip(left) {
        *place = -*left;
    }
    right
}

fn named<T: Real, const M: usize>(left: &[T; M], names: &[&'static str; M]) -> StateFault {
    let mut pairs = names.iter().zip(left);
    worst([(); M].map(|()| pairs.next().map_or(("", T::ZERO), |(name, left)| (*name, *left))))
}

pub(super) fn no_solution<T: Real, const M: usize>(
    left: &[T; M],
    names: &[&'static str; M],
) -> AssemblyError {
    let StateFault { identity, residual } = named(left, names);
    AssemblyError::NoSolution { constraint: identity, residual }
}

pub(super) fn singular<T: Real, const M: usize>(left: &[T; M], names: &[&'static str; M]) -> AssemblyError {
    let StateFault { identity, residual } = named(left, names);
    AssemblyError::Singular { constraint: identity, residual }
}

//! Newton's iteration with steps that are halved until residuals fall.

use super::AssemblyError;
use super::failure::{no_solution, singular};
use crate::arrays::all_finite;
use crate::linear::Factors;
use crate::newton_return::is_rounding;
use crate::projection::largest;
use crate::{D, Real, Scalar, rounding};

/// The iterations after which an assembly is given up.
const MOST_ITERATIONS: u32 = 200;
/// So many full steps near a solution that are hardly smaller than the one before are rounding: even near a double solution
/// each is half of that.
const LEVEL_STEPS: u32 = 3;
/// Where along a step rounding is looked at, in roots of the rounding unit.
const NEAR: [f64; 4] = [1.0, 0.8, 0.6, 0.35];
/// By how much rounding inside of equations may exceed what has been seen of it.
const UNSEEN: f64 = 1024.0;
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
    let moved = |present: &[T; N], change: &[T; N], part: T| {
        let mut trial = *present;
        for (x, change) in trial.iter_mut().zip(change) {
            *x += part * *change;
        }
        settle(&trial).filter(all_finite::<T, _>)
    };
    let (mut sizes, mut last_share, mut was_full) = (present.map(Scalar::abs), None, false);
    let mut level_steps = 0;
    // what the solution of the linear equations leaves of those that hold
    let mut floors = [T::ZERO; M];
    let independent = |mut left: [T; M]| {
        left.iter_mut().skip(loops.independent).for_each(|left| *left = T::ZERO);
        left
    };
    let is_noise = |there: Option<[T; N]>, change: &[T; N], before: &[T; M]| {
        let residual = |x: &[T; N]| independent(equations(x).0);
        there.is_some_and(|x| is_rounding(&x, change, (&independent(*before), &residual(&x)), residual))
    };
    for _ in 0..MOST_ITERATIONS {
        let left = || here.0.iter().take(loops.independent);
        if left().all(|left| *left == T::ZERO) {
            return Ok(present);
        }
        let change = step(&present, &here);
        if !all_finite::<T, _>(&change) {
            return Err(singular(&here.0, &loops.names));
        }
        let mut asked = Asked::new(&present, &here, &change, &mut floors, loops.independent);
        // beside the terms of the equations, and where these are nothing but rounding themselves, beside what they come to;
        // how far a step would lead that is not taken says nothing of them afterwards
        let share = asked.share(&here, &larger(&sizes, &change), &floors);
        let still_falls = last_share.is_none_or(|last: T| share <= half * last);
        let is_level = was_full
            && share <= T::EPSILON.sqrt()
            && last_share.is_some_and(|last| share > T::from_f64(0.75) * last);
        level_steps = if is_level { level_steps + 1 } else { 0 };
        let is_settled = share <= T::from_f64(8.0) * T::EPSILON
            || level_steps >= LEVEL_STEPS
            || (!still_falls && is_noise(moved(&present, &change, T::ONE), &change, &here.0));
        // so near a regular solution a step that does not take the residuals away meets their rounding
        let is_near = was_full && share <= T::EPSILON.sqrt();
        last_share = Some(share);
        let mut is_last = is_settled;
        let mut part = T::ONE;
        let mut accepted = None;
        for _ in 0..MOST_HALVINGS {
            let trial = moved(&present, &change, part);
            let trial = trial.map(|trial| (trial, equations(&trial)));
            if part == T::ONE && trial.as_ref().is_some_and(|(_, there)| !asked.is_brought(part, &there.0)) {
                asked.note_noise(|part| moved(&present, &change, part).map(|x| equations(&x).0));
                asked.note_rounding(&rounding::are_rounding(&present, &change, |x| equations(x).0));
            }
            accepted = trial.filter(|(_, there)| {
                let falls = asked.is_brought(part, &there.0);
                is_last |= !falls && is_near && asked.may_be_rounding(&there.0);
                admits(&there.1) && (falls || is_last)
            });
            if accepted.is_some() {
                break;
            }
            part *= half;
        }
        let Some((next, there)) = accepted else {
            let further = |x: &[T; N]| step(x, &equations(x));
            let zeroed = rounding::without_noise(&present, (&change, &change), further, |x| {
                independent(equations(x).0)
            });
            // terms that move by far more than there is to correct cancel, since the equations are dependent there
            let is_singular = asked.most <= T::EPSILON.sqrt();
            let error = if is_singular { singular } else { no_solution };
            return zeroed.ok_or_else(|| error(&here.0, &loops.names));
        };
        (present, here) = (next, there);
        if is_last {
            return Ok(present);
        }
        was_full = part == T::ONE;
        sizes = larger(start, &present);
    }
    Err(no_solution(&here.0, &loops.names))
}

/// The larger sizes of two.
fn larger<T: Real, const N: usize>(a: &[T; N], b: &[T; N]) -> [T; N] {
    core::array::from_fn(|index| {
        let of = |list: &[T; N]| list.get(index).map_or(T::ZERO, |x| x.abs());
        Scalar::max(of(a), of(b))
    })
}

/// What a step is to do to one equation, in the units of the equation.
#[derive(Clone, Copy)]
struct Share<T> {
    left: T,
    /// How much the full step moves the terms of the equation.
    weight: T,
    /// What rounding leaves of it: by the digits of the variables and, where it held before any step, by the solution of
    /// the linear equations.
    rounding: T,
}

/// What a step is to do to each equation. No two equations and no two variables are compared but by ratios, so that
/// units do not matter.
struct Asked<T, const M: usize> {
    shares: [Share<T>; M],
    /// The largest part of its weight that is left of an equation.
    most: T,
}

impl<T: Real, const M: usize> Asked<T, M> {
    fn new<const N: usize>(
        present: &[T; N],
        (left, slopes): &Linearized<T, N, M>,
        change: &[T; N],
        floors: &mut [T; M],
        independent: usize,
    ) -> Self {
        let relative = T::from_f64(16.0) * T::EPSILON;
        let mut rows = left.iter().zip(slopes).zip(floors).take(independent);
        let shares = [(); M].map(|()| {
            let mut share = Share { left: T::ZERO, weight: T::ZERO, rounding: T::ZERO };
            let Some(((left, slopes), floor)) = rows.next() else { return share };
            let (mut open, mut size) = (*left, T::ZERO);
            for ((slope, x), change) in slopes.iter().zip(present).zip(change) {
                let moved = *slope * *change;
                open += moved;
                share.weight += moved.abs();
                size += (*slope * *x).abs() + moved.abs();
            }
            share.left = *left;
            let holds = left.abs() <= *floor;
            if holds {
                *floor = Scalar::max(*floor, T::from_f64(2.0) * open.abs());
            }
            share.rounding = if holds { *floor } else { T::ZERO } + relative * size;
            share
        });
        let part = |share: &Share<T>| share.left.abs() / share.weight;
        let most = shares.iter().filter(|share| share.weight > T::ZERO).map(part).fold(T::ZERO, T::max);
        Self { shares, most }
    }

    /// The largest part of the terms of an equation, at the start and here, that the step moves: but of those that held before
    /// any step, and where nothing moves but by rounding of the solution of the linear equations.
    fn share<const N: usize>(
        &self,
        (left, slopes): &Linearized<T, N, M>,
        sizes: &[T; N],
        floors: &[T; M],
    ) -> T {
        let rows = self.shares.iter().zip(floors).zip(left.iter().zip(slopes));
        let mut most = T::ZERO;
        for ((share, floor), (left, slopes)) in rows {
            let is_rounding = left.abs() <= *floor && share.weight <= T::from_f64(4.0) * *floor;
            if is_rounding || share.weight == T::ZERO {
                continue;
            }
            let terms = |sum: T, (slope, size): (&T, &T)| sum + (*slope * *size).abs();
            most = Scalar::max(most, share.weight / slopes.iter().zip(sizes).fold(T::ZERO, terms));
        }
        most
    }

    /// Adds what rounding inside the equations makes of them: by what they are off their straight line a little way along
    /// the step, where their curvature is below rounding.
    fn note_noise(&mut self, left: impl Fn(T) -> Option<[T; M]>) {
        for near in NEAR {
            let part = T::EPSILON.sqrt() * T::from_f64(near);
            let Some(there) = left(part) else { continue };
            for (share, there) in self.shares.iter_mut().zip(&there) {
                let noise = (*there - (T::ONE - part) * share.left).abs();
                share.rounding = Scalar::max(share.rounding, T::from_f64(4.0) * noise);
            }
        }
    }

    /// Takes over which equations are rounding, and what the step makes of them. They do not hold up the others: of a
    /// variable that is zero where the search leads to, each step may change all digits.
    fn note_rounding(&mut self, are: &[T; M]) {
        for (share, is) in self.shares.iter_mut().zip(are) {
            let most = T::from_f64(16.0) * Scalar::max(share.left.abs(), share.weight);
            share.rounding = Scalar::max(share.rounding, *is * most);
        }
    }

    /// Whether what is left of the equations may be rounding: of those that the step knows digits of, no more than is left
    /// of the others by rounding that has not been seen.
    fn may_be_rounding(&self, there: &[T; M]) -> bool {
        let half = T::EPSILON.sqrt();
        let mut moved = self.shares.iter().zip(there).filter(|(share, _)| share.weight > T::ZERO);
        moved.all(|(share, there)| {
            share.left.abs() <= half * share.weight || there.abs() <= T::from_f64(UNSEEN) * share.rounding
        })
    }

    /// Whether a part of the step brought the equations to where it should: what is left of them is what a step in part
    /// leaves, but for half of what it takes away, and for rounding. Rounding counts only where the step knows digits of
    /// its own.
    fn is_brought(&self, part: T, there: &[T; M]) -> bool {
        let is_known = self.most > T::EPSILON.sqrt();
        let moved = self.shares.iter().zip(there).filter(|(share, _)| share.weight > T::ZERO);
        let mut ends = moved.map(|(share, there)| {
            let beyond = (*there - (T::ONE - part) * share.left).abs();
            let rounding = if is_known { share.rounding } else { T::ZERO };
            beyond <= T::from_f64(0.5) * part * self.most * share.weight + rounding
        });
        ends.all(|falls| falls)
    }
}

/// That equations which follow from the others do. What is left of them is compared with what moving each variable by half
/// of its digits would do, and of those whose derivatives vanish where they hold, as the diagonal of a rotation that is to
/// be none, with what the derivatives would be at such a distance, and with the rounding of numbers inside of them.
pub(super) fn follow<T: Real, const N: usize, const M: usize>(
    equations: impl Fn(&[T; N]) -> Linearized<T, N, M>,
    loops: &Loops<N, M>,
    found: &[T; N],
    start: &[T; N],
) -> Result<(), AssemblyError> {
    let (left, slopes) = equations(found);
    let mut sizes = *start;
    for (size, found) in sizes.iter_mut().zip(found) {
        *size = Scalar::max(size.abs(), found.abs());
    }
    let half = T::EPSILON.sqrt();
    let there = |variable: usize, by: T| {
        let mut there = *found;
        if let Some(x) = there.get_mut(variable) {
            *x += by;
        }
        equations(&there)
    };
    let weighed = |slopes: &[T; N]| {
        slopes.iter().zip(&sizes).fold(T::ZERO, |sum, (slope, size)| sum + slope.abs() * *size)
    };
    // by how much the terms of an equation change over half of the digits of all variables
    let bends = |row: usize, here: &[T; N]| {
        let of = |(variable, size): (usize, &T)| {
            let (_, there) = there(variable, half * *size);
            let mut change = there.get(row).copied().unwrap_or(*here);
            change.iter_mut().zip(here).for_each(|(there, here)| *there -= *here);
            weighed(&change)
        };
        sizes.iter().enumerate().map(of).fold(T::ZERO, |sum, bend| sum + bend)
    };
    // how little moves an equation by one variable alone, and by how much: rounding of the numbers that it is the sum of
    let grain = |row: usize, variable: usize| {
        let left = left.get(row).copied().unwrap_or(T::ZERO);
        rounding::grain(|by| {
            let there = there(variable, by).0.get(row).copied().unwrap_or(left);
            if there.is_finite() { (there - left).abs() } else { T::ZERO }
        })
    };
    // and so the variables are known no better than to what moves the equations that they come from
    let is_rounding = |row: usize, left: T, slopes: &[T; N]| {
        let grains = T::from_f64(GRAINS);
        let of = |variable: usize| {
            let of_equation = (0..loops.independent).map(|row| grain(row, variable));
            let seen = of_equation.filter(|(_, change)| *change > T::ZERO).map(|(distance, _)| distance);
            let known = seen.reduce(Scalar::min).unwrap_or(T::ZERO);
            let slope = slopes.get(variable).copied().unwrap_or(T::ZERO);
            Scalar::max(grain(row, variable).1, (slope * known).abs())
        };
        left.abs() <= grains * (0..N).map(of).fold(T::ZERO, Scalar::max)
    };
    let mut rows = left.iter().zip(&slopes).enumerate().skip(loops.independent);
    let open = rows.find(|(row, (left, slopes))| {
        let explained = half * weighed(slopes);
        let holds = left.abs() <= explained
            || left.abs() <= explained + bends(*row, slopes)
            || is_rounding(*row, **left, slopes);
        !holds
    });
    open.map_or(Ok(()), |(row, (left, _))| {
        let constraint = loops.names.get(row).copied().unwrap_or("");
        Err(AssemblyError::NoSolution { constraint, residual: left.to_f64() })
    })
}

/// So many roundings of the numbers that it is the sum of may be left of an equation that follows from others.
const GRAINS: f64 = 16.0;

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

#[cfg(test)]
mod tests {
    use super::*;

    fn found<const N: usize>(
        start: [f64; N],
        equations: impl Fn(&[f64; N]) -> Linearized<f64, N, N>,
    ) -> Result<[f64; N], AssemblyError> {
        let loops = Loops { names: [""; N], independent: N, depends: [true; N] };
        let step = |left: &[f64; N], slopes: &[[f64; N]; N]| {
            Factors::<D<N>, f64>::new(slopes).solve(&left.map(|left| -left))
        };
        descend(&start, equations, |_, (left, slopes)| step(left, slopes), |x| Some(*x), |_| true, &loops)
    }

    /// Equations that are linear, one of which holds before the step and has nothing but rounding after it, in any units
    /// of equations and variables: units that are powers of two change no digit.
    #[test]
    fn what_holds_already_stops_no_step() {
        let slopes = [[1.1, 0.7, -0.4], [0.3, 0.0, 0.0], [-0.2, 1.3, 0.9]];
        let right = [0.1, 0.0, 2.0];
        let solved = |rows: [i32; 3], columns: [i32; 3], x: f64| {
            let unit = |power: i32| 2.0_f64.powi(power);
            let (mut a, mut b) = (slopes, right);
            for (row, by) in rows.into_iter().enumerate() {
                b[row] *= unit(by);
                for (column, of) in columns.into_iter().enumerate() {
                    a[row][column] *= unit(by - of);
                }
            }
            let equations = |x: &[f64; 3]| {
                let left = |row: usize| a[row].iter().zip(x).map(|(a, x)| a * x).sum::<f64>() - b[row];
                ([0, 1, 2].map(left), a)
            };
            let start = [0.0, x * unit(columns[1]), 0.0];
            let found = found(start, equations).unwrap();
            [0, 1, 2].map(|column: usize| found[column] * unit(-columns[column]))
        };
        let (y, z) = (0.89 / 1.15, 1.27 / 1.15);
        for x in [0.0, 1.0, -30.0] {
            let plain = solved([0; 3], [0; 3], x);
            let bits = |x: [f64; 3]| x.map(f64::to_bits);
            assert!(plain[0].abs() < 1e-16, "{plain:?}");
            assert!((plain[1] - y).abs() < 1e-14 && (plain[2] - z).abs() < 1e-14, "{plain:?} {y} {z}");
            for power in [-900, -60, 60, 900] {
                assert_eq!(bits(solved([0, power, 0], [0; 3], x)), bits(plain));
                assert_eq!(bits(solved([power; 3], [0; 3], x)), bits(plain));
                assert_eq!(bits(solved([0; 3], [power; 3], x)), bits(plain));
            }
        }
    }

    /// A turn that is to be none: its sine is 0, and from that its cosine is 1 on one of two branches. The derivative of the
    /// cosine vanishes there, so that rounding is all that is left of both.
    #[test]
    fn what_follows_by_its_square_is_compared_with_that() {
        let loops = Loops { names: ["sine", "cosine", "offset"], independent: 1, depends: [true; 2] };
        for power in [-60, 0, 60] {
            let unit = 2.0_f64.powi(power);
            for rounding in [-4e-16, 0.0, 4e-16] {
                let equations = |[x, y]: &[f64; 2]| {
                    let left = [unit * x.sin(), unit * (x.cos() - 1.0 + rounding), y * x.sin()];
                    (left, [[unit * x.cos(), 0.0], [-unit * x.sin(), 0.0], [y * x.cos(), x.sin()]])
                };
                // the guess is right, or the other variable is nothing, or in any unit
                for (start, y) in [(0.0, 0.3), (1e-17, 0.0), (0.1, 0.3e12), (-1e-20, 1e-200)] {
                    assert_eq!(follow(equations, &loops, &[0.0, y], &[start, y]), Ok(()));
                }
                // x is known no better than to the rounding of 0.3
                let beside = |x: &[f64; 2]| {
                    let (mut left, slopes) = equations(x);
                    left[0] = unit * ((x[0].sin() + 0.3) - 0.3);
                    (left, slopes)
                };
                assert_eq!(follow(beside, &loops, &[1e-17, 0.3], &[1e-17, 0.3]), Ok(()));
                let follows = |x: f64| follow(equations, &loops, &[x, 0.3], &[x + 0.1, 0.3]);
                assert_eq!(follows(1e-17), Ok(()), "{power} {rounding}");
                let error = follows(core::f64::consts::PI);
                assert!(
                    matches!(error, Err(AssemblyError::NoSolution { constraint: "cosine", .. })),
                    "{error:?}"
                );
                assert!(follows(1e-3).is_err());
            }
        }
    }

    /// An equation that gets worse is not excused by a variable that is large, in whatever unit.
    #[test]
    fn a_large_variable_excuses_no_other() {
        for power in [0, 40, 60, 900] {
            let unit = 2.0_f64.powi(power);
            let here = ([0.5 * unit, 1.0], [[1.0, 0.0], [0.0, 1.0]]);
            let asked = Asked::new(&[unit, 1.0], &here, &[-0.5 * unit, -1.0], &mut [0.0; 2], 2);
            assert!(asked.is_brought(1.0, &[0.0, 0.4]), "{power}");
            assert!(!asked.is_brought(1.0, &[0.0, 1.4]), "{power}");
        }
    }

    /// Two loops that have nothing to do with one another: one holds to rounding, the other is open.
    #[test]
    fn a_loop_that_is_closed_does_not_stop_another() {
        for closed in 1..40_u32 {
            let a = 0.05 * f64::from(closed);
            let height = 0.7 * a.cos();
            for off in [-1.0, 0.1, 1e-3, 1e-9, 1e-13] {
                let equations = |[a, b]: &[f64; 2]| {
                    ([0.7 * a.cos() - height, b.sin() - 0.5], [[-0.7 * a.sin(), 0.0], [0.0, b.cos()]])
                };
                for shift in [-1e-16, 0.0, 1e-16] {
                    let found = found([a + shift, 0.5_f64.asin() + off], equations);
                    let [_, b] = found.unwrap_or_else(|error| panic!("{a} {off} {shift}: {error}"));
                    assert!((b.sin() - 0.5).abs() < 1e-15, "{b}");
                }
            }
        }
    }
}

//! Assembling a machine from a rough start: damped Newton iterations by which generated code finds positions that
//! close its loops, and velocities that keep them closed.

mod descent;
mod failure;

use crate::arrays::first_non_finite;
use crate::linear::Factors;
use crate::{D, ProjectionError, Real, Scalar, State, StateFault};
pub(crate) use descent::descend;
use descent::{Linearized, follow, lower, sign, square};
use failure::{no_solution, singular};

pub use descent::Loops;
pub use failure::AssemblyError;

/// Moves a guess to where the constraints on positions hold, by steps that are halved until residuals fall, and
/// then its velocities.
///
/// `change` gives the step of the coordinates, `settle` brings them back to an embedded base, and `project` does the
/// rest.
///
/// # Errors
/// What stops the search; [`AssemblyError`] names it.
pub fn assemble<S: State<Scalar: Real>, const N: usize, const M: usize>(
    guess: &S,
    loops: &Loops<N, M>,
    positions: impl Fn(&S) -> Linearized<S::Scalar, N, M>,
    change: impl Fn(&S) -> [S::Scalar; N],
    settle: impl Fn(&mut S) -> Result<(), ProjectionError>,
    project: impl Fn(&mut S) -> Result<(), ProjectionError>,
    fault: impl Fn(&S) -> StateFault,
) -> Result<S, AssemblyError> {
    finite(guess)?;
    let mut start = *guess;
    let unsettled = |_| no_solution(&positions(guess).0, &loops.names);
    settle(&mut start).map_err(unsettled)?;
    let moved = |x: &[S::Scalar; N]| with_first(&start, x);
    let mut state = moved(&descend(
        &first(&start),
        |x| positions(&moved(x)),
        |x, _| change(&moved(x)),
        |x| {
            let mut state = moved(x);
            settle(&mut state).ok()?;
            Some(first(&state))
        },
        |_| true,
        loops,
    )?);
    follow(|x| positions(&moved(x)), loops, &first(&state), &first(guess))?;
    project(&mut state).map_err(|_| velocities(fault(&state)))?;
    Ok(state)
}

/// Finds the coordinates that are not held, on the branch of the guess, and then the velocities: those at which the
/// held coordinates keep their rates, where these are as many as the velocities that are free, else the nearest
/// ones.
///
/// `motion` gives the constraints on velocities, then the rates of the coordinates, by the velocities of the state.
///
/// # Errors
/// What stops the search; [`AssemblyError`] names it.
pub fn assemble_holding<
    S: State<Scalar: Real>,
    const N: usize,
    const M: usize,
    const V: usize,
    const R: usize,
>(
    guess: &S,
    held: &[bool; N],
    loops: &Loops<N, M>,
    positions: impl Fn(&S) -> Linearized<S::Scalar, N, M>,
    (constraints, motion): (&[&'static str], impl Fn(&S) -> Linearized<S::Scalar, V, R>),
    project: impl Fn(&mut S) -> Result<(), ProjectionError>,
    fault: impl Fn(&S) -> StateFault,
) -> Result<S, AssemblyError> {
    finite(guess)?;
    let involved = loops.depends.iter().filter(|depends| **depends).count();
    let taken = held.iter().zip(&loops.depends).filter(|(held, depends)| **held && **depends).count();
    let needed = involved.saturating_sub(loops.independent);
    if taken < needed {
        return Err(AssemblyError::TooFewHeld { held: taken, needed });
    }
    if taken > needed {
        return Err(AssemblyError::TooManyHeld { held: taken, permitted: needed });
    }
    let is_fixed =
        |index: usize| !matches!((held.get(index), loops.depends.get(index)), (Some(false), Some(true)));
    let moved = |x: &[S::Scalar; N]| with_first(guess, x);
    let matrix = |slopes: &[[S::Scalar; N]; M]| square(slopes.iter().take(loops.independent), is_fixed);
    let start = first(guess);
    let (left, slopes) = positions(guess);
    let branch = sign(matrix(&slopes));
    if branch == 0 {
        return Err(singular(&left, &loops.names));
    }
    let search = |admits: &Admits<S::Scalar, N, M>| {
        descend(
            &start,
            |x| positions(&moved(x)),
            |_, (left, slopes)| {
                let right = lower(left.iter().take(loops.independent), is_fixed);
                let mut change = Factors::<D<N>, S::Scalar>::new(&matrix(slopes)).solve(&right);
                // what is held stays, where rounding has reached its row as well
                for (_, change) in change.iter_mut().enumerate().filter(|(index, _)| is_fixed(*index)) {
                    *change = if change.is_finite() { S::Scalar::ZERO } else { *change };
                }
                change
            },
            |x| Some(*x),
            admits,
            loops,
        )
    };
    let found =
        search(&|slopes| sign(matrix(slopes)) == branch).map_err(|error| match search(&|_| true) {
            Ok(other) if follow(|x| positions(&moved(x)), loops, &other, &start).is_ok() => {
                let (coordinate, value) = farthest::<S, N>(&start, &other);
                AssemblyError::OtherBranch { coordinate, value }
            }
            _ => error,
        })?;
    follow(|x| positions(&moved(x)), loops, &found, &start)?;
    let mut state = moved(&found);
    let free = V.saturating_sub(constraints.len());
    if held.iter().filter(|held| **held).count() == free {
        let rates = motion(guess).0;
        return at_rates(&state, held, &rates, constraints, motion, fault);
    }
    project(&mut state).map_err(|_| velocities(fault(&state)))?;
    Ok(with_first(&state, &found))
}

/// Whether a search may come to where equations have these derivatives.
type Admits<'a, T, const N: usize, const M: usize> = dyn Fn(&[[T; N]; M]) -> bool + 'a;

/// The velocities that satisfy the constraints and at which held coordinates have given rates.
fn at_rates<S: State<Scalar: Real>, const N: usize, const V: usize, const R: usize>(
    state: &S,
    held: &[bool; N],
    rates: &[S::Scalar; R],
    constraints: &[&'static str],
    motion: impl Fn(&S) -> Linearized<S::Scalar, V, R>,
    fault: impl Fn(&S) -> StateFault,
) -> Result<S, AssemblyError> {
    let count = constraints.len();
    let is_demanded = |row: usize| row < count || held.get(row.wrapping_sub(count)).copied().unwrap_or(false);
    let names: [&'static str; R] =
        core::array::from_fn(|row| constraints.get(row).copied().unwrap_or_else(|| name::<S>(row - count)));
    let with = |v: &[S::Scalar; V]| with_from(state, N, v);
    let equations = |v: &[S::Scalar; V]| {
        let (mut left, slopes) = motion(&with(v));
        for (row, (left, rate)) in left.iter_mut().zip(rates).enumerate() {
            *left = match (is_demanded(row), row < count) {
                (false, _) => S::Scalar::ZERO,
                (true, true) => *left,
                (true, false) => *left - *rate,
            };
        }
        (left, slopes)
    };
    let demanded = |slopes: &[[S::Scalar; V]; R]| {
        let rows = slopes.iter().enumerate().filter(|(row, _)| is_demanded(*row)).map(|(_, slopes)| *slopes);
        let mut matrix = [[S::Scalar::ZERO; V]; V];
        for (place, row) in matrix.iter_mut().zip(rows) {
            *place = row;
        }
        matrix
    };
    let step = |left: &[S::Scalar; R], slopes: &[[S::Scalar; V]; R]| {
        let mut right = [S::Scalar::ZERO; V];
        let rows = left.iter().enumerate().filter(|(row, _)| is_demanded(*row));
        for (place, (_, left)) in right.iter_mut().zip(rows) {
            *place = -*left;
        }
        Factors::<D<V>, S::Scalar>::new(&demanded(slopes)).solve(&right)
    };
    let loops = Loops { names, independent: R, depends: [true; V] };
    let start = from::<S, V>(state, N);
    let found =
        descend(&start, equations, |_, (left, slopes)| step(left, slopes), |v| Some(*v), |_| true, &loops);
    found.map(|v| with(&v)).map_err(|error| match error {
        AssemblyError::NoSolution { constraint, residual }
        | AssemblyError::Singular { constraint, residual } => {
            AssemblyError::Velocities { constraint, residual }
        }
        AssemblyError::NoValue { .. } => error,
        _ => velocities(fault(state)),
    })
}

/// Some components of a state, from a place on.
fn from<S: State<Scalar: Real>, const N: usize>(state: &S, place: usize) -> [S::Scalar; N] {
    let all = state.to_array();
    let mut components = all.as_ref().iter().skip(place);
    [S::Scalar::ZERO; N].map(|zero| components.next().copied().unwrap_or(zero))
}

/// The coordinates of a state.
fn first<S: State<Scalar: Real>, const N: usize>(state: &S) -> [S::Scalar; N] {
    from(state, 0)
}

/// The state with other components, from a place on.
fn with_from<S: State<Scalar: Real>, const N: usize>(state: &S, place: usize, x: &[S::Scalar; N]) -> S {
    let mut all = state.to_array();
    for (component, x) in all.as_mut().iter_mut().skip(place).zip(x) {
        *component = *x;
    }
    S::from_array(all)
}

/// The state with other coordinates.
fn with_first<S: State<Scalar: Real>, const N: usize>(state: &S, x: &[S::Scalar; N]) -> S {
    with_from(state, 0, x)
}

fn name<S: State>(index: usize) -> &'static str {
    S::names().as_ref().get(index).copied().unwrap_or("")
}

/// The coordinate that moved most, and where it is.
fn farthest<S: State<Scalar: Real>, const N: usize>(
    start: &[S::Scalar; N],
    end: &[S::Scalar; N],
) -> (&'static str, f64) {
    let mut most = (0, S::Scalar::ZERO, S::Scalar::ZERO);
    for (index, (start, end)) in start.iter().zip(end).enumerate() {
        let distance = (*end - *start).abs();
        if distance > most.1 {
            most = (index, distance, *end);
        }
    }
    (name::<S>(most.0), most.2.to_f64())
}

/// Refuses a guess that is not finite.
fn finite<S: State<Scalar: Real>>(guess: &S) -> Result<(), AssemblyError> {
    match first_non_finite(guess.to_array().as_ref()) {
        None => Ok(()),
        Some((index, value)) => Err(AssemblyError::NonFiniteGuess { component: name::<S>(index), value }),
    }
}

fn velocities(StateFault { identity, residual }: StateFault) -> AssemblyError {
    AssemblyError::Velocities { constraint: identity, residual }
}

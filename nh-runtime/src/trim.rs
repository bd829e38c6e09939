//! Steady motions: equilibria and relative equilibria, by the method `trim` that `linearization { keep: …; }` generates.

use core::cell::Cell;
use core::error::Error;
use core::fmt::{self, Display, Formatter};

use crate::arrays::{all_finite, first_non_finite};
use crate::assembly::{AssemblyError, Loops, descend};
use crate::linear_model::{Parts, Reduced, Uncertain, beside, reduce};
use crate::rounding::with_zeros;
use crate::{Jet, Real};

/// Why no steady motion was found.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum TrimError {
    /// A component of the guess is not finite.
    NonFiniteGuess {
        /// The variable.
        variable: &'static str,
        /// Its value.
        value: f64,
    },
    /// Steady motions come in families where the search came to, along which a variable changes that is not held.
    Undetermined {
        /// The variable.
        variable: &'static str,
    },
    /// Nothing near the guess satisfies all equations with what is held.
    NoSolution {
        /// The equation with the largest residual: a constraint, or the rate of a variable.
        equation: &'static str,
        /// That residual.
        residual: f64,
    },
    /// The motion or its derivatives are not finite where the search came to.
    NotFinite,
}

impl Display for TrimError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match *self {
            Self::NonFiniteGuess { variable, value } => {
                write!(f, "`{variable}` of the guess is {value:?}: give finite numbers")
            }
            Self::Undetermined { variable } => write!(
                f,
                "the motion stays steady where `{variable}` changes, as far as the derivatives tell where the search \
                 came to: hold it, or another variable of that family"
            ),
            Self::NoSolution { equation, residual } => write!(
                f,
                "no steady motion was found: {equation} is left with {residual:?}; hold fewer variables or other \
                 values, or guess nearer to a solution"
            ),
            Self::NotFinite => write!(
                f,
                "the motion or its derivatives are not finite where the search came to: guess away from there"
            ),
        }
    }
}

impl Error for TrimError {}

/// What the variables and the equations of a trim are: N components of the state among W variables with the inputs,
/// and Q equations, first the constraints, then the rates of the N components.
#[derive(Clone, Copy, Debug)]
pub struct Steady<const N: usize, const W: usize, const Q: usize> {
    /// What the variables are called.
    pub variables: [&'static str; W],
    /// What the equations are called.
    pub equations: [&'static str; Q],
    /// The components that a linearisation keeps.
    pub kept: [bool; N],
    /// How many of the components are coordinates.
    pub coordinates: usize,
}

/// Functions and their derivatives, row by row.
type Equations<T, const W: usize, const Q: usize> = ([T; Q], [[T; W]; Q]);

impl<const N: usize, const W: usize, const Q: usize> Steady<N, W, Q> {
    /// How many of the equations are constraints.
    const CONSTRAINTS: usize = Q.saturating_sub(N);

    fn is_kept(&self, component: usize) -> bool {
        self.kept.get(component).copied().unwrap_or(false)
    }

    /// A coordinate that is not kept may run on.
    fn is_loose(&self, component: usize) -> bool {
        component < self.coordinates && !self.is_kept(component)
    }

    /// The components that the constraints determine at the guess by the others, those that are not kept first; and of which
    /// of them the rates follow. That of a kept one does not where it goes with a coordinate that may run on.
    fn dependent<T: Real>(&self, near: &Near<T, W, Q>, held: &[bool; W]) -> [[bool; W]; 2] {
        let is_held = |column: usize| held.get(column).copied().unwrap_or(true);
        let phase =
            |column: usize| (column < N && !is_held(column)).then_some(u8::from(self.is_kept(column)));
        let constraints = near.only(|row| row < Self::CONSTRAINTS);
        let reduced = reduce(&constraints.linear(|column| phase(column).is_some()), |_| true, phase);
        let runs_with = |column: usize, other: usize| {
            self.is_loose(other) && !reduced.is_pivot(other) && reduced.depends(column, other)
        };
        let runs = |column: usize| self.is_kept(column) && (0..N).any(|other| runs_with(column, other));
        let dependent = core::array::from_fn(|column| reduced.is_pivot(column));
        [dependent, core::array::from_fn(|column| reduced.is_pivot(column) && !runs(column))]
    }

    /// Whether an equation is a constraint or the rate of what is kept.
    fn is_first(&self, equation: usize) -> bool {
        equation.checked_sub(Self::CONSTRAINTS).is_none_or(|component| self.is_kept(component))
    }

    /// Whether an equation is asked for: a constraint, or the rate of what is to be steady, unless that follows.
    fn is_asked(&self, equation: usize, follows: &[bool; W]) -> bool {
        let Some(component) = equation.checked_sub(Self::CONSTRAINTS) else { return true };
        !self.is_loose(component) && !follows.get(component).copied().unwrap_or(false)
    }
}

/// Finds a steady motion from a guess: constraints hold, and kept coordinates, velocities and auxiliary states have rates
/// that are zero. Variables that are held keep their values, coordinates that are neither kept nor needed by the
/// constraints keep those of the guess.
///
/// Newton's iteration with halved steps; there may be more equations than unknowns, if they agree, as where a symmetry
/// makes an acceleration vanish by itself.
///
/// # Errors
/// What stops the search; [`TrimError`] names it.
pub fn trim<T: Real, const N: usize, const W: usize, const Q: usize>(
    guess: &[T; W],
    held: &[bool; W],
    steady: &Steady<N, W, Q>,
    equations: impl Fn(&[T; W]) -> Equations<T, W, Q>,
) -> Result<[T; W], TrimError> {
    if let Some((index, value)) = first_non_finite(guess) {
        return Err(TrimError::NonFiniteGuess { variable: name(&steady.variables, index), value });
    }
    let near = |x: &[T; W]| Near::new(x, &equations);
    if !is_finite(&equations(guess)) {
        return Err(TrimError::NotFinite);
    }
    let at_guess = near(guess);
    let [dependent, follows] = steady.dependent(&at_guess, held);
    let is_free = |column: usize| {
        let is = |list: &[bool; W]| list.get(column).copied().unwrap_or(false);
        !is(held) && (is(&dependent) || !steady.is_loose(column))
    };
    // the first variable of a family of steady motions: which of them elimination leaves open says nothing
    let family = |reduced: &Reduced<T, W, Q>| {
        let open = (0..W).find(|column| is_free(*column) && !reduced.is_pivot(*column));
        open.map(|column| reduced.first_of_family(column))
    };
    let is_asked = |row: usize| steady.is_asked(row, &follows);
    // constraints and kept rates first: those of the others may follow, and then are poor equations to solve
    let solved = |near: &Near<T, W, Q>| {
        reduce(&near.linear(is_free), |row| steady.is_first(row), |column| is_free(column).then_some(0))
    };
    let chosen = solved(&at_guess.only(is_asked));
    let is_taken = |row: usize| is_asked(row) && !chosen.is_open(row);
    let taken = |x: &[T; W]| only(equations(x), is_taken);
    let undetermined = Cell::new(None);
    let step = |x: &[T; W], there: &Equations<T, W, Q>| {
        if !is_finite(there) {
            return [T::from_f64(f64::NAN); W];
        }
        let near = near(x).only(is_taken);
        let reduced = solved(&near);
        undetermined.set(family(&reduced));
        if undetermined.get().is_some() {
            return [T::from_f64(f64::NAN); W];
        }
        // rounding of what changes by much stands in what hardly changes, until it is solved for what it leaves
        let change = reduced.solution();
        let refined = solved(&near.after(&change)).solution();
        core::array::from_fn(|column| {
            let of = |list: &[T; W]| list.get(column).copied().unwrap_or(T::ZERO);
            of(&change) + of(&refined)
        })
    };
    let loops = Loops { names: steady.equations, independent: Q, depends: [true; W] };
    let found = descend(guess, taken, step, |x| Some(*x), |_| true, &loops);
    // what comes to rest has come there
    let found = found.map(|found| with_zeros(found, &step(&found, &taken(&found)), |x| taken(x).0));
    let found = found.map_err(|error| match (undetermined.get(), error) {
        (Some(column), _) => TrimError::Undetermined { variable: name(&steady.variables, column) },
        (
            None,
            AssemblyError::NoSolution { constraint, residual }
            | AssemblyError::Singular { constraint, residual },
        ) if residual.is_finite() => TrimError::NoSolution { equation: constraint, residual },
        _ => TrimError::NotFinite,
    })?;
    let end = near(&found).only(is_asked);
    let reduced = solved(&end);
    if let Some(column) = family(&reduced) {
        return Err(TrimError::Undetermined { variable: name(&steady.variables, column) });
    }
    // nor was anything solved from what was left open where the search began
    agree(steady, &end.here, |row| reduced.is_open(row) || !is_taken(row), (guess, &found))?;
    Ok(found)
}

/// Equations at a point, with their derivatives at other roundings of it.
struct Near<T, const W: usize, const Q: usize> {
    here: Equations<T, W, Q>,
    nearby: [[[T; W]; Q]; 2],
}

impl<T: Real, const W: usize, const Q: usize> Near<T, W, Q> {
    fn new(x: &[T; W], equations: impl Fn(&[T; W]) -> Equations<T, W, Q>) -> Self {
        Self { here: equations(x), nearby: beside(x).map(|x| equations(&x).1) }
    }

    /// The equations with what a change leaves of them, to first order.
    fn after(&self, change: &[T; W]) -> Self {
        let (mut left, slopes) = self.here;
        for (left, slopes) in left.iter_mut().zip(&slopes) {
            *left = slopes.iter().zip(change).fold(*left, |sum, (slope, by)| sum + *slope * *by);
        }
        Self { here: (left, slopes), nearby: self.nearby }
    }

    /// Some of the equations.
    fn only(&self, is_meant: impl Fn(usize) -> bool) -> Self {
        let of = |slopes: [[T; W]; Q]| only(([T::ZERO; Q], slopes), &is_meant).1;
        Self { here: only(self.here, &is_meant), nearby: self.nearby.map(of) }
    }

    /// The equations of a step.
    fn linear(&self, counts: impl Fn(usize) -> bool) -> Uncertain<T, W, Q> {
        let (left, slopes) = &self.here;
        Uncertain::new(slopes, &left.map(|left| -left), &self.nearby, counts)
    }
}

/// Some of the equations, the others being satisfied whatever the variables are.
fn only<T: Real, const W: usize, const Q: usize>(
    (mut left, mut slopes): Equations<T, W, Q>,
    is_meant: impl Fn(usize) -> bool,
) -> Equations<T, W, Q> {
    for (row, (left, slopes)) in left.iter_mut().zip(&mut slopes).enumerate() {
        if !is_meant(row) {
            (*left, *slopes) = (T::ZERO, [T::ZERO; W]);
        }
    }
    (left, slopes)
}

/// Whether the equations that nothing was solved from hold, but for what the digits of the variables explain.
fn agree<T: Real, const N: usize, const W: usize, const Q: usize>(
    steady: &Steady<N, W, Q>,
    (left, slopes): &Equations<T, W, Q>,
    is_open: impl Fn(usize) -> bool,
    (guess, found): (&[T; W], &[T; W]),
) -> Result<(), TrimError> {
    for (row, (left, slopes)) in left.iter().zip(slopes).enumerate().filter(|(row, _)| is_open(*row)) {
        let sizes = guess.iter().zip(found).map(|(guess, found)| guess.abs().max(found.abs()));
        let explained = slopes.iter().zip(sizes).fold(T::ZERO, |sum, (slope, size)| sum + slope.abs() * size);
        if left.abs() > T::EPSILON.sqrt() * explained {
            let (equation, residual) = (name(&steady.equations, row), left.to_f64());
            return Err(TrimError::NoSolution { equation, residual });
        }
    }
    Ok(())
}

fn is_finite<T: Real, const W: usize, const Q: usize>((left, slopes): &Equations<T, W, Q>) -> bool {
    all_finite::<T, _>(left) && slopes.iter().all(all_finite::<T, _>)
}

/// Constraints and rates as one list of equations, by all variables.
#[must_use]
pub fn equations<
    T: Real,
    const N: usize,
    const M: usize,
    const R: usize,
    const P: usize,
    const W: usize,
    const Q: usize,
>(
    Parts { residuals, rates, .. }: &Parts<Jet<T, N, M>, N, R, P>,
) -> ([T; Q], [[T; W]; Q]) {
    let mut all = residuals.iter().chain(rates);
    let jets: [Jet<T, N, M>; Q] = core::array::from_fn(|_| all.next().copied().unwrap_or_default());
    let row = |jet: Jet<T, N, M>| {
        let mut entries = jet.by.iter().chain(&jet.by_others);
        core::array::from_fn(|_| entries.next().copied().unwrap_or(T::ZERO))
    };
    (jets.map(|jet| jet.value), jets.map(row))
}

fn name<const N: usize>(names: &[&'static str; N], index: usize) -> &'static str {
    names.get(index).copied().unwrap_or("")
}

//! What competes: the emitted functions of a declared system, and what an expert writes by hand.

pub use nh_counted::random::Random;
use nonholonomic::ProjectionError;
use nonholonomic::prelude::*;

/// The number of states at which a system is evaluated.
pub const SAMPLES: usize = 16;

/// A declared system with a hand-written derivative of the same signature.
///
/// The contestants are never inlined, so that each is a symbol that instruction counts can be read of.
pub trait Contest: Dynamics<State: State<Scalar = f64>> + Sized {
    /// The derivative and its Jacobians.
    type Linearised;
    /// The entries of the Jacobians that are not always zero.
    type Entries: AsRef<[f64]>;
    /// The name in the tables.
    const NAME: &'static str;
    /// Parameters of ordinary size.
    fn ordinary() -> Self;
    /// The parameters in the order in which generated C takes them.
    fn parameters(&self) -> Vec<f64>;
    /// A random state with random inputs.
    fn sample(random: &mut Random) -> (Self::State, Self::Input);
    /// The inputs in order.
    fn inputs(input: &Self::Input) -> Vec<f64>;
    /// The emitted `derivative`.
    fn emitted(&self, t: f64, state: &Self::State, input: &Self::Input) -> Self::State;
    /// The emitted `linearized`: the derivative and its Jacobians.
    fn linearised(&self, t: f64, state: &Self::State, input: &Self::Input) -> Self::Linearised;
    /// The emitted `sparse_linearized`: the derivative and the entries of its Jacobians that are not always zero.
    fn sparse(&self, t: f64, state: &Self::State, input: &Self::Input) -> (Self::State, Self::Entries);
    /// The Jacobians by state and inputs side by side, row by row.
    fn jacobian(linearised: &Self::Linearised) -> Vec<f64>;
    /// The same of the entries alone.
    fn filled(entries: &Self::Entries) -> Vec<f64>;
    /// The derivative written by hand.
    fn by_hand(&self, t: f64, state: &Self::State, input: &Self::Input) -> Self::State;
}

/// A system with its derivative by hand, as an expert would hand it to the integrators: everything else is that of the
/// declared system.
#[derive(Clone, Copy, Debug)]
pub struct ByHand<S>(pub S);

/// The way back to position constraints by hand, as an expert would hand it to the integrators beside a derivative.
pub trait ClosedByHand: Contest {
    /// What is left of the constraints on positions.
    fn open(&self, state: &Self::State) -> [f64; 2];
    /// Moves the positions by a Newton step.
    fn close(&self, state: &mut Self::State);
    /// Moves the velocities to what the constraints make of those that are given.
    fn follow(&self, state: &mut Self::State);
}

/// The states and inputs at which a system is evaluated, the same in every run; where there are constraints on positions,
/// the nearby states at which these hold.
#[must_use]
pub fn samples<S: Contest>() -> Vec<(S::State, S::Input)> {
    let (mut random, system) = (Random::new(), S::ordinary());
    let mut found = Vec::with_capacity(SAMPLES);
    while found.len() < SAMPLES {
        let (mut state, input) = S::sample(&mut random);
        if system.return_to_positions(0.0, &mut state).is_ok() {
            found.push((state, input));
        }
    }
    found
}

/// The same from their numbers.
#[must_use]
pub fn recorded_samples<S: Contest>(numbers: &mut Random) -> Vec<(S::State, S::Input)> {
    (0..SAMPLES).map(|_| S::sample(numbers)).collect()
}

/// Makes a declared system a [`Contest`]: names, sizes (states, inputs), parameters, and the
/// derivative by hand.
macro_rules! contest {
    (@input) => { () };
    (@input $Input:ident) => { $Input };
    (@sample $random:ident) => { () };
    (@sample $random:ident $Input:ident) => { $Input::from(::core::array::from_fn(|_| $random.draw())) };
    (@components $input:ident $count:literal) => { { let () = $input; Vec::new() } };
    (@components $input:ident $count:literal $Input:ident) => { <[f64; $count]>::from(*$input).to_vec() };
    (
        $System:ident as $name:expr, $states:literal states, $inputs:literal inputs $(of $Input:ident)?,
        parameters [$($parameter:expr),* $(,)?] of $this:ident,
        $ordinary:expr,
        hand |$s:ident, $t:ident, $x:ident, $u:ident| $body:block
        $($closed:ident)?
    ) => {
        impl $crate::contest::Contest for $System {
            type Linearised = (Self::State, [[f64; $states]; $states], [[f64; $inputs]; $states]);
            type Entries = [f64; Self::JACOBIAN_ROWS.len()];
            const NAME: &'static str = $name;
            fn ordinary() -> Self {
                $ordinary
            }
            fn parameters(&self) -> Vec<f64> {
                let $this = self;
                vec![$($parameter),*]
            }
            fn sample(random: &mut $crate::contest::Random) -> (Self::State, Self::Input) {
                let state: [f64; $states] = ::core::array::from_fn(|_| random.draw());
                (state.into(), contest!(@sample random $($Input)?))
            }
            fn inputs(input: &Self::Input) -> Vec<f64> {
                contest!(@components input $inputs $($Input)?)
            }
            #[inline(never)]
            fn emitted(&self, t: f64, state: &Self::State, input: &Self::Input) -> Self::State {
                self.derivative(t, state, input)
            }
            #[inline(never)]
            fn linearised(&self, t: f64, state: &Self::State, input: &Self::Input) -> Self::Linearised {
                ::nonholonomic::Jacobian::linearized(self, t, state, input)
            }
            #[inline(never)]
            fn sparse(&self, t: f64, state: &Self::State, input: &Self::Input) -> (Self::State, Self::Entries) {
                self.sparse_linearized(t, state, input)
            }
            fn jacobian((_, by_state, by_input): &Self::Linearised) -> Vec<f64> {
                by_state.iter().zip(by_input).flat_map(|(a, b)| a.iter().chain(b)).copied().collect()
            }
            fn filled(entries: &Self::Entries) -> Vec<f64> {
                let mut all = vec![0.0; $states * ($states + $inputs)];
                let places = Self::JACOBIAN_ROWS.into_iter().zip(Self::JACOBIAN_COLUMNS);
                for ((row, column), entry) in places.zip(entries) {
                    all[row * ($states + $inputs) + column] = *entry;
                }
                all
            }
            #[inline(never)]
            fn by_hand(&self, $t: f64, $x: &Self::State, $u: &Self::Input) -> Self::State {
                let $s = self;
                $body
            }
        }

        impl ::nonholonomic::Dynamics for $crate::contest::ByHand<$System> {
            type State = <$System as ::nonholonomic::Dynamics>::State;
            type Input = <$System as ::nonholonomic::Dynamics>::Input;
            #[inline]
            fn derivative(&self, $t: f64, $x: &Self::State, $u: &Self::Input) -> Self::State {
                let $s = &self.0;
                $body
            }
            $(contest!(@$closed);)?
        }
    };
    (@closed) => {
        fn has_positions(&self) -> bool {
            true
        }
        fn return_to_positions(
            &self,
            _t: f64,
            state: &mut Self::State,
        ) -> Result<f64, ::nonholonomic::ProjectionError> {
            $crate::contest::closed_by_hand(&self.0, state)
        }
        fn correct_positions(&self, _t: f64, state: &mut Self::State) {
            use $crate::contest::ClosedByHand;
            self.0.close(state);
            self.0.follow(state);
        }
    };
}

/// Newton steps until they are round-off, and the velocities after them; the largest residual that was found.
///
/// # Errors
/// If the steps do not settle.
#[inline]
pub(crate) fn closed_by_hand<S: ClosedByHand>(
    system: &S,
    state: &mut S::State,
) -> Result<f64, ProjectionError> {
    const MOST: u32 = 20;
    const SETTLED: f64 = 4.0 * f64::EPSILON;
    let largest = |[x, y]: [f64; 2]| x.abs().max(y.abs());
    let found = largest(system.open(state));
    let mut left = found;
    for _ in 0..MOST {
        if left <= SETTLED {
            system.follow(state);
            return Ok(found);
        }
        system.close(state);
        left = largest(system.open(state));
    }
    Err(ProjectionError { iterations: MOST, residual: left })
}
pub(crate) use contest;

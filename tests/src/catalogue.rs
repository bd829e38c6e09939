//! The catalogue: every declared reference system with the map from the reference data's
//! coordinates to its own. Every check runs over all entries.

use std::any::type_name;
use std::marker::PhantomData;
use std::ops::Deref;

use nonholonomic::prelude::*;

use crate::reference::System;
pub use crate::values::{Moving, Reading, Values};

/// A declared system and how the reference data describe it.
pub trait Catalogued: Energy<State: State<Scalar = f64>> + Sized {
    /// The reference system's name.
    const REFERENCE: &'static str;
    /// The positions of the state's angles that the data determine up to full turns.
    const ANGLES: &'static [usize];

    /// The system with these parameters.
    fn parameters(values: &Values) -> Self;
    /// Whether the declaration can express these parameters.
    fn covers(values: &Values) -> bool;
    /// The inputs at a time.
    fn input(values: &Values, t: f64) -> Self::Input;
    /// The state in the declaration's coordinates, with its rate.
    fn state(reading: &Reading) -> Vec<Moving>;
    /// All quasi-velocities in the order of declaration.
    fn velocities(reading: &Reading) -> Vec<Moving>;
    /// All quasi-velocities as the generated code computes them.
    fn generated_velocities(&self, t: f64, state: &Self::State) -> Vec<f64>;
    /// The multipliers as the generated code computes them, by the labels of the reference data;
    /// `None` if the declaration has other constraints, or does not ask for them.
    fn generated_multipliers(&self, t: f64, state: &Self::State, input: &Self::Input) -> Option<Labelled> {
        _ = (t, state, input);
        None
    }
}

/// Numbers by labels.
pub type Labelled = Vec<(&'static str, f64)>;

/// Implements [`Catalogued`] for a declaration.
macro_rules! catalogued {
    (
        $system:ident { state: $n:literal, sections: $s:literal } of $reference:literal,
        parameters |$p:ident| $parameters:expr,
        $(input |$ip:ident, $t:ident| $input:expr,)?
        state |$r:ident| $state:expr,
        velocity |$vr:ident| $velocity:expr
        $(, covers |$cp:ident| $covers:expr)?
        $(, angles [$($angle:literal),*])?
        $(, multipliers [$($label:ident),*])?
        $(, projected $twin:ident $(with $inputs:literal inputs)?)?
    ) => {
        $crate::catalogue::catalogued!(@twin $system, $s, [$($($label),*)?] $(, $twin $(with $inputs inputs)?)?);
        impl $crate::catalogue::Catalogued for $system {
            const REFERENCE: &'static str = $reference;
            const ANGLES: &'static [usize] = &[$($($angle),*)?];

            fn parameters($p: &$crate::values::Values) -> Self {
                $parameters
            }
            $crate::catalogue::catalogued!(@covers $($cp, $covers)?);
            $crate::catalogue::catalogued!(@input $($ip, $t, $input)?);
            fn state($r: &$crate::values::Reading) -> Vec<$crate::values::Moving> {
                let state: [$crate::values::Moving; $n] = $state;
                state.to_vec()
            }
            fn velocities($vr: &$crate::values::Reading) -> Vec<$crate::values::Moving> {
                let velocity: [$crate::values::Moving; $s] = $velocity;
                velocity.to_vec()
            }
            fn generated_velocities(
                &self,
                t: f64,
                state: &<Self as nonholonomic::Dynamics>::State,
            ) -> Vec<f64> {
                let velocity: [f64; $s] = self.velocity(t, state).into();
                velocity.to_vec()
            }
            $(fn generated_multipliers(
                &self,
                t: f64,
                state: &<Self as nonholonomic::Dynamics>::State,
                input: &<Self as nonholonomic::Dynamics>::Input,
            ) -> Option<$crate::catalogue::Labelled> {
                let multipliers = self.multipliers(t, state, input);
                Some(vec![$((stringify!($label), multipliers.$label)),*])
            })?
        }
    };
    (@twin $system:ident, $s:literal, $labels:tt) => {};
    (@twin $system:ident, $s:literal, $labels:tt, $twin:ident $(with $inputs:literal inputs)?) => {
        $crate::twins::projected! { $twin of $system { sections: $s } $(with $inputs inputs)? $labels }
    };
    (@covers) => {
        fn covers(_: &$crate::values::Values) -> bool {
            true
        }
    };
    (@covers $p:ident, $covers:expr) => {
        fn covers($p: &$crate::values::Values) -> bool {
            $covers
        }
    };
    (@input) => {
        fn input(_: &$crate::values::Values, _: f64) -> <Self as nonholonomic::Dynamics>::Input {
            Default::default()
        }
    };
    (@input $p:ident, $t:ident, $input:expr) => {
        fn input(
            $p: &$crate::values::Values,
            $t: f64,
        ) -> <Self as nonholonomic::Dynamics>::Input {
            $input
        }
    };
}
pub(crate) use catalogued;

/// An entry of the catalogue: a declared system with lists of numbers in place of its types, so
/// that checks can walk over systems of any shape.
pub trait Entry: Sync {
    /// The name of the declaration.
    fn name(&self) -> &'static str;
    /// The reference data.
    fn reference(&self) -> System;
    /// Whether the declaration can express these parameters.
    fn covers(&self, values: &Values) -> bool;
    /// The names of the state's components.
    fn components(&self) -> Vec<&'static str>;
    /// The positions of the state's angles that the data determine up to full turns.
    fn angles(&self) -> &'static [usize];
    /// The state in the declaration's coordinates, with its rate.
    fn state(&self, reading: &Reading) -> Vec<Moving>;
    /// All quasi-velocities in the order of declaration.
    fn velocities(&self, reading: &Reading) -> Vec<Moving>;

    /// The generated derivative.
    fn derivative(&self, values: &Values, t: f64, state: &[f64]) -> Vec<f64>;
    /// The generated energy.
    fn energy(&self, values: &Values, t: f64, state: &[f64]) -> f64;
    /// The generated quasi-velocities.
    fn generated_velocities(&self, values: &Values, t: f64, state: &[f64]) -> Vec<f64>;
    /// The generated multipliers by the labels of the reference data, if there are any.
    fn generated_multipliers(&self, values: &Values, t: f64, state: &[f64]) -> Option<Labelled>;
    /// Integrates with Dormand and Prince's method.
    ///
    /// # Errors
    /// If the integrator gives up.
    fn integrate(&self, values: &Values, run: &Run<'_>) -> Result<Solution, IntegrationError>;
    /// Hands `measure` a closure that derives, observes and integrates for a short while.
    fn exercise(&self, values: &Values, t: f64, state: &[f64], measure: &mut dyn FnMut(&mut dyn FnMut()));
}

/// What to integrate.
#[derive(Clone, Copy, Debug)]
pub struct Run<'a> {
    /// The state at the first time.
    pub start: &'a [f64],
    /// The times, in ascending order.
    pub times: &'a [f64],
    /// The tolerance: relative, and absolute in units of the state.
    pub tolerance: f64,
}

/// What came out.
#[derive(Clone, Debug)]
pub struct Solution {
    /// The states at the times.
    pub states: Vec<Vec<f64>>,
    /// Accepted steps.
    pub steps: usize,
}

struct Declaration<S>(PhantomData<fn() -> S>);

/// The name of a declaration.
#[must_use]
pub fn name_of<S>() -> &'static str {
    let path = type_name::<S>();
    path.rsplit("::").next().unwrap_or(path)
}

impl<S: Catalogued> Entry for Declaration<S> {
    fn name(&self) -> &'static str {
        name_of::<S>()
    }

    fn reference(&self) -> System {
        System::read(S::REFERENCE)
    }

    fn covers(&self, values: &Values) -> bool {
        S::covers(values)
    }

    fn components(&self) -> Vec<&'static str> {
        S::State::names().as_ref().to_vec()
    }

    fn angles(&self) -> &'static [usize] {
        S::ANGLES
    }

    fn state(&self, reading: &Reading) -> Vec<Moving> {
        S::state(reading)
    }

    fn velocities(&self, reading: &Reading) -> Vec<Moving> {
        S::velocities(reading)
    }

    fn derivative(&self, values: &Values, t: f64, state: &[f64]) -> Vec<f64> {
        let system = S::parameters(values);
        let rate = system.derivative(t, &packed::<S>(state), &S::input(values, t));
        unpacked(&rate)
    }

    fn energy(&self, values: &Values, t: f64, state: &[f64]) -> f64 {
        Energy::energy(&S::parameters(values), t, &packed::<S>(state))
    }

    fn generated_velocities(&self, values: &Values, t: f64, state: &[f64]) -> Vec<f64> {
        S::parameters(values).generated_velocities(t, &packed::<S>(state))
    }

    fn generated_multipliers(&self, values: &Values, t: f64, state: &[f64]) -> Option<Labelled> {
        let input = S::input(values, t);
        S::parameters(values).generated_multipliers(t, &packed::<S>(state), &input)
    }

    fn integrate(&self, values: &Values, run: &Run<'_>) -> Result<Solution, IntegrationError> {
        let driven = Driven { system: S::parameters(values), values };
        let method = Dopri5::new().rtol(run.tolerance).atol(run.tolerance / 10.0);
        let start = packed::<S>(run.start);
        let mut integrator = Integrator::new(driven, method, run.times[0], start);
        let mut states = Vec::new();
        for &t in run.times {
            integrator.advance_to(t)?;
            states.push(unpacked(integrator.state()));
        }
        let steps = usize::try_from(integrator.statistics().steps).unwrap_or(usize::MAX);
        Ok(Solution { states, steps })
    }

    fn exercise(&self, values: &Values, t: f64, state: &[f64], measure: &mut dyn FnMut(&mut dyn FnMut())) {
        let system = S::parameters(values);
        let start = packed::<S>(state);
        let input = S::input(values, t);
        measure(&mut || {
            let rate = system.derivative(t, &start, &input);
            let energy = Energy::energy(&system, t, &start);
            std::hint::black_box((rate, energy));
            let mut integrator = Integrator::new(&system, Dopri5::new().rtol(1e-6), t, start);
            integrator.set_input(input);
            let _ = std::hint::black_box(integrator.advance_to(t + 0.01));
        });
    }
}

/// A system whose inputs are the reference system's functions of time.
#[derive(Clone, Debug)]
pub struct Driven<S, V> {
    /// The system.
    pub system: S,
    /// What the functions depend on.
    pub values: V,
}

impl<S: Catalogued, V: Deref<Target = Values>> Dynamics for Driven<S, V> {
    type State = S::State;
    type Input = ();

    fn derivative(&self, t: f64, state: &S::State, (): &()) -> S::State {
        self.system.derivative(t, state, &S::input(&self.values, t))
    }

    fn validate(&self) -> Result<(), ParameterError> {
        self.system.validate()
    }
}

fn packed<S: Catalogued>(numbers: &[f64]) -> S::State {
    let mut array = <<S::State as State>::Dim as nonholonomic::Dim>::vec(0.0);
    assert_eq!(
        array.as_ref().len(),
        numbers.len(),
        "{} has the state {:?}",
        type_name::<S>(),
        S::State::names().as_ref(),
    );
    array.as_mut().copy_from_slice(numbers);
    S::State::from_array(array)
}

fn unpacked<X: State<Scalar = f64>>(state: &X) -> Vec<f64> {
    state.to_array().as_ref().to_vec()
}

/// The entry of a declaration.
#[must_use]
pub fn entry<S: Catalogued + 'static>() -> Box<dyn Entry> {
    Box::new(Declaration::<S>(PhantomData))
}

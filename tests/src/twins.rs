//! Systems in both formulations, from one declaration.

use crate::catalogue::{Catalogued, Entry, entry};
use crate::systems;

/// Declares a system twice: as it stands, and with `formulation { projected }` added.
macro_rules! both {
    (
        $(#[doc = $doc:literal])*
        #[nonholonomic($($declaration:tt)*)]
        #[derive($($derived:ident),*)]
        pub struct $system:ident {
            $($(#[doc = $field_doc:literal])* pub $field:ident: $kind:ty),* $(,)?
        }
        projected $twin:ident
    ) => {
        $(#[doc = $doc])*
        #[nonholonomic($($declaration)*)]
        #[derive($($derived),*)]
        pub struct $system {
            $($(#[doc = $field_doc])* pub $field: $kind),*
        }

        $(#[doc = $doc])*
        ///
        /// The state keeps all velocities.
        #[nonholonomic($($declaration)* formulation { projected })]
        #[derive($($derived),*)]
        pub struct $twin {
            $($(#[doc = $field_doc])* pub $field: $kind),*
        }

        impl From<$system> for $twin {
            fn from($system { $($field),* }: $system) -> Self {
                Self { $($field),* }
            }
        }
    };
}
pub(crate) use both;

/// Implements [`Catalogued`] for the projected twin of a declaration.
macro_rules! projected {
    ($twin:ident of $system:ident { sections: $s:literal } $(with $inputs:literal inputs)? [$($label:ident),*]) => {
        impl $crate::catalogue::Catalogued for $twin {
            const REFERENCE: &'static str = <$system as $crate::catalogue::Catalogued>::REFERENCE;
            const ANGLES: &'static [usize] = <$system as $crate::catalogue::Catalogued>::ANGLES;

            fn parameters(values: &$crate::values::Values) -> Self {
                <$system as $crate::catalogue::Catalogued>::parameters(values).into()
            }
            fn covers(values: &$crate::values::Values) -> bool {
                <$system as $crate::catalogue::Catalogued>::covers(values)
            }
            $crate::twins::projected!(@input $system $(, $inputs)?);
            fn state(reading: &$crate::values::Reading) -> Vec<$crate::values::Moving> {
                let velocities = Self::velocities(reading);
                let names = <<Self as nonholonomic::Dynamics>::State as nonholonomic::State>::names();
                let coordinates = names.as_ref().len() - velocities.len();
                let kept = <$system as $crate::catalogue::Catalogued>::state(reading);
                [&kept[..coordinates], &velocities].concat()
            }
            fn velocities(reading: &$crate::values::Reading) -> Vec<$crate::values::Moving> {
                <$system as $crate::catalogue::Catalogued>::velocities(reading)
            }
            fn generated_velocities(
                &self,
                t: f64,
                state: &<Self as nonholonomic::Dynamics>::State,
            ) -> Vec<f64> {
                let velocity: [f64; $s] = self.velocity(t, state).into();
                velocity.to_vec()
            }
            $crate::twins::projected!(@multipliers $($label),*);
        }
    };
    (@input $system:ident) => {
        fn input(_: &$crate::values::Values, _: f64) -> <Self as nonholonomic::Dynamics>::Input {
            Default::default()
        }
    };
    (@input $system:ident, $inputs:literal) => {
        fn input(values: &$crate::values::Values, t: f64) -> <Self as nonholonomic::Dynamics>::Input {
            let numbers: [f64; $inputs] =
                <$system as $crate::catalogue::Catalogued>::input(values, t).into();
            numbers.into()
        }
    };
    (@multipliers) => {};
    (@multipliers $($label:ident),+) => {
        fn generated_multipliers(
            &self,
            t: f64,
            state: &<Self as nonholonomic::Dynamics>::State,
            input: &<Self as nonholonomic::Dynamics>::Input,
        ) -> Option<$crate::catalogue::Labelled> {
            let multipliers = self.multipliers(t, state, input);
            Some(vec![$((stringify!($label), multipliers.$label)),+])
        }
    };
}
pub(crate) use projected;

/// A system in the adapted and in the projected formulation.
pub struct Twins {
    /// The adapted formulation.
    pub adapted: Box<dyn Entry>,
    /// The projected formulation.
    pub projected: Box<dyn Entry>,
}

fn twins<A: Catalogued + 'static, P: Catalogued + 'static>() -> Twins {
    Twins { adapted: entry::<A>(), projected: entry::<P>() }
}

/// Every constrained system of the catalogue that has an adapted formulation, in both.
#[must_use]
pub fn systems_in_both_formulations() -> Vec<Twins> {
    macro_rules! pairs {
        ($($module:ident { $($adapted:ident $(, $projected:ident)?;)* })*) => {
            vec![$($($(twins::<systems::$module::$adapted, systems::$module::$projected>(),)?)*)*]
        };
    }
    crate::every_system!(pairs)
}

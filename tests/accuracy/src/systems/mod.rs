//! The reference systems, each declared once for all levels.
#![allow(non_snake_case, reason = "parameters are written as in mechanics: J, I, R, Omega")]

use std::marker::PhantomData;

use crate::measured::Study;

/// Declares a system at every level and implements [`Measured`](crate::measured::Measured): numbers of the
/// table, and the struct from a list of parameters. At the end stands the declaration, in braces or as one of
/// [`nh_models`].
macro_rules! measured {
    (
        $module:ident, $name:literal, $numbers:expr,
        $(#[doc = $doc:literal])*
        struct $System:ident, $State:ident $(, $Input:ident of $inputs:literal)? { $($field:ident: $kind:ty),* $(,)? }
        from |$p:ident| $make:tt,
        states $states:literal of $all:literal,
        $($declaration:tt)+
    ) => {
        $(#[doc = $doc])*
        pub mod $module {
            measured!(@level fast, $System, $State, [$($Input, $inputs)?], [$($field: $kind),*], $p, $make, $states, $all, $($declaration)+);
            measured!(@level balanced, $System, $State, [$($Input, $inputs)?], [$($field: $kind),*], $p, $make, $states, $all, $($declaration)+);
            measured!(@level careful, $System, $State, [$($Input, $inputs)?], [$($field: $kind),*], $p, $make, $states, $all, $($declaration)+);

            measured!(@twin $System, $State, [$($Input, $inputs)?], [$($field: $kind),*], $p, $make, $all, $($declaration)+);

            /// The system at every level.
            #[derive(Clone, Copy, Debug)]
            pub struct Levels;
        }

        impl $crate::measured::Measured for $module::Levels {
            const NAME: &'static str = $name;
            const NUMBERS: $crate::places::Numbers = $numbers;
            type Fast = $module::fast::Emitted;
            type Balanced = $module::balanced::Emitted;
            type Careful = $module::careful::Emitted;
            type Twin = $module::twin::Emitted;
        }
    };
    (
        @level $level:ident, $System:ident, $State:ident, [$($Input:ident, $inputs:literal)?],
        [$($field:ident: $kind:ty),*], $p:ident, $make:tt, $states:literal, $all:literal, $($declaration:tt)+
    ) => {
        /// Emitted at this level.
        pub mod $level {
            use nonholonomic::prelude::*;

            measured!(@emitted { accuracy { $level } } $System, $State of $states, [$($field: $kind),*], $p, $make, $($declaration)+);

            type Input<T> = <$System<T> as Dynamics>::Input;

            fn input<T: nonholonomic::Scalar>(list: &[T]) -> Input<T> {
                measured!(@input list $($Input, $inputs)?)
            }

            #[inline(never)]
            fn counted(system: &$System<f64>, state: &$State<f64>, input: &Input<f64>) -> $State<f64> {
                system.derivative(0.0, state, input)
            }

            impl $crate::measured::Level for Emitted {
                fn derivative<T: nonholonomic::Scalar>(parameters: &[T], at: &[T], inputs: &[T]) -> Vec<T> {
                    let rate = system(parameters).derivative(T::ZERO, &state(at), &input(inputs));
                    let rate: [T; $states] = rate.into();
                    rate.to_vec()
                }
                fn velocity<T: nonholonomic::Scalar>(parameters: &[T], at: &[T]) -> Vec<T> {
                    const SECTIONS: usize =
                        $all - <super::Levels as $crate::measured::Measured>::NUMBERS.velocities;
                    let velocity: [T; SECTIONS] = system(parameters).velocity(T::ZERO, &state(at)).into();
                    velocity.to_vec()
                }
                fn evaluated(place: &$crate::places::Place) {
                    let (system, state) = (system(&place.parameters), state(&place.state));
                    std::hint::black_box(counted(&system, &state, &input(&place.input)));
                }
                fn symbol() -> &'static str {
                    concat!(module_path!(), "::counted")
                }
            }
        }
    };
    (
        @twin $System:ident, $State:ident, [$($Input:ident, $inputs:literal)?],
        [$($field:ident: $kind:ty),*], $p:ident, $make:tt, $all:literal, $($declaration:tt)+
    ) => {
        /// With all velocities in the state, and multipliers.
        pub mod twin {
            use nonholonomic::prelude::*;

            measured!(@emitted { formulation { projected } } $System, $State of $all, [$($field: $kind),*], $p, $make, $($declaration)+);

            impl $crate::measured::Twin for Emitted {
                fn derivative<T: nonholonomic::Scalar>(parameters: &[T], at: &[T], inputs: &[T]) -> Vec<T> {
                    let input = measured!(@input inputs $($Input, $inputs)?);
                    let rate: [T; $all] = system(parameters).derivative(T::ZERO, &state(at), &input).into();
                    rate.to_vec()
                }
                fn residual<T: nonholonomic::Scalar>(parameters: &[T], at: &[T]) -> Vec<T> {
                    let system = system(parameters);
                    Constrained::constraint_residual(&system, T::ZERO, &state(at)).as_ref().to_vec()
                }
            }
        }
    };
    (
        @emitted { $($more:tt)* } $System:ident, $State:ident of $components:literal,
        [$($field:ident: $kind:ty),*], $p:ident, $make:tt, $($declaration:tt)+
    ) => {
        measured! {
            @declare { $($more)* }
            /// The parameters.
            #[derive(Clone, Copy, Debug)]
            pub struct $System<T> { $($field: $kind),* }
            as $($declaration)+
        }

        /// The system in this form.
        #[derive(Clone, Copy, Debug)]
        pub struct Emitted;

        fn system<T: nonholonomic::Scalar>($p: &[T]) -> $System<T> {
            $System $make
        }

        fn state<T: nonholonomic::Scalar>(list: &[T]) -> $State<T> {
            let components: [T; $components] = core::array::from_fn(|i| list[i]);
            components.into()
        }
    };
    (@declare { $($more:tt)* } $parameters:item as { $($sections:tt)* }) => {
        #[nonholonomic($($sections)* $($more)*)]
        $parameters
    };
    (@declare { $($more:tt)* } $parameters:item as nh_models::$system:ident!($($sizes:tt)*)) => {
        nh_models::$system! { $($sizes)* $parameters $($more)* }
    };
    (@input $list:ident) => { { let _ = $list; } };
    (@input $list:ident $Input:ident, $inputs:literal) => {
        { let inputs: [T; $inputs] = core::array::from_fn(|i| $list[i]); $Input::from(inputs) }
    };
}

pub mod bodies;
pub mod tractors;

/// Every system of the table.
#[must_use]
pub fn all() -> Vec<Box<dyn Study>> {
    vec![
        Box::new(PhantomData::<bodies::sleigh::Levels>),
        Box::new(PhantomData::<bodies::veselova::Levels>),
        Box::new(PhantomData::<bodies::snakeboard::Levels>),
        Box::new(PhantomData::<bodies::robot::Levels>),
        Box::new(PhantomData::<bodies::ball::Levels>),
        Box::new(PhantomData::<bodies::board_in_coordinates::Levels>),
        Box::new(PhantomData::<bodies::sleigh_on_the_plane::Levels>),
        Box::new(PhantomData::<bodies::knife_edge::Levels>),
        Box::new(PhantomData::<bodies::vehicle::Levels>),
        Box::new(PhantomData::<bodies::two_links::Levels>),
        Box::new(PhantomData::<tractors::one::Levels>),
        Box::new(PhantomData::<tractors::two::Levels>),
        Box::new(PhantomData::<tractors::three::Levels>),
        Box::new(PhantomData::<tractors::four::Levels>),
        Box::new(PhantomData::<tractors::five::Levels>),
        Box::new(PhantomData::<tractors::six::Levels>),
    ]
}

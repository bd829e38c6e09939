//! Declarations in surroundings that take every common name for themselves: they have to compile
//! without a warning, and to compute what they compute elsewhere.
#![deny(warnings, missing_docs, clippy::pedantic)]

/// Shadows the prelude, the standard crates, elementary functions and short names.
#[allow(non_snake_case, non_upper_case_globals, non_camel_case_types, unused_macros, clippy::all)]
#[allow(clippy::pedantic, reason = "the surroundings are odd on purpose; generated code is not excused")]
pub mod shadowed {
    macro_rules! shadowing {
        ($($name:ident)*) => { $(macro_rules! $name { ($d:tt) => { compile_error!("not this macro") } })* };
    }
    shadowing! { matches vec assert assert_eq debug_assert panic write format unreachable todo }

    /// Not the standard one.
    pub struct Option;
    /// Not the standard one.
    pub struct Some;
    /// Not the standard one.
    pub struct None;
    /// Not the standard one.
    pub struct Result;
    /// Not the standard one.
    pub struct Ok;
    /// Not the standard one.
    pub struct Err;
    /// Not the standard one.
    pub struct Vec;
    /// Not the standard one.
    pub struct String;
    /// Not the standard one.
    pub struct Box;
    /// Not the primitive.
    pub struct f32;
    /// Not the primitive.
    pub struct usize;
    /// Not the primitive.
    pub struct bool;
    /// Not the primitive.
    pub struct str;
    /// Not the standard one.
    pub trait Default {}
    /// Not the standard one.
    pub trait Clone {}
    /// Not the standard one.
    pub trait Copy {}
    /// Not the standard one.
    pub trait From {}
    /// Not the standard one.
    pub trait Into {}
    /// Not the standard one.
    pub trait Fn {}
    /// Not the standard one.
    pub trait Send {}
    /// Not the standard one.
    pub trait Sized {}
    /// Not the standard one.
    pub trait Iterator {}
    /// Not the runtime's.
    pub trait Dynamics {}
    /// Not the runtime's.
    pub trait State {}
    /// Not the runtime's.
    pub trait Energy {}
    /// Not the runtime's.
    pub trait Scalar {}
    /// Not the crate.
    pub mod core {}
    /// Not the crate.
    pub mod std {}
    /// Not the crate.
    pub mod alloc {}
    /// Not the crate.
    pub mod nonholonomic {}
    /// Not the crate.
    pub mod nalgebra {}
    /// Not a sine.
    pub fn sin() {}
    /// Not a cosine.
    pub fn cos() {}
    /// Not a root.
    pub fn sqrt() {}
    /// Not a conversion.
    pub fn from() {}
    /// Not a fused multiplication.
    pub fn mul_add() {}
    /// Takes a name that generated code may bind.
    pub const J: u8 = 0;

    /// Offers methods under the names of elementary functions.
    pub trait Loud {
        /// Not a sine.
        fn sin(&self) {}
        /// Not both.
        fn sin_cos(&self) {}
        /// Not a root.
        fn sqrt(&self) {}
        /// Not a power.
        fn powi(&self) {}
        /// Not a reciprocal.
        fn recip(&self) {}
        /// Not a conversion.
        fn into(&self) {}
        /// Not a test.
        fn is_finite(&self) {}
        /// Not a fused multiplication.
        fn mul_add(&self) {}
    }
    impl Loud for f64 {}

    pub use declared::{
        Bob, BobState, Body, BodyState, Drop, DropState, Ferry, FerryState, Sleigh, SleighInput, SleighState,
        SleighVelocity,
    };

    #[deny(warnings, missing_docs, clippy::pedantic)]
    mod declared {
        #[allow(unused_imports, clippy::wildcard_imports, reason = "brings the shadows in")]
        use super::*;

        /// A sleigh with a parameter that no equation needs.
        #[::nonholonomic::nonholonomic(
            base   { theta, x, y }
            basis  { omega, v1, v2 }
            anchor {
                der(theta) = omega;
                der(x) = v1 * cos(theta) - v2 * sin(theta);
                der(y) = v1 * sin(theta) + v2 * cos(theta);
            }
            lagrangian  { (J + I * a^2) / 2 * omega^2 + I / 2 * (v1^2 + v2^2) + I * a * omega * v2 + 0 * unused }
            constraints { v2 = 0; }
            forces      { omega: torque - r#type * omega; v1: -sqrt(1 + t^2) * v1 * r#type; }
            inputs      { torque }
            outputs     { phase = v1; covector = omega; }
            emit        {
                jacobian, sparse_jacobian, jacobian_product, adjoint_product,
                parameter_jacobian, prepared, angle_cache, hamiltonian, bracket, divergence, connection, gibbs_appell,
                taylor
            }
        )]
        #[derive(Clone, Copy, Debug)]
        #[allow(non_snake_case, reason = "as in mechanics")]
        pub struct Sleigh {
            /// Moment of inertia about the centre of mass.
            pub J: f64,
            /// Mass.
            pub I: f64,
            /// Offset of the centre of mass.
            pub a: f64,
            /// Friction.
            pub r#type: f64,
            /// Nothing depends on it.
            pub unused: f64,
        }

        /// A blade with multipliers and a projection, under names that these may want.
        #[::nonholonomic::nonholonomic(
            base { start, present, project }
            formulation { projected }
            outputs { covector = der(start); phase = start; }
            conserved { length = der(start); }
            volume;
            emit {
                jacobian, parameter_jacobian, prepared, angle_cache, multipliers, reactions, leapfrog, bracket, discrete_gradient,
                divergence, volume, connection, invariants, gibbs_appell, taylor
            }
            lagrangian { (der(start)^2 + J * der(present)^2 + der(project)^2) / 2 - project }
            constraints {
                state: cos(start) * der(project) - sin(start) * der(present) = 0;
            }
        )]
        #[derive(Clone, Copy, Debug)]
        #[allow(non_snake_case, reason = "as in mechanics")]
        pub struct Ferry {
            /// Ratio of inertias.
            pub J: f64,
        }

        /// A particle whose constraints are a gyroscopic force.
        #[::nonholonomic::nonholonomic(
            base { phase, covector, p_phase }
            lagrangian { J / 2 * (der(phase)^2 + der(covector)^2 + der(p_phase)^2) - sqrt(1 + phase^2) }
            constraints { der(p_phase) = sin(covector) * der(phase); }
            outputs { density = der(phase); }
            conserved { length = der(covector); }
            symmetries { drift: der(covector); }
            volume;
            hamilton_jacobi {
                phase_dot: sqrt(1 + sin(covector)^2) * sqrt(2 * J * (c - sqrt(1 + phase^2)));
                covector_dot: J;
            }
            emit {
                hamiltonian, bracket, discrete_gradient, divergence, volume, connection, invariants, gyroscopic,
                splitting, gibbs_appell, taylor, momenta
            }
        )]
        #[derive(Clone, Copy, Debug)]
        #[allow(non_snake_case, reason = "as in mechanics")]
        pub struct Drop {
            /// A mass.
            pub J: f64,
            /// An energy.
            pub c: f64,
        }

        /// A mass on a rod, under names that steps may want.
        #[::nonholonomic::nonholonomic(
            base { given, held }
            holonomic { velocity: given^2 + held^2 = J^2; }
            lagrangian { (der(given)^2 + der(held)^2) / 2 - held }
            impacts { floor: given >= J / 2 with restitution 1 / 2; }
            outputs { slopes = given * der(held); }
            emit {
                rattle, symmetric_projection, discrete_gradient, jacobian, sparse_jacobian, jacobian_product,
                adjoint_product, return_jacobian, output_jacobian, power, explain, latex, c
            }
        )]
        #[derive(Clone, Copy, Debug)]
        #[allow(non_snake_case, reason = "as in mechanics")]
        pub struct Bob {
            /// The length of the rod.
            pub J: f64,
        }

        /// A body with a fixed point, one of whose angular velocities vanishes.
        #[::nonholonomic::nonholonomic(
            basis { length, matrix, body }
            brackets so(3) { length, matrix, body }
            lagrangian { (J * length^2 + c * matrix^2 + body^2) / 2 }
            constraints { body = 0; }
            conserved { invariants = length; }
            emit { euler_poincare_suslov, hamiltonian, discrete_gradient, volume, connection, invariants, taylor }
        )]
        #[derive(Clone, Copy, Debug)]
        #[allow(non_snake_case, reason = "as in mechanics")]
        pub struct Body {
            /// A moment of inertia.
            pub J: f64,
            /// A moment of inertia.
            pub c: f64,
        }
    }
}

/// Names that generated code may want for itself, taken by a declaration.
pub mod colliding {
    use nonholonomic::nonholonomic;

    /// A particle on a line in odd coordinates.
    #[nonholonomic(
        base { state, input, result, out, value }
        lagrangian {
            system / 2 * (der(state)^2 + der(input)^2 + der(result)^2 + der(out)^2 + der(value)^2)
                - f / 2 * (state^2 + velocity * input^2) - h * sin(result) - array * out - c0 * value
        }
    )]
    #[derive(Clone, Copy, Debug)]
    pub struct Odd {
        /// A mass.
        pub system: f64,
        /// A stiffness.
        pub f: f64,
        /// A ratio.
        pub velocity: f64,
        /// A force.
        pub h: f64,
        /// A force.
        pub array: f64,
        /// A force.
        pub c0: f64,
    }
}

/// Items of narrow visibility, of which the user needs only a part.
pub mod narrow {
    use nonholonomic::nonholonomic;

    #[nonholonomic(
        base { angle }
        lagrangian { der(angle)^2 / 2 + ratio * cos(angle) }
    )]
    struct Pendulum {
        ratio: f64,
    }

    /// The angular acceleration of a pendulum.
    #[must_use]
    pub fn acceleration(angle: f64, ratio: f64) -> f64 {
        let start = PendulumState { angle, angle_dot: 0.0 };
        Pendulum { ratio }.derivative(0.0, &start, &()).angle_dot
    }

    /// The same for an oscillator that is declared in a function, by a macro of the user.
    #[must_use]
    pub fn oscillation(position: f64) -> f64 {
        #[rustfmt::skip]
        macro_rules! oscillator {
            ($name:ident, $state:ident, $stiffness:literal, $kinetic:expr) => {
                #[nonholonomic(
                    names { state = $state; }
                    base { q }
                    lagrangian { $kinetic - $stiffness / 2 * q^2 }
                )]
                struct $name {}
            };
        }
        oscillator!(Oscillator, OscillatorState, 3, der(q) * der(q) / 2);
        let start = OscillatorState { q: position, q_dot: 0.0 };
        Oscillator {}.derivative(0.0, &start, &()).q_dot
    }
}

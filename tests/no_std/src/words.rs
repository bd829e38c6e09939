//! Everything that `emit` can ask for, on systems that allow it, without `std`: in `f32`, in `f64`, and for
//! any scalar; in modules that import nothing; under names that the generated code has for its own.

/// The declarations, for a scalar type and the type parameters that it takes.
macro_rules! declarations {
    ($scalar:ident $($parameters:tt)*) => {
        /// A Chaplygin system on TQ: every word but those for groups and for all velocities.
        #[::nonholonomic::nonholonomic(
            base { start, phase, p_start }
            lagrangian { state / 2 * (der(start)^2 + der(phase)^2 + der(p_start)^2) - out * start }
            constraints { covector: der(p_start) = phase * der(start); }
            inputs { series, unit }
            outputs { length = der(start); density = phase; drift = state * der(phase); }
            conserved { hamiltonian = der(phase); }
            symmetries { divergence: der(phase); }
            volume;
            hamilton_jacobi {
                start_dot: sqrt(1 + phase^2) * sqrt(input - 2 * state * out * start);
                phase_dot: values;
            }
            assume { state > 0; }
            emit {
                hamiltonian, bracket, discrete_gradient, divergence, volume, connection, invariants, gyroscopic,
                splitting, gibbs_appell, taylor, momenta, multipliers, reactions, jacobian,
                sparse_jacobian, jacobian_product, adjoint_product, parameter_jacobian, prepared, angle_cache
            }
        )]
        #[derive(Clone, Copy, Debug)]
        pub struct Chaplygin $($parameters)* {
            /// A mass.
            pub state: $scalar,
            /// Of a momentum.
            pub input: $scalar,
            /// A force.
            pub out: $scalar,
            /// A momentum.
            pub values: $scalar,
        }

        /// The same with all velocities in the state: no momenta in a basis of D, no leap over them.
        #[::nonholonomic::nonholonomic(
            base { start, phase, p_start }
            lagrangian { state / 2 * (der(start)^2 + der(phase)^2 + der(p_start)^2) - out * start }
            constraints { covector: der(p_start) = phase * der(start); }
            outputs { length = der(start); density = phase; drift = state * der(phase); }
            conserved { hamiltonian = der(phase); }
            symmetries { divergence: der(phase); }
            volume { sqrt(1 + phase^2); }
            formulation { projected }
            assume { state > 0; }
            emit {
                leapfrog, bracket, discrete_gradient, divergence, volume, connection, invariants,
                gibbs_appell, taylor, momenta, multipliers, reactions, jacobian, parameter_jacobian, prepared, angle_cache
            }
        )]
        #[derive(Clone, Copy, Debug)]
        pub struct Projected $($parameters)* {
            /// A mass.
            pub state: $scalar,
            /// A force.
            pub out: $scalar,
        }

        /// On an Atiyah algebroid, with momentum equations.
        #[::nonholonomic::nonholonomic(
            base { series }
            basis { start, present[3] }
            anchor { der(series) = start; }
            brackets so(3) { present }
            lagrangian {
                (unit + phase * series^2) / 2 * (present[0]^2 + present[2]^2) + unit / 2 * present[1]^2
                    + phase / 2 * start^2 - cos(series)
            }
            constraints { body: present[2] = sin(series) * start; }
            outputs { matrix = present[0]; length = series; }
            emit {
                splitting, hamiltonian, bracket, discrete_gradient, divergence, connection, gibbs_appell, taylor,
                multipliers, reactions, jacobian, parameter_jacobian, prepared, angle_cache
            }
        )]
        #[derive(Clone, Copy, Debug)]
        pub struct Atiyah $($parameters)* {
            /// A moment of inertia.
            pub unit: $scalar,
            /// A mass.
            pub phase: $scalar,
        }

        /// On a Lie algebra.
        #[::nonholonomic::nonholonomic(
            basis { present, workspace, body }
            brackets so(3) { present, workspace, body }
            lagrangian { (I[0] * present^2 + I[1] * workspace^2 + I[2] * body^2) / 2 }
            constraints { multiplier: body = 0; }
            outputs { poisson = I[0] * present; legendre = workspace; }
            conserved { spin = present; }
            volume;
            emit {
                euler_poincare_suslov, hamiltonian, bracket, discrete_gradient, divergence, volume, connection,
                invariants, gibbs_appell, taylor, multipliers, reactions, jacobian, parameter_jacobian, prepared, angle_cache
            }
        )]
        #[derive(Clone, Copy, Debug)]
        pub struct Group $($parameters)* {
            /// Principal moments of inertia.
            pub I: [$scalar; 3],
        }

        /// On a sphere in space, with a rotor that is driven: affine in the velocities, no energy.
        #[::nonholonomic::nonholonomic(
            base { state[3] }
            on { dot(state, state) = 1; }
            basis { out[3] }
            anchor { der(state) = cross(state, out); }
            brackets so(3) { out }
            lagrangian { sum(i in 0..3: I[i] * out[i]^2) / 2 - f * state[2] }
            constraints { out[2] = unit; }
            forces { out[0]: -c0 * out[0] + input; }
            inputs { input }
            outputs { phase = state; p_out = out[0]; }
            symmetries { g: out[0]; }
            emit {
                hamiltonian, bracket, divergence, gibbs_appell, taylor, momenta,
                multipliers, reactions, jacobian, parameter_jacobian, prepared, angle_cache
            }
        )]
        #[derive(Clone, Copy, Debug)]
        pub struct Embedded $($parameters)* {
            /// Principal moments of inertia.
            pub I: [$scalar; 3],
            /// A weight.
            pub f: $scalar,
            /// A friction.
            pub c0: $scalar,
            /// A spin.
            pub unit: $scalar,
        }
    };
}

/// In single precision.
pub mod single {
    declarations!(f32);
}

/// In double precision.
pub mod double {
    declarations!(f64);
}

/// In any.
pub mod generic {
    declarations!(T<T>);
}

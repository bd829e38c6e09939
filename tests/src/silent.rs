//! Declarations in every honest form, under every lint that is not a matter of taste: generated code says
//! nothing. What a user is told about the struct they wrote, they have answered there.
#![deny(warnings, missing_docs, unused, nonstandard_style, deprecated, clippy::pedantic)]

/// Attributes on structs and on their fields.
pub mod attributes {
    use nonholonomic::nonholonomic;

    /// A skate that nobody should use.
    #[nonholonomic(
        base { x, y }
        lagrangian { m / 2 * (der(x)^2 + der(y)^2) }
        constraints { der(y) = x * der(x); }
        inputs { u }
        forces { x: 0 * u; }
        outputs { speed = der(x); }
        conserved { length = der(x)^2 * (1 + x^2); }
        formulation { projected }
        emit {
            jacobian, sparse_jacobian, jacobian_product, adjoint_product,
            parameter_jacobian, prepared, angle_cache, bracket, multipliers, reactions, divergence, volume, connection,
            invariants, gibbs_appell, taylor
        }
    )]
    #[deprecated(since = "1.0.0", note = "use another")]
    #[must_use = "systems are there to be used"]
    #[non_exhaustive]
    #[repr(C)]
    #[derive(Clone, Copy, Debug)]
    pub struct Old {
        /// A mass.
        pub m: f64,
    }

    /// An oscillator that is hidden, and deprecated on a condition.
    #[nonholonomic(
        base { x }
        lagrangian { m / 2 * der(x)^2 - k * x^2 }
        emit { jacobian, prepared, angle_cache, hamiltonian, explain, discrete_gradient }
    )]
    #[doc(hidden)]
    #[cfg_attr(all(), derive(Clone, Copy, Debug), cfg_attr(all(), deprecated))]
    pub struct Hidden {
        /// A mass.
        pub m: f64,
        /// A stiffness.
        pub k: f64,
    }

    /// An oscillator with a field that nobody should use.
    #[nonholonomic(
        base { x }
        lagrangian { m / 2 * der(x)^2 - k * x^2 }
        emit { jacobian, prepared, angle_cache, hamiltonian }
    )]
    #[derive(Clone, Copy, Debug)]
    pub struct OldField {
        /// A mass.
        pub m: f64,
        /// A stiffness.
        #[deprecated]
        pub k: f64,
    }

    /// What the user expects is met, though the macro would allow it.
    #[nonholonomic(
        base { X }
        lagrangian { M / 2 * der(X)^2 - _k * X^2 }
        emit { jacobian, prepared, angle_cache, hamiltonian }
    )]
    #[expect(non_snake_case, clippy::pub_underscore_fields, reason = "as in mechanics")]
    #[derive(Clone, Copy, Debug)]
    pub struct Expected {
        /// A mass.
        pub M: f64,
        /// A stiffness.
        pub _k: f64,
    }

    /// What the user allows for the struct holds for what has its name from it.
    #[nonholonomic(
        base { x }
        lagrangian { m / 2 * der(x)^2 - k * x^2 }
        inputs { u }
        forces { x: u; }
        outputs { place = x; }
        emit { jacobian, prepared, angle_cache, hamiltonian }
    )]
    #[allow(non_camel_case_types, deprecated, reason = "as in another language")]
    #[deprecated]
    #[derive(Clone, Copy, Debug)]
    pub struct lower_case<real = f64> {
        /// A mass.
        pub m: real,
        /// A stiffness.
        pub k: real,
    }

    /// A reduction names both of its structs.
    #[nonholonomic(base { _x, Y } lagrangian { _m / 2 * (der(_x)^2 + der(Y)^2) - _m * cos(_x) })]
    #[deprecated]
    #[derive(Clone, Copy, Debug)]
    pub struct Full {
        /// A mass.
        pub _m: f64,
    }

    nonholonomic::quotient! {
        Full ->
        /// What is left without the coordinate in capitals.
        #[derive(Clone, Copy, Debug)]
        #[deprecated]
        pub struct Quotient by { Y }
    }
}

/// Names that begin or end with underscores.
pub mod underscores {
    use nonholonomic::nonholonomic;

    /// On both sides, in all places.
    #[nonholonomic(
        base { _x, __y, z_, w__, __ }
        lagrangian {
            _m / 2 * (der(_x)^2 + der(__y)^2 + der(z_)^2 + der(w__)^2 + der(__)^2) - __k * _x^2 - k_ * w__
        }
        constraints { _label: der(z_) = _x * der(__y); }
        inputs { _u, _unused_input }
        forces { _x: _u; }
        outputs { _speed = der(_x); __o = der(__y) * _m; }
        emit {
            jacobian, parameter_jacobian, prepared, angle_cache, hamiltonian, bracket, multipliers, reactions, divergence, volume,
            connection, gibbs_appell, taylor, explain
        }
    )]
    #[derive(Clone, Copy, Debug)]
    pub struct Under {
        /// A mass.
        pub _m: f64,
        /// A stiffness.
        pub __k: f64,
        /// A force.
        pub k_: f64,
        /// Nothing depends on it.
        pub _unused: f64,
    }

    /// In a basis, with a projection.
    #[nonholonomic(
        base { _x }
        basis { _v, __w_ }
        anchor { der(_x) = _v; }
        brackets { }
        lagrangian { _m / 2 * (_v^2 + __w_^2) - _m * _x^2 }
        constraints { _c: __w_ = 0; }
        inputs { _u }
        forces { _v: 0 * _u; }
        outputs { _speed = _v; }
        conserved { _e = _v^2 * _m / 2 + _m * _x^2; }
        formulation { projected }
        emit {
            jacobian, parameter_jacobian, prepared, angle_cache, bracket, multipliers, reactions, divergence, volume, connection,
            invariants, gibbs_appell, taylor
        }
    )]
    #[derive(Clone, Copy, Debug)]
    pub struct Projected {
        /// A mass.
        pub _m: f64,
    }

    /// In families, and for the scalar.
    #[nonholonomic(
        base { _q[3] }
        lagrangian { sum(i in 0..3: _m[i] / 2 * der(_q[i])^2 + _g * _q[i]^2 * (1 + t^2)) }
        constraints { _l: der(_q[2]) = sin(_q[0]) * der(_q[1]); }
        inputs { _u[2] }
        forces { _q[0]: _u[0] - _u[1]; }
        emit { jacobian, prepared, angle_cache, hamiltonian, taylor }
    )]
    #[derive(Clone, Copy, Debug)]
    pub struct Families<_T = f64>
    where
        _T: Clone,
    {
        /// Masses.
        pub _m: [_T; 3],
        /// A stiffness.
        pub _g: _T,
    }

    /// For the struct.
    #[nonholonomic(base { x } lagrangian { m / 2 * der(x)^2 } emit { jacobian })]
    #[derive(Clone, Copy, Debug)]
    pub struct _Under {
        /// A mass.
        pub m: f64,
    }
}

/// Names that generated code has too, raw names and Greek ones.
pub mod names {
    use nonholonomic::nonholonomic;

    /// Of arguments and results.
    #[nonholonomic(
        base { values, rows, phase, length }
        lagrangian {
            t_ / 2 * (der(values)^2 + der(rows)^2 + der(phase)^2 + der(length)^2) + covector * values^2
                - name * cos(rows)
        }
        constraints {
            value: der(length) = sin(values) * der(phase);
            self_: der(rows) = values * der(phase);
        }
        inputs { input, workspace }
        forces { values: input * state - workspace; }
        outputs { present = der(values) + start; unit = input; }
        emit {
            jacobian, parameter_jacobian, prepared, angle_cache, hamiltonian, bracket, multipliers, reactions, divergence, volume,
            connection, gibbs_appell, taylor, explain
        }
    )]
    #[derive(Clone, Copy, Debug)]
    pub struct Taken {
        /// A mass.
        pub t_: f64,
        /// A force.
        pub state: f64,
        /// A stiffness.
        pub covector: f64,
        /// A weight.
        pub name: f64,
        /// A speed.
        pub start: f64,
        /// Nothing depends on it.
        pub series: f64,
    }

    /// Keywords, and letters of another script in both cases.
    #[nonholonomic(
        base { r#type, θ, Φ }
        basis { r#move, ω_, Ω }
        anchor { der(r#type) = r#move * cos(θ); der(θ) = ω_; der(Φ) = Ω; }
        lagrangian { r#struct / 2 * (r#move^2 + ω_^2 + Ω^2 * μ) - r#struct * cos(Φ) }
        constraints { r#loop: Ω = sin(Φ) * r#move; }
        inputs { r#in, τ }
        forces { r#move: r#in; ω_: τ * 2; }
        outputs { r#fn = r#move; Ψ = Ω; }
        emit {
            jacobian, parameter_jacobian, prepared, angle_cache, bracket, multipliers, reactions, divergence, connection,
            gibbs_appell, taylor, explain
        }
    )]
    #[derive(Clone, Copy, Debug)]
    pub struct Raw<T = f64>
    where
        T: Copy + Clone,
    {
        /// A mass.
        pub r#struct: T,
        /// A ratio.
        pub μ: T,
        /// Nothing depends on it.
        pub r#dyn: T,
    }

    /// A lifetime, a parameter that is not the scalar, bounds in both places, and defaults.
    #[nonholonomic(
        base { x, y, z }
        lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) - g * sin(x) }
        constraints { der(z) = x * der(y); }
        inputs { u }
        forces { x: u; }
        outputs { s = der(x); }
        emit {
            jacobian, parameter_jacobian, prepared, angle_cache, hamiltonian, bracket, multipliers, reactions, divergence, volume,
            connection, gibbs_appell, taylor, explain
        }
    )]
    #[derive(Clone, Copy, Debug)]
    #[deprecated]
    pub struct Generic<'a, S: Copy = f64, N: Clone + Copy = &'a str>
    where
        N: Sized,
    {
        /// A mass.
        pub m: S,
        /// A weight.
        pub g: S,
        /// No parameter.
        #[nh(skip)]
        pub name: &'a N,
    }
}

/// Narrow visibility, of which only a part is used.
pub mod narrow {
    use nonholonomic::nonholonomic;

    mod inner {
        use nonholonomic::nonholonomic;

        #[nonholonomic(
            base { x, Y, Z }
            lagrangian { m / 2 * (der(x)^2 + der(Y)^2 + der(Z)^2) - g * sin(x) + 0 * unused }
            constraints { Label: der(Z) = x * der(Y); }
            inputs { U }
            forces { x: U; }
            outputs { S = der(x); }
            emit {
                jacobian, parameter_jacobian, prepared, angle_cache, hamiltonian, bracket, multipliers, reactions, divergence,
                volume, connection, gibbs_appell, taylor, explain
            }
        )]
        #[derive(Clone, Copy)]
        pub(super) struct Super {
            pub(super) m: f64,
            g: f64,
            unused: f64,
        }

        impl Super {
            pub(super) const ONE: Self = Self { m: 1.0, g: 2.0, unused: 0.0 };
        }

        #[nonholonomic(
            base { x, y, z }
            lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) - g * sin(x) }
            constraints { der(z) = x * der(y); }
            formulation { projected }
            emit {
                jacobian, parameter_jacobian, prepared, angle_cache, multipliers, reactions, divergence, volume, connection,
                gibbs_appell, taylor, explain
            }
        )]
        #[derive(Clone, Copy)]
        pub(crate) struct Crate<T>
        where
            T: Copy,
        {
            pub(crate) m: T,
            pub(crate) g: T,
        }
    }

    #[nonholonomic(base { x } lagrangian { m / 2 * der(x)^2 })]
    #[expect(dead_code, reason = "nobody uses it")]
    struct Unused {
        m: f64,
    }

    /// Uses one function of each.
    #[must_use]
    pub fn sum() -> f64 {
        #[nonholonomic(
            base { x }
            lagrangian { m / 2 * der(x)^2 - m * g * x }
            inputs { u }
            forces { x: u; }
            outputs { s = x; }
            emit { jacobian, hamiltonian, taylor }
        )]
        struct Inside {
            m: f64,
            g: f64,
            _unused: f64,
        }
        let own = inner::Super::ONE;
        let rate = own.derivative(0.0, &inner::SuperState::default(), &inner::SuperInput::default());
        let other = inner::Crate { m: own.m, g: 4.0 }.derivative(0.0, &inner::CrateState::default(), &());
        let inside = Inside { m: 1.0, g: 8.0, _unused: 0.0 };
        let inside = inside.derivative(0.0, &InsideState::default(), &InsideInput { u: 0.5 });
        rate.x_dot + other.x_dot + inside.x_dot
    }
}

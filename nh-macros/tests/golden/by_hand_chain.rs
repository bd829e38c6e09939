impl<T: ::nonholonomic::__private::Scalar> ::core::cmp::PartialEq for ChainState<T> {
    fn eq(&self, other: &Self) -> ::core::primitive::bool {
        true && self.q == other.q && self.R == other.R && self.w_0 == other.w_0
            && self.w_2 == other.w_2
    }
}
impl<T: ::nonholonomic::__private::Scalar> ::core::cmp::PartialEq for ChainVelocity<T> {
    fn eq(&self, other: &Self) -> ::core::primitive::bool {
        true && self.w == other.w && self.u == other.u
    }
}
#[automatically_derived]
impl<T> ::nonholonomic::__private::Dynamics for Chain<T>
where
    T: ::nonholonomic::__private::Scalar,
{
    type State = ChainState<T>;
    type Input = ();
    #[inline(always)]
    #[allow(clippy::inline_always)]
    fn derivative(&self, t: T, state: &ChainState<T>, input: &()) -> ChainState<T> {
        Self::derivative(self, t, state, input)
    }
    #[inline]
    fn validate(
        &self,
    ) -> ::core::result::Result<(), ::nonholonomic::__private::ParameterError> {
        Self::validate(self)
    }
}
#[automatically_derived]
impl<T> ::nonholonomic::__private::Energy for Chain<T>
where
    T: ::nonholonomic::__private::Scalar,
{
    #[inline]
    fn energy(&self, t: T, state: &ChainState<T>) -> T {
        Self::energy(self, t, state)
    }
}
impl<T> Chain<T>
where
    T: ::nonholonomic::__private::Scalar,
{
    /// What was derived from the declaration, as text.
    pub const REPORT: &'static ::core::primitive::str = "Derived by hand.\n\nOperations per evaluation:\n  derivative: 3 additions, 3 multiplications, 3 multiply-adds, 3 divisions, 1 sin_cos, 2 functions\n  energy: 3 multiplications\n  velocity: no operations\n";
    /// The time derivative of the state: the field `x` of the result is ẋ.
    #[must_use]
    #[inline(always)]
    #[allow(clippy::inline_always)]
    pub fn derivative(&self, t: T, state: &ChainState<T>, input: &()) -> ChainState<T> {
        _ = t;
        _ = input;
        let (sin, cos) = ::nonholonomic::__private::Scalar::sin_cos(
            state.q[0] - state.q[1],
        );
        let e1 = <T as ::nonholonomic::__private::Scalar>::from_f64(0.3333333333333333)
            * cos;
        let exp_q_0 = ::nonholonomic::__private::Scalar::exp(state.q[0]);
        let force_1 = sin * ::nonholonomic::__private::Scalar::recip(self.r#type);
        let [a_w0, a_w2] = ::nonholonomic::__private::solve_pivoted::<
            T,
            2,
        >([[self.I[0][0], self.I[0][1]], [self.I[1][0], self.I[1][1]]], [force_1, e1]);
        ChainState {
            q: [state.w_0, state.w_2],
            R: [
                [sin, e1],
                [
                    exp_q_0,
                    (<T as ::nonholonomic::__private::Scalar>::ONE
                        - <T as ::nonholonomic::__private::Scalar>::from_f64(
                            ::core::f64::consts::PI,
                        )
                        - ::nonholonomic::__private::Scalar::powf(
                            exp_q_0,
                            <T as ::nonholonomic::__private::Scalar>::from_f64(
                                0.2857142857142857,
                            ),
                        )),
                ],
            ],
            w_0: a_w0,
            w_2: a_w2 + force_1,
        }
    }
    /// The energy y · ∂L/∂y − L.
    #[must_use]
    #[inline]
    pub fn energy(&self, t: T, state: &ChainState<T>) -> T {
        _ = t;
        <T as ::nonholonomic::__private::Scalar>::from_f64(0.5) * self.r#type
            * (state.w_0 * state.w_0)
    }
    /// All quasi-velocities, as the constraints give them from the state.
    #[must_use]
    #[inline]
    pub fn velocity(&self, t: T, state: &ChainState<T>) -> ChainVelocity<T> {
        _ = self;
        _ = t;
        let e1 = <T as ::nonholonomic::__private::Scalar>::ZERO;
        ChainVelocity {
            w: [state.w_0, e1, state.w_2],
            u: e1,
        }
    }
    /// Checks the parameters.
    ///
    /// # Errors
    /// The first parameter that is not finite, that breaks an assumption, or that makes an
    /// expression zero by which the equations divide.
    pub fn validate(
        &self,
    ) -> ::core::result::Result<(), ::nonholonomic::__private::ParameterError> {
        for (name, value) in [
            ("I[0][0]", self.I[0][0]),
            ("I[0][1]", self.I[0][1]),
            ("I[1][0]", self.I[1][0]),
            ("I[1][1]", self.I[1][1]),
            ("type", self.r#type),
        ] {
            if !::nonholonomic::__private::Scalar::is_finite(value) {
                return ::core::result::Result::Err(::nonholonomic::__private::ParameterError {
                    parameter: name,
                    value: ::nonholonomic::__private::Scalar::to_f64(value),
                    fault: ::nonholonomic::__private::ParameterFault::NotFinite,
                });
            }
        }
        ::core::result::Result::Ok(())
    }
}
#[allow(unexpected_cfgs)]
const _: () = {
    #[cfg(rust_analyzer)]
    #[allow(warnings)]
    fn names<T>(system: &Chain<T>, state: &ChainState<T>, velocity: &ChainVelocity<T>)
    where
        T: ::nonholonomic::__private::Scalar,
    {
        {
            _ = state.q;
            _ = state.R;
        }
        {
            _ = velocity.w;
            _ = velocity.u;
        }
        {
            _ = velocity.u;
            _ = velocity.w;
        }
    }
};
#[doc(hidden)]
#[allow(non_local_definitions)]
#[macro_export]
macro_rules! __nh_declaration_Chain_e07084d326a6c8cd {
    () => {};
    ($callback:path, { $($rest:tt)* }) => {
        $callback ! { declaration { { base { q[2], R[2] [2] } basis { w[3], u }
        lagrangian { 0 } constraints { u = 0; w[1] = 0; } } { pub struct Chain < T = f64
        > { #[doc = " Inertias. "] pub I : [[T; 2]; 2], #[doc = " Mass. "] pub r#type : T
        } } } $($rest)* }
    };
}
#[doc(hidden)]
pub use __nh_declaration_Chain_e07084d326a6c8cd as __nh_declaration_Chain;
__nh_declaration_Chain! {}

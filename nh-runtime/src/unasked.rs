//! Methods and texts that a system does not have because its declaration does not ask for them: a use of one names the
//! word that would.
//!
//! What is the system's own comes before these, so that they are found only where there is none; and nothing has the
//! trait that each of them needs, so that none of them can be used.

use crate::{Dynamics, ScalarOf};

macro_rules! unasked {
    ($($Asks:ident, $word:literal: $($method:ident $arguments:tt),*;)*) => {
        $(
            /// A declaration asks for it by this word.
            #[diagnostic::on_unimplemented(
                message = $word,
                label = "add it to the declaration",
                note = "what goes beyond the derivative, the energy and the velocity is generated where `emit` names it or a section needs it"
            )]
            pub trait $Asks {
                /// What the methods return.
                type Found;
                /// One of them.
                fn found(&self) -> Self::Found;
            }
        )*
        /// The methods by the words that ask for them.
        pub trait Unasked: Dynamics {
            $($(unasked!(@method $method $arguments $Asks);)*)*
        }
        impl<S: Dynamics> Unasked for S {}
    };
    (@method $method:ident () $Asks:ident) => {
        #[doc(hidden)]
        fn $method(&self) -> <Self as $Asks>::Found
        where
            Self: $Asks,
        {
            self.found()
        }
    };
    (@method $method:ident (mut state) $Asks:ident) => {
        #[doc(hidden)]
        fn $method(&self, _state: &mut Self::State) -> <Self as $Asks>::Found
        where
            Self: $Asks,
        {
            self.found()
        }
    };
    (@method $method:ident (t, state) $Asks:ident) => {
        #[doc(hidden)]
        fn $method(&self, _t: ScalarOf<Self>, _state: &Self::State) -> <Self as $Asks>::Found
        where
            Self: $Asks,
        {
            self.found()
        }
    };
    (@method $method:ident (t, state, input) $Asks:ident) => {
        #[doc(hidden)]
        fn $method(&self, _t: ScalarOf<Self>, _state: &Self::State, _input: &Self::Input) -> <Self as $Asks>::Found
        where
            Self: $Asks,
        {
            self.found()
        }
    };
    (@method $method:ident (t, state, held) $Asks:ident) => {
        #[doc(hidden)]
        fn $method<A: ?Sized>(&self, _t: ScalarOf<Self>, _state: &Self::State, _held: &A) -> <Self as $Asks>::Found
        where
            Self: $Asks,
        {
            self.found()
        }
    };
    (@method $method:ident (t, state, input, along) $Asks:ident) => {
        #[doc(hidden)]
        fn $method<A: ?Sized>(
            &self,
            _t: ScalarOf<Self>,
            _state: &Self::State,
            _input: &Self::Input,
            _along: &A,
        ) -> <Self as $Asks>::Found
        where
            Self: $Asks,
        {
            self.found()
        }
    };
    (@method $method:ident (t, state, input, along, input_along) $Asks:ident) => {
        #[doc(hidden)]
        fn $method<A: ?Sized, B: ?Sized>(
            &self,
            _t: ScalarOf<Self>,
            _state: &Self::State,
            _input: &Self::Input,
            _along: &A,
            _input_along: &B,
        ) -> <Self as $Asks>::Found
        where
            Self: $Asks,
        {
            self.found()
        }
    };
}

unasked! {
    AsksJacobian,
        "`{Self}` is declared without `emit {{ jacobian }}`, which generates this method":
        jacobian(t, state, input);
    AsksMultipliers,
        "`{Self}` is declared without `emit {{ multipliers }}`, which generates this method":
        multipliers(t, state, input);
    AsksReactions,
        "`{Self}` is declared without `emit {{ reactions }}`, which generates this method":
        reactions(t, state, input);
    AsksMomenta,
        "`{Self}` is declared without `emit {{ momenta }}` beside `symmetries {{ … }}`, which generates this method":
        momenta(t, state), momentum_rates(t, state, input);
    AsksPower,
        "`{Self}` is declared without `emit {{ power }}`, which generates this method":
        power(t, state, input);
    AsksOutputJacobian,
        "`{Self}` is declared without `emit {{ output_jacobian }}` beside `outputs {{ … }}`, which generates this method":
        output_jacobian(t, state, input);
    AsksParameterJacobian,
        "`{Self}` is declared without `emit {{ parameter_jacobian }}`, which generates this method":
        parameter_jacobian(t, state, input);
    AsksBracket,
        "`{Self}` is declared without `emit {{ bracket }}` beside `outputs {{ … }}`, which generates this method":
        bracket(t, state, input), bracket_with_energy(t, state, input), drift_of_outputs(t, state, input);
    AsksDivergence,
        "`{Self}` is declared without `emit {{ divergence }}`, which generates this method":
        divergence(t, state, input);
    AsksVolume,
        "`{Self}` is declared without `emit {{ volume }}`, which generates this method":
        volume_density(t, state);
    AsksConnection,
        "`{Self}` is declared without `emit {{ connection }}`, which generates this method":
        connection(t, state), christoffel(t, state);
    AsksGibbsAppell,
        "`{Self}` is declared without `emit {{ gibbs_appell }}`, which generates this method":
        gibbs_appell(t, state, input);
    AsksGyroscopic,
        "`{Self}` is declared without `emit {{ gyroscopic }}`, which generates this method":
        gyroscopic(t, state);
    AsksSplitting,
        "`{Self}` is declared without `emit {{ splitting }}`, or this method would give nothing":
        vertical_sections(t, state), horizontal_lifts(t, state), locked_inertia(t, state),
        connection_coefficients(t, state), curvature(t, state), vertical_momenta(t, state),
        vertical_momentum_rates(t, state, input), vertical_velocities(t, state), horizontal_force(t, state);
    AsksJacobianProduct,
        "`{Self}` is declared without `emit {{ jacobian_product }}`, which generates this method":
        jacobian_product(t, state, input, along, input_along);
    AsksAdjointProduct,
        "`{Self}` is declared without `emit {{ adjoint_product }}`, which generates this method":
        adjoint_product(t, state, input, along);
    AsksHamiltonian,
        "`{Self}` is declared without `emit {{ hamiltonian }}`, which generates this method":
        legendre(t, state);
    AsksSparseJacobian,
        "`{Self}` is declared without `emit {{ sparse_jacobian }}`, which generates this method":
        sparse_jacobian(t, state, input), sparse_linearized(t, state, input);
    AsksPrepared,
        "`{Self}` is declared without `emit {{ prepared }}`, which generates this method":
        prepare();
    AsksAngleCache,
        "`{Self}` is declared without `emit {{ angle_cache }}`, which generates this method":
        with_angle_cache();
    AsksLinearization,
        "`{Self}` is declared without `linearization {{ keep: …; }}`, which generates this method":
        linearize(t, state, input), trim(t, state, input, along);
    AsksAssembly,
        "`{Self}` is declared without `holonomic {{ … }}`, which generates this method":
        assemble(t, state), assemble_holding(t, state, held);
    AsksNormalization,
        "`{Self}` is declared without `on {{ … }}`, which generates this method":
        normalize(mut state);
}

macro_rules! unasked_texts {
    ($($Asks:ident, $Text:ident, $word:literal: $text:ident;)*) => {
        $(
            /// A declaration asks for it by this word.
            #[diagnostic::on_unimplemented(
                message = $word,
                label = "add it to the declaration",
                note = "texts beyond `REPORT` are generated where `emit` names them"
            )]
            pub trait $Asks {}
            /// A text by the word that asks for it.
            pub trait $Text {
                #[doc(hidden)]
                const $text: &'static str;
            }
            impl<S: $Asks> $Text for S {
                const $text: &'static str = "";
            }
        )*
    };
}

unasked_texts! {
    AsksC, TextInC,
        "`{Self}` is declared without `emit {{ c }}`, which generates this text":
        C99;
    AsksExplanation, TextOfDerivation,
        "`{Self}` is declared without `emit {{ explain }}`, which generates this text":
        DERIVATION;
    AsksLatex, TextInTex,
        "`{Self}` is declared without `emit {{ latex }}`, which generates this text":
        LATEX;
}

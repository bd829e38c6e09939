//! Everything that a model and its simulation name: `use nonholonomic::prelude::*;`.

pub use crate::methods::{
    Auto, Bs23, Conserving, DiscreteGradient, DiscreteSuslov, Dop853, Dopri5, Euler, GaussLegendre4,
    GaussLegendre6, Heun, ImplicitMidpoint, Projected, Radau5, Ralston, Rattle, ReflectedLeapfrog, Rk4,
    Rodas5P, Tsit5, Vern9,
};
pub use crate::{
    AlmostPoisson, AssemblyError, Constrained, Direction, Dynamics, Energy, Event, Events, Fast, Holding,
    Inclusion, IntegrationError, Integrator, Jacobian, Lanes, LinearizationError, Observed, ParameterError,
    Real, Reconstructed, Reconstruction, Reduction, Scalar, State, Statistics, TrimError,
};

// no names: only what they hold, for uses of what was not asked for
#[doc(hidden)]
pub use crate::unasked::{TextInC as _, TextInTex as _, TextOfDerivation as _, Unasked as _};
pub use crate::{Taylor, TaylorSeries};

#[cfg(feature = "macros")]
pub use nonholonomic_macros::{morphism, nonholonomic, quotient};

//! One form of a system, with the methods that it has what they need for.

use nonholonomic::prelude::*;
use nonholonomic::{Method, ScalarOf};

use crate::study::{Case, Ended, Study};

/// A system with its start, to which methods are added.
pub struct Variant<'a, S: Dynamics> {
    study: &'a mut Study,
    name: String,
    system: S,
    start: S::State,
    input: S::Input,
}

impl<S> Variant<'_, S>
where
    S: Dynamics + Clone + 'static,
    S::Input: 'static,
    ScalarOf<S>: Real,
{
    pub(crate) fn new<'a>(study: &'a mut Study, name: &str, system: S, start: S::State) -> Variant<'a, S> {
        Variant { study, name: name.to_owned(), system, start, input: S::Input::default() }
    }

    /// The input during the whole run.
    #[must_use]
    pub fn input(mut self, input: S::Input) -> Self {
        self.input = input;
        self
    }

    /// Adds a method with each of some settings; what it is called with them is the setting's name.
    #[allow(clippy::return_self_not_must_use)] // what is added is in the study
    pub fn method<M: Method<S> + Clone + 'static>(
        self,
        method: &'static str,
        settings: impl IntoIterator<Item = (f64, M)>,
    ) -> Self {
        let (from, to) = self.study.span();
        let number = ScalarOf::<S>::from_f64;
        for (setting, with) in settings {
            let (system, start, input) = (self.system.clone(), self.start, self.input);
            let run = move || -> Option<Ended> {
                let mut sim = Integrator::new(system.clone(), with.clone(), number(from), start);
                sim.set_input(input);
                sim.advance_to(number(to)).ok()?;
                let end = sim.state().to_array().as_ref().iter().map(|x| x.to_f64()).collect();
                Some(Ended { end, statistics: sim.statistics() })
            };
            let names = S::State::names().as_ref().to_vec();
            let variant = self.name.clone();
            self.study.add(Case { variant, method, setting, names, run: Box::new(run) });
        }
        self
    }

    /// The tolerances that the numbers resolve.
    fn tolerances() -> impl Iterator<Item = f64> {
        let finest = 8.0 * ScalarOf::<S>::EPSILON.to_f64();
        (4..=30).map(|half| 10.0_f64.powf(-f64::from(half) / 2.0)).filter(move |rtol| *rtol >= finest)
    }

    /// The lengths of steps that divide the span evenly.
    fn steps(&self) -> impl Iterator<Item = f64> + use<S> {
        let (from, to) = self.study.span();
        (3..=14).map(move |power| (to - from).abs() / (10.0 * f64::from(1_u32 << power) / 8.0))
    }

    /// The explicit methods: `Rk4` with fixed steps, `Bs23`, `Dopri5`, `Tsit5`, `Dop853`, `Vern9`.
    #[allow(clippy::return_self_not_must_use)] // what is added is in the study
    pub fn explicit(self) -> Self {
        let t = ScalarOf::<S>::from_f64;
        macro_rules! adaptive {
            ($this:ident: $($method:ident)*) => {
                $(let $this = $this.method(
                    stringify!($method),
                    Self::tolerances().map(|rtol| (rtol, $method::new().rtol(t(rtol)))),
                );)*
            };
        }
        let steps: Vec<f64> = self.steps().collect();
        let this = self.method("Rk4", steps.into_iter().map(|h| (h, Rk4::new(t(h)))));
        adaptive!(this: Bs23 Dopri5 Tsit5 Dop853 Vern9);
        this
    }

    /// The implicit methods with Jacobians by differences: `GaussLegendre6`, `Radau5`, `Rodas5P`.
    #[allow(clippy::return_self_not_must_use)] // what is added is in the study
    pub fn implicit(self) -> Self {
        let t = ScalarOf::<S>::from_f64;
        let steps: Vec<f64> = self.steps().collect();
        self.method("GaussLegendre6", steps.into_iter().map(|h| (h, GaussLegendre6::new(t(h)))))
            .method("Radau5", Self::tolerances().map(|rtol| (rtol, Radau5::new().rtol(t(rtol)))))
            .method("Rodas5P", Self::tolerances().map(|rtol| (rtol, Rodas5P::new().rtol(t(rtol)))))
    }
}

impl<S> Variant<'_, S>
where
    S: TaylorSeries + Clone + 'static,
    ScalarOf<S>: Real,
{
    /// The Taylor method: where the declaration says `emit { taylor }`.
    #[allow(clippy::return_self_not_must_use)] // what is added is in the study
    pub fn taylor(self) -> Self {
        let t = ScalarOf::<S>::from_f64;
        self.method("Taylor", Self::tolerances().map(|rtol| (rtol, Taylor::new().rtol(t(rtol)))))
    }
}

//! On which side of zero event functions start.

use super::{Events, Side, Station, side};
use crate::arrays::displaced;
use crate::methods::{Method, Start};
use crate::stop::Stop;
use crate::{Direction, Dynamics, Integrator, Real, Scalar, ScalarOf, State};

/// A zero within so many rounding units of the time is at that time.
const RESOLUTION: f64 = 64.0;

/// The sides of the functions at the start of a step.
#[derive(Clone, Copy)]
pub(super) struct Sides<T, const N: usize> {
    pub(super) of: [Side; N],
    /// Those that have just left zero.
    pub(super) leaving: [bool; N],
    /// Whether the state there was given, rather than reached.
    pub(super) is_given: bool,
    /// The stop there.
    pub(super) stop: Option<Stop<T>>,
}

/// Whether a function with this value and rate is zero at that time, as far as time resolves it.
pub(super) fn near<T: Real>(time: T, value: T, rate: T) -> bool {
    value.abs() <= T::from_f64(RESOLUTION) * T::EPSILON * time.abs() * rate.abs()
}

impl<F, const N: usize> Events<F, N> {
    /// The rates of change of the functions along the motion in the direction of a step of this length, where
    /// they can be told: by central differences along the tangent, which have to exceed what the functions'
    /// curvature contributes.
    pub(super) fn rates<S: Dynamics>(
        &self,
        start: &Start<'_, S>,
        length: ScalarOf<S>,
        values: &[ScalarOf<S>; N],
    ) -> [Option<ScalarOf<S>>; N]
    where
        ScalarOf<S>: Real,
        F: Fn(ScalarOf<S>, &S::State, &S::Input) -> [ScalarOf<S>; N],
    {
        let c = ScalarOf::<S>::from_f64;
        let mut rates = [None; N];
        let (x, slope) = (start.state.to_array(), start.derivative());
        let at = |delta: ScalarOf<S>| {
            let state = S::State::from_array(displaced(&x, delta, &slope));
            (self.functions)(start.time + delta, &state, start.input)
        };
        let mut share = c(1.0 / 1024.0);
        while share * share >= ScalarOf::<S>::EPSILON && rates.iter().any(Option::is_none) {
            let delta = share * length;
            let (ahead, behind) = (at(delta), at(-delta));
            let pairs = ahead.iter().zip(&behind).zip(values);
            for (rate, ((ahead, behind), value)) in rates.iter_mut().zip(pairs) {
                let odd = *ahead - *behind;
                let even = (*ahead - *value) + (*behind - *value);
                if rate.is_none() && odd.abs() > even.abs() + even.abs() {
                    *rate = Some(odd / (delta + delta).abs());
                }
            }
            share *= c(1.0 / 64.0);
        }
        rates
    }
}

impl<S: Dynamics, M: Method<S>> Integrator<S, M>
where
    ScalarOf<S>: Real,
{
    /// The sides at the start of the last step, the first of a run. The state there was given, or reached.
    pub(super) fn beginning<F, const N: usize>(
        &self,
        events: &Events<F, N>,
        here: &Station<ScalarOf<S>, N>,
        stop: Option<Stop<ScalarOf<S>>>,
        is_given: bool,
    ) -> Sides<ScalarOf<S>, N>
    where
        F: Fn(ScalarOf<S>, &S::State, &S::Input) -> [ScalarOf<S>; N],
    {
        let mut of = here.values.map(side);
        let mut leaving = [false; N];
        let Some((start, arrival)) = self.last_step() else {
            return Sides { of, leaving, is_given, stop };
        };
        let rates = events.rates(&start, arrival.time - start.time, &here.values);
        let each = of.iter_mut().zip(&mut leaving).zip(here.values.iter().zip(rates));
        for (index, ((side_of, leaving), (value, rate))) in each.enumerate() {
            let is_near = rate.is_some_and(|rate| near(start.time, *value, rate));
            // what has changed its sign here may show the old one by round-off
            let has_crossed = match stop.and_then(|stop| stop.crossed(index)) {
                Some(Direction::Rising) => *side_of == Side::Below,
                Some(_) => *side_of == Side::Above,
                None => false,
            };
            *leaving = *side_of == Side::On || (is_near && (is_given || has_crossed));
            if *leaving {
                *side_of = rate.map_or(Side::On, side);
            }
        }
        Sides { of, leaving, is_given, stop }
    }
}

//! What event functions do near a state: how fast they change along the motion, and what rounding makes of them.

use super::Events;
use crate::arrays::displaced;
use crate::methods::Start;
use crate::{Dynamics, Real, Scalar, ScalarOf, State};

/// A zero within so many rounding units of the time is at that time.
const RESOLUTION: f64 = 64.0;
/// What is within so many roundings of zero may be zero.
const ROUNDINGS: f64 = 8.0;
/// Changes of sign within so many rounding units of time, and of the functions, happen at the same time.
const SAME_TIME: f64 = 4.0;

/// What is displaced by fewer rounding units shows nothing but these.
const LEAST_DISPLACEMENT: f64 = 64.0;

/// An event function near a state.
#[derive(Clone, Copy)]
pub(super) struct Local<T> {
    /// Its rate of change along the motion in the direction of a step, where it can be told.
    pub(super) rate: Option<T>,
    /// What a rounding of every component of the state, and of the time, makes of it together.
    rounding: T,
    /// The same for the ways of the components in the whole step: at a share of it, that share of this is added.
    spread: T,
}

impl<T: Real> Local<T> {
    /// What is not looked at.
    pub(super) const UNKNOWN: Self = Self { rate: None, rounding: T::ZERO, spread: T::ZERO };

    /// Whether a function with this value is zero, as far as time, with this rounding unit, and function resolve it.
    pub(super) fn is_zero(&self, unit: T, value: T) -> bool {
        let passed = self.rate.map_or(T::ZERO, |rate| unit * rate.abs());
        value.abs() <= T::from_f64(RESOLUTION) * passed + T::from_f64(ROUNDINGS) * self.rounding
    }

    /// Whether a function with this value may be zero, for all that one can tell somewhere within the step.
    pub(super) fn may_be_zero(&self, unit: T, value: T) -> bool {
        value.abs() <= T::from_f64(ROUNDINGS) * self.rounding(T::ONE) || self.is_zero(unit, value)
    }

    /// Whether rounding hides, after a share of the step, how a function has changed that was hardly zero at its start.
    pub(super) fn hides(&self, share: T, at_start: Option<T>, value: T) -> bool {
        value.abs() <= at_start.unwrap_or(T::ZERO).abs() + T::from_f64(ROUNDINGS) * self.rounding(share)
    }

    /// What rounding makes of the function after a share of the step.
    pub(super) fn rounding(&self, share: T) -> T {
        self.spread.mul_add(share, self.rounding)
    }

    /// Changes of sign that are less apart happen at the same time, for all that one can tell of this one; `unit` is a
    /// rounding unit of time.
    pub(super) fn blur(&self, unit: T) -> T {
        let own = match self.rate {
            Some(rate) if rate != T::ZERO => self.rounding(T::ONE) / rate.abs(),
            _ => T::ZERO,
        };
        T::from_f64(SAME_TIME) * if own.is_finite() { unit + own } else { unit }
    }
}

/// What is gathered of one function, component by component.
#[derive(Clone, Copy)]
struct Gathered<T> {
    rate: T,
    /// What the function's curvature may have contributed to the rate.
    bent: T,
    /// The sum of rates of components over the distances that they were displaced by: what multiplies a rounding.
    leverage: T,
    rounding: T,
    spread: T,
    is_told: bool,
}

/// A component of the state, or the time.
#[derive(Clone, Copy)]
struct Component<T> {
    size: T,
    /// How far the step takes it.
    way: T,
    rate: T,
}

impl<T: Real> Gathered<T> {
    const NOTHING: Self = Self {
        rate: T::ZERO,
        bent: T::ZERO,
        leverage: T::ZERO,
        rounding: T::ZERO,
        spread: T::ZERO,
        is_told: true,
    };

    /// Adds the part of a component, from the values at this distance from it on both sides.
    fn add(&mut self, value: T, sides: [T; 2], distance: T, component: Component<T>) {
        let Component { size, way, rate } = component;
        let half = T::from_f64(0.5);
        let [ahead, behind] = sides.map(|there| there - value);
        // next to where a function is not defined, one side tells
        let (ahead, behind) = match (ahead.is_finite(), behind.is_finite()) {
            (true, true) => (ahead, behind),
            (true, false) => (ahead, -ahead),
            (false, true) => (-behind, behind),
            (false, false) => {
                self.is_told = false;
                return;
            }
        };
        let steeper = if ahead.abs() > behind.abs() { ahead.abs() } else { behind.abs() };
        self.rounding += steeper / distance * (T::EPSILON * size);
        self.spread += steeper / distance * (T::EPSILON * way);
        let (odd, even) = ((ahead - behind) * half, (ahead + behind) * half);
        self.rate += odd / distance * rate;
        self.bent += even.abs() / distance * rate.abs();
        if steeper > T::ZERO {
            self.leverage += rate.abs() / distance;
        }
    }

    /// The rate, if it exceeds what curvature and rounding contribute.
    fn local(&self) -> Local<T> {
        let [rounding, spread] =
            [self.rounding, self.spread].map(|one| if one.is_finite() { one } else { T::ZERO });
        let unclear = (self.bent + self.bent) + (rounding + rounding) * self.leverage;
        let is_told = self.is_told && self.rate.is_finite() && self.rate.abs() > unclear;
        Local { rate: is_told.then_some(self.rate), rounding, spread }
    }
}

/// How far a component of this size is displaced that goes this way in a step: as far again beyond its rounding unit as that
/// stays behind the way, on which functions are as bent as samples show. The root of the rounding unit of what begins at zero.
fn displacement<T: Real>(size: T, way: T) -> T {
    let share = (T::EPSILON * (way / size)).sqrt();
    let resolved = T::from_f64(LEAST_DISPLACEMENT) * T::EPSILON;
    size * share.select_gt(resolved, share, resolved)
}

impl<F, const N: usize> Events<F, N> {
    /// The functions near a state in a step of this length that leads to the state `beyond`, by central differences: with
    /// every component of the state and the time displaced by the root of its rounding unit times its way in the step; and
    /// along the tangent where that leaves the rate open.
    pub(super) fn local<S: Dynamics>(
        &self,
        start: &Start<'_, S>,
        (length, beyond): (ScalarOf<S>, &S::State),
        values: &[ScalarOf<S>; N],
    ) -> [Local<ScalarOf<S>>; N]
    where
        ScalarOf<S>: Real,
        F: Fn(ScalarOf<S>, &S::State, &S::Input) -> [ScalarOf<S>; N],
    {
        let (zero, one) = (ScalarOf::<S>::ZERO, ScalarOf::<S>::ONE);
        let (x, slope) = (start.state.to_array(), start.derivative());
        let ahead = if length < zero { -one } else { one };
        let larger = |a: ScalarOf<S>, b: ScalarOf<S>| if a.abs() > b.abs() { a.abs() } else { b.abs() };
        let mut gathered = [Gathered::NOTHING; N];
        let mut add = |sides: [[ScalarOf<S>; N]; 2], distance, component: Component<ScalarOf<S>>| {
            let [ahead_of, behind] = sides;
            for (((one, value), a), b) in gathered.iter_mut().zip(values).zip(ahead_of).zip(behind) {
                one.add(*value, [a, b], distance, component);
            }
        };
        let beyond = beyond.to_array();
        let components = x.as_ref().iter().zip(beyond.as_ref()).zip(slope.as_ref());
        for (index, ((here, beyond), rate)) in components.enumerate() {
            let component = Component { size: here.abs(), way: (*beyond - *here).abs(), rate: *rate * ahead };
            let ahead_by = *rate * length;
            let distance =
                displacement(larger(*here, larger(*beyond, ahead_by)), larger(component.way, ahead_by));
            if distance > zero && distance.is_finite() {
                let at = |by: ScalarOf<S>| {
                    let mut there = x;
                    there.as_mut().iter_mut().skip(index).take(1).for_each(|x| *x += by);
                    (self.functions)(start.time, &S::State::from_array(there), start.input)
                };
                add([at(distance), at(-distance)], distance, component);
            }
        }
        let clock = Component { size: start.time.abs(), way: zero, rate: ahead };
        let distance = displacement(larger(start.time, length), length.abs());
        let at = |time: ScalarOf<S>| (self.functions)(time, start.state, start.input);
        add([at(start.time + distance), at(start.time - distance)], distance, clock);
        let mut local = gathered.map(|one| one.local());
        self.along_the_tangent(start, (&slope, length), values, &mut local);
        local
    }

    /// Rates that are not told yet, by central differences along the tangent, which have to exceed what the functions'
    /// curvature and rounding contribute.
    fn along_the_tangent<S: Dynamics>(
        &self,
        start: &Start<'_, S>,
        (slope, length): (&crate::VecOf<S>, ScalarOf<S>),
        values: &[ScalarOf<S>; N],
        local: &mut [Local<ScalarOf<S>>; N],
    ) where
        ScalarOf<S>: Real,
        F: Fn(ScalarOf<S>, &S::State, &S::Input) -> [ScalarOf<S>; N],
    {
        let c = ScalarOf::<S>::from_f64;
        let x = start.state.to_array();
        let at = |delta: ScalarOf<S>| {
            let state = S::State::from_array(displaced(&x, delta, slope));
            (self.functions)(start.time + delta, &state, start.input)
        };
        let mut share = c(1.0 / 1024.0);
        while share * share >= ScalarOf::<S>::EPSILON && local.iter().any(|one| one.rate.is_none()) {
            let delta = share * length;
            let (ahead, behind) = (at(delta), at(-delta));
            let pairs = ahead.iter().zip(&behind).zip(values);
            for (one, ((ahead, behind), value)) in local.iter_mut().zip(pairs) {
                let odd = *ahead - *behind;
                let even = (*ahead - *value) + (*behind - *value);
                let unclear = even.abs() + even.abs() + c(SAME_TIME) * one.rounding;
                if one.rate.is_none() && odd.is_finite() && odd.abs() > unclear {
                    one.rate = Some(odd / (delta + delta).abs());
                }
            }
            share *= c(1.0 / 64.0);
        }
    }
}

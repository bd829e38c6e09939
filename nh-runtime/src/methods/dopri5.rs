//! The method of Dormand and Prince of order 5.

use super::adaptive::{self, Attempt, Embedded, Memory};
use super::{Arrival, Method, Start};
use crate::arrays::{all_finite, combined, displaced, first_non_finite};
use crate::step_control::StepControl;
use crate::{Dynamics, IntegrationError, Real, State, Statistics, VecOf};

/// The adaptive method of Dormand and Prince, of order 5 with an error estimate of order 4 and a
/// continuous extension of order 4.
///
/// The seventh evaluation of an accepted step is the first of the next one. Sources: Dormand,
/// Prince, A family of embedded Runge–Kutta formulae, J. Comp. Appl. Math. 6 (1980), table 2;
/// Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, table II.5.2 and, for the
/// continuous extension, section II.6.
///
/// ```
/// use nh_runtime::Dopri5;
///
/// let method: Dopri5<f64> = Dopri5::new().rtol(1e-9).atol(1e-12).max_step(0.1);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dopri5<T> {
    control: StepControl<T>,
}

impl<T: Real> Dopri5<T> {
    /// The method with the default tolerances: 10⁻⁶ in `f64`, 10⁻⁴ in `f32`.
    #[must_use]
    pub fn new() -> Self {
        Self { control: StepControl::new() }
    }

    /// The relative tolerance: the error that a step may add to a component, as a fraction of it.
    #[must_use]
    pub fn rtol(mut self, rtol: T) -> Self {
        self.control.rtol = rtol;
        self
    }

    /// The absolute tolerance, in the units of the state; as `rtol` if not given. A component's
    /// permitted error is the absolute plus the relative one.
    #[must_use]
    pub fn atol(mut self, atol: T) -> Self {
        self.control.atol = Some(atol);
        self
    }

    /// The length of the first step that is tried; chosen from the equations if not given.
    #[must_use]
    pub fn first_step(mut self, first_step: T) -> Self {
        self.control.first_step = Some(first_step);
        self
    }

    /// The length of the longest step; unlimited if not given. Give it where inputs or forces act
    /// in short pulses that a long step could miss.
    #[must_use]
    pub fn max_step(mut self, max_step: T) -> Self {
        self.control.max_step = Some(max_step);
        self
    }
}

impl<T: Real> Default for Dopri5<T> {
    fn default() -> Self {
        Self::new()
    }
}

/// The nodes c₂ … c₅; the last two are 1.
const C: [f64; 4] = [1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0];
/// The rows of the stages.
const A3: [f64; 2] = [3.0 / 40.0, 9.0 / 40.0];
const A4: [f64; 3] = [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0];
const A5: [f64; 4] = [19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0];
const A6: [f64; 5] = [9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0];
/// The weights of k₁, k₃, k₄, k₅, k₆, which are also the row of the last stage.
const B: [f64; 5] = [35.0 / 384.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0];
/// The error weights of k₁, k₃, k₄, k₅, k₆, k₇.
const E: [f64; 6] =
    [71.0 / 57600.0, -71.0 / 16695.0, 71.0 / 1920.0, -17253.0 / 339_200.0, 22.0 / 525.0, -1.0 / 40.0];
/// The weights of k₁, k₃, k₄, k₅, k₆, k₇ in the fourth-order term of the continuous extension.
const DENSE: [f64; 6] = [
    -12_715_105_075.0 / 11_282_082_432.0,
    87_487_479_700.0 / 32_700_410_799.0,
    -10_690_763_975.0 / 1_880_347_072.0,
    701_980_252_875.0 / 199_316_789_632.0,
    -1_453_857_185.0 / 822_651_844.0,
    69_997_945.0 / 29_380_423.0,
];

/// The derivatives k₂ … k₇ at the stages.
pub(super) struct Stages<V> {
    k2: V,
    k3: V,
    k4: V,
    k5: V,
    k6: V,
    k7: V,
}

impl<T: Real, S: Dynamics> Embedded<S> for Dopri5<T>
where
    S::State: State<Scalar = T>,
{
    const ORDER: u32 = 5;
    type Stages = Stages<VecOf<S>>;
    type Bulge = VecOf<S>;

    #[inline]
    fn attempt(
        &self,
        start: &Start<'_, S>,
        k1: &VecOf<S>,
        h: T,
        control: &StepControl<T>,
        statistics: &mut Statistics,
    ) -> Attempt<S, Self::Stages> {
        let w = T::from_f64;
        let t = start.time;
        let x = start.state.to_array();
        let [c2, c3, c4, c5] = C.map(w);
        let k2 = start.derivative_at(t + c2 * h, displaced(&x, c2 * h, k1));

        let [a1, a2] = A3.map(w);
        let slope = combined((a1, k1), [(a2, &k2)]);
        let k3 = start.derivative_at(t + c3 * h, displaced(&x, h, &slope));

        let [a1, a2, a3] = A4.map(w);
        let slope = combined((a1, k1), [(a2, &k2), (a3, &k3)]);
        let k4 = start.derivative_at(t + c4 * h, displaced(&x, h, &slope));

        let [a1, a2, a3, a4] = A5.map(w);
        let slope = combined((a1, k1), [(a2, &k2), (a3, &k3), (a4, &k4)]);
        let k5 = start.derivative_at(t + c5 * h, displaced(&x, h, &slope));

        let [a1, a2, a3, a4, a5] = A6.map(w);
        let slope = combined((a1, k1), [(a2, &k2), (a3, &k3), (a4, &k4), (a5, &k5)]);
        let k6 = start.derivative_at(t + h, displaced(&x, h, &slope));

        let [b1, b3, b4, b5, b6] = B.map(w);
        let slope = combined((b1, k1), [(b3, &k3), (b4, &k4), (b5, &k5), (b6, &k6)]);
        let state = displaced(&x, h, &slope);
        let k7 = start.derivative_at(t + h, state);

        let [e1, e3, e4, e5, e6, e7] = E.map(w);
        let defect = combined(
            (h * e1, k1),
            [(h * e3, &k3), (h * e4, &k4), (h * e5, &k5), (h * e6, &k6), (h * e7, &k7)],
        );
        statistics.evaluations += 6;
        let error = control.norm(&defect, &x, &state);
        // every k but the second has a weight of its own in the error
        let error = if all_finite::<T, _>(&k2) { error } else { w(f64::NAN) };
        Attempt { state, error, stages: Stages { k2, k3, k4, k5, k6, k7 } }
    }

    #[inline]
    fn conclude(
        &self,
        _start: &Start<'_, S>,
        k1: &VecOf<S>,
        h: T,
        attempt: &Attempt<S, Self::Stages>,
    ) -> (VecOf<S>, VecOf<S>) {
        let Stages { k3, k4, k5, k6, k7, .. } = &attempt.stages;
        let [d1, d3, d4, d5, d6, d7] = DENSE.map(|d| h * T::from_f64(d));
        let bulge = combined((d1, k1), [(d3, k3), (d4, k4), (d5, k5), (d6, k6), (d7, k7)]);
        (*k7, bulge)
    }

    #[cold]
    fn blame(&self, stages: &Self::Stages) -> Option<((usize, f64), f64)> {
        let Stages { k2, k3, k4, k5, k6, k7 } = stages;
        let [c2, c3, c4, c5] = C;
        [(k2, c2), (k3, c3), (k4, c4), (k5, c5), (k6, 1.0), (k7, 1.0)]
            .into_iter()
            .find_map(|(k, c)| first_non_finite::<T>(k.as_ref()).map(|found| (found, c)))
    }
}

impl<T: Real, S: Dynamics> Method<S> for Dopri5<T>
where
    S::State: State<Scalar = T>,
{
    type Memory = Memory<S, VecOf<S>>;
    type Dense = Self::Memory;

    fn memory(&self) -> Self::Memory {
        Memory::new()
    }

    #[inline]
    fn forget(&self, memory: &mut Self::Memory) {
        memory.forget();
    }

    fn check(&self) -> Result<(), IntegrationError> {
        self.control.check()
    }

    #[inline]
    fn advance(
        &self,
        start: &Start<'_, S>,
        target: Option<T>,
        memory: &mut Self::Memory,
        statistics: &mut Statistics,
    ) -> Result<Arrival<S>, IntegrationError> {
        adaptive::advance(self, &self.control, start, target, memory, statistics)
    }

    fn dense(&self, memory: &Self::Memory, _start: &Start<'_, S>, _arrival: &Arrival<S>) -> Self::Memory {
        *memory
    }

    /// With s the fraction of the step and Δ = x₁ − x₀:
    /// x₀ + s (Δ + (1−s) (h f₀ − Δ + s (2Δ − h f₀ − h f₁ + (1−s) bulge))), the Hermite cubic and a
    /// term of degree 4 (the function `CONTD5` of the code DOPRI5).
    fn interpolate(
        &self,
        memory: &Self::Dense,
        start: &Start<'_, S>,
        arrival: &Arrival<S>,
        time: T,
    ) -> S::State {
        let h = arrival.time - start.time;
        let s = (time - start.time) / h;
        let rest = T::ONE - s;
        let (f0, f1) = &memory.ends;
        let zero = <crate::DimOf<S> as crate::Dim>::vec(T::ZERO);
        let bulge = memory.bulge.unwrap_or(zero);
        let mut x = start.state.to_array();
        let x1 = arrival.state.to_array();
        let data = f0.as_ref().iter().zip(f1.as_ref()).zip(bulge.as_ref()).zip(x1.as_ref());
        for (x, (((&f0, &f1), &bulge), &x1)) in x.as_mut().iter_mut().zip(data) {
            let change = x1 - *x;
            let entry = h * f0 - change;
            let exit = change - h * f1 - entry;
            *x += s * (change + rest * (entry + s * (exit + rest * bulge)));
        }
        S::State::from_array(x)
    }
}

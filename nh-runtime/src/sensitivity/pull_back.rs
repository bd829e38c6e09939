//! The adjoint of one explicit step.

use nalgebra::SMatrix;

use crate::arrays::{ahead, displaced};
use crate::methods::{Fixed, Start, Tableau, stages_of};
use crate::{D, Jacobian, Scalar, State};

/// What the derivative of a step, transposed, makes of a covector λ at its end.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct PulledBack<X, T, const N: usize, const M: usize, const Q: usize = 0> {
    /// The state at the end of the step.
    pub state: X,
    /// λ ∂x₁/∂x₀.
    pub by_state: [T; N],
    /// λ ∂x₁/∂u.
    pub by_input: [T; M],
    /// λ ∂x₁/∂p.
    pub by_parameters: [T; Q],
}

impl<P: Tableau, T: Scalar> Fixed<P, T> {
    /// One step of length `dt`, and a covector at its end pulled back to its start: the product with the derivative of
    /// the step from the left, by one evaluation of the Jacobian at each stage, without a matrix. The covector may
    /// depend on where the step leads. `parameters` gives ∂F/∂p, as the generated `parameter_jacobian` does.
    ///
    /// With Yᵢ the states of the stages, λ₀ = λ + Σ λᵢ and λᵢ = Aᵢᵀ κᵢ with κᵢ = h (bᵢ λ + Σⱼ aⱼᵢ λⱼ), mathematics (52).
    ///
    /// ```
    /// use nonholonomic::prelude::*;
    ///
    /// /// A mass on a spring, pushed.
    /// #[nonholonomic(
    ///     base       { x }
    ///     lagrangian { m / 2 * der(x)^2 - k / 2 * x^2 }
    ///     forces     { x: push; }
    ///     inputs     { push }
    ///     emit       { jacobian, parameter_jacobian }
    /// )]
    /// #[derive(Clone, Copy, Debug)]
    /// struct Oscillator { m: f64, k: f64 }
    ///
    /// let oscillator = Oscillator { m: 1.0, k: 4.0 };
    /// let (start, input) = (OscillatorState { x: 1.0, x_dot: 0.0 }, OscillatorInput { push: 0.5 });
    /// let step = Rk4::linearized_step(&oscillator, 0.0, 0.1, &start, &input);
    /// let back = Rk4::pulled_back_step(&oscillator, 0.0, 0.1, &start, &input, |_end| [1.0, 0.0], |t, x, u| {
    ///     oscillator.parameter_jacobian(t, x, u)
    /// });
    /// assert!((back.by_state[1] - step.by_state[(0, 1)]).abs() < 1e-16);
    /// assert!((back.by_input[0] - step.by_input[(0, 0)]).abs() < 1e-16);
    /// let [by_m, by_k] = back.by_parameters;
    /// assert!(by_m > 0.0 && by_k < 0.0);
    /// ```
    ///
    /// Where the system returns to position constraints, the return is a part of the step and pulled back with it, as in
    /// [`linearized_step`](Self::linearized_step); but the constraints may depend on parameters, and what is pulled back to
    /// these is NaN.
    #[doc(alias("vector-Jacobian product", "vjp", "adjoint"))]
    pub fn pulled_back_step<S, const N: usize, const M: usize, const Q: usize>(
        system: &S,
        t: T,
        dt: T,
        state: &S::State,
        input: &S::Input,
        covector: impl FnOnce(&S::State) -> [T; N],
        parameters: impl Fn(T, &S::State, &S::Input) -> SMatrix<T, N, Q>,
    ) -> PulledBack<S::State, T, N, M, Q>
    where
        S: Jacobian<InputDim = D<M>>,
        S::State: State<Scalar = T, Dim = D<N>>,
    {
        let start = Start { system, input, time: t, state };
        let x = state.to_array();
        let (stages, slope) = stages_of::<S, P>(&start, &x, dt);
        let scale = T::from_f64(P::SCALE);
        let mut end = S::State::from_array(displaced(&x, dt * scale, &slope));
        let mut of_parameters = T::ZERO;
        let lambda = if system.has_positions() {
            // the constraints may depend on parameters
            of_parameters = T::from_f64(f64::NAN);
            let slopes = system.return_jacobian(t + dt, &end);
            system.correct_positions(t + dt, &mut end);
            let mut before = [T::ZERO; N];
            for (lambda, row) in covector(&end).iter().zip(&slopes) {
                add(&mut before, *lambda, row);
            }
            before
        } else {
            covector(&end)
        };
        let (slopes, mut weights) = (P::list(&stages), P::list(&P::room([T::ZERO; N])));
        // κᵢ/h, as far as they are known
        for (i, b) in P::WEIGHTS {
            if let Some(weight) = weights.as_mut().get_mut(*i) {
                *weight = lambda.map(|lambda| lambda * (T::from_f64(*b) * scale));
            }
        }
        let mut back = PulledBack {
            state: end,
            by_state: lambda,
            by_input: [T::ZERO; M],
            by_parameters: [of_parameters; Q],
        };
        for (i, (c, row)) in P::ROWS.iter().enumerate().rev() {
            let Some(kappa) = weights.as_ref().get(i).map(|weight| weight.map(|weight| weight * dt)) else {
                continue;
            };
            let mut point = x;
            if let Some(((first, a), rest)) = row.split_first()
                && let Some(slope) = slopes.as_ref().get(*first)
            {
                let mut sum = ahead(&[T::ZERO; N], T::ONE, (T::from_f64(*a), slope), []);
                for (j, a) in rest {
                    if let Some(slope) = slopes.as_ref().get(*j) {
                        sum = displaced(&sum, T::from_f64(*a), slope);
                    }
                }
                point = displaced(&x, dt, &sum);
            }
            let (time, point) = (t + T::from_f64(*c) * dt, S::State::from_array(point));
            let (_, a, b) = system.linearized(time, &point, input);
            let mut own = [T::ZERO; N];
            for (i, ((kappa, a), b)) in kappa.iter().zip(&a).zip(&b).enumerate() {
                for (j, (own, a)) in own.iter_mut().zip(a).enumerate() {
                    if S::state_depends(i, j) {
                        *own = kappa.mul_add(*a, *own);
                    }
                }
                add(&mut back.by_input, *kappa, b);
            }
            if Q > 0 {
                let columns = parameters(time, &point, input);
                for (sum, column) in back.by_parameters.iter_mut().zip(columns.column_iter()) {
                    *sum = column.iter().zip(&kappa).fold(*sum, |sum, (p, kappa)| p.mul_add(*kappa, sum));
                }
            }
            add(&mut back.by_state, T::ONE, &own);
            for (j, a) in *row {
                if let Some(weight) = weights.as_mut().get_mut(*j) {
                    add(weight, T::from_f64(*a), &own);
                }
            }
        }
        back
    }
}

/// sum += a x.
#[inline]
pub(super) fn add<T: Scalar, const N: usize>(sum: &mut [T; N], a: T, x: &[T; N]) {
    for (sum, x) in sum.iter_mut().zip(x) {
        *sum = a.mul_add(*x, *sum);
    }
}

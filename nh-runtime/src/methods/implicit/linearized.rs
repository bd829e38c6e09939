//! The derivatives of the steps of collocation methods.

use super::collocation::{Collocation, Matrices};
use super::gauss::{Gauss, GaussLegendre4, GaussLegendre6, Table, Work, settled};
use super::linearization::Analytic;
use super::newton::{MOST_ITERATIONS, check_length, one_less, size};
use super::radau5::{RADAU, Radau5};
use crate::arrays::displaced;
use crate::methods::transition::of_rows;
use crate::methods::{Start, Transition};
use crate::{D, IntegrationError, Jacobian, Real, State, Statistics};

macro_rules! linearized_step {
    ($name:ident, $table:expr) => {
        impl<T: Real> $name<T> {
            /// One step of length `dt` with its derivatives by the state and the input, from the system's own
            /// Jacobian A, B at the stages: zᵢ' = h Σ aᵢⱼ (Aⱼ (X + zⱼ') + Bⱼ U), the equations of the step
            /// differentiated where they are solved, and solved by the same iteration.
            ///
            /// # Errors
            /// [`IntegrationError::NoConvergence`] if the equations of the step are not solved,
            /// [`IntegrationError::NonFiniteDerivative`] if the derivative at `state` is not finite,
            /// [`IntegrationError::Setting`] if `dt` is not. Where the derivatives cannot be had they are NaN.
            pub fn linearized_step<S, const N: usize, const M: usize>(
                system: &S,
                t: T,
                dt: T,
                state: &S::State,
                input: &S::Input,
            ) -> Result<Transition<S::State, T, N, M>, IntegrationError>
            where
                S: Jacobian<InputDim = D<M>>,
                S::State: State<Scalar = T, Dim = D<N>>,
            {
                let step = linearized($table, &Start { system, input, time: t, state }, dt)?;
                Ok(step.returned(system, t + dt))
            }
        }
    };
}
linearized_step!(GaussLegendre4, &<Gauss<T, Analytic, 2> as Table<2>>::TABLE);
linearized_step!(GaussLegendre6, &<Gauss<T, Analytic, 3> as Table<3>>::TABLE);
linearized_step!(Radau5, &RADAU);

/// A step of a collocation method, solved to round-off, with its derivatives.
fn linearized<T, S, const STAGES: usize, const N: usize, const M: usize>(
    table: &Collocation<STAGES>,
    start: &Start<'_, S>,
    h: T,
) -> Result<Transition<S::State, T, N, M>, IntegrationError>
where
    T: Real,
    S: Jacobian<InputDim = D<M>>,
    S::State: State<Scalar = T, Dim = D<N>>,
{
    check_length(h)?;
    let x = start.state.to_array();
    let mut work = Work::none();
    let (tolerance, statistics) = (T::from_f64(1e3) * T::EPSILON, &mut Statistics::default());
    let (z, rests) = settled(table, &Analytic, tolerance, (start, &[T::ZERO; N]), h, &mut work, statistics)?;
    let end = displaced(&x, T::ONE, &table.increment([T::ZERO; N], &z, &rests));
    let mut stages = [Stage { a: [[T::ZERO; N]; N], b: [[T::ZERO; M]; N] }; STAGES];
    for ((stage, node), z) in stages.iter_mut().zip(&table.nodes).zip(&z) {
        let time = start.time + T::from_f64(*node) * h;
        let point = S::State::from_array(displaced(&x, T::ONE, z));
        stage.a = start.system.state_jacobian(time, &point, start.input);
        stage.b = start.system.input_jacobian(time, &point, start.input);
    }
    let mut step: Transition<S::State, T, N, M> = Transition::unknown(S::State::from_array(end));
    if let Some((_, matrices)) = &work.matrices {
        for (j, mut column) in step.by_state.column_iter_mut().enumerate() {
            let mut direction = [T::ZERO; N];
            if let Some(one) = direction.get_mut(j) {
                *one = T::ONE;
            }
            let change = table.derivative(h, matrices, &stages, &direction, None);
            column.iter_mut().zip(displaced(&direction, T::ONE, &change)).for_each(|(to, from)| *to = from);
        }
        for (j, mut column) in step.by_input.column_iter_mut().enumerate() {
            let change = table.derivative(h, matrices, &stages, &[T::ZERO; N], Some(j));
            column.iter_mut().zip(change).for_each(|(to, from)| *to = from);
        }
    } else if let Some(Stage { a, b }) = stages.first() {
        // too short for matrices: 1 + h A and h B
        step.by_state = of_rows(&one_less::<D<N>, T>(-h, *a));
        step.by_input = of_rows(&b.map(|row| row.map(|entry| h * entry)));
    }
    Ok(step)
}

/// The Jacobians ∂f/∂x and ∂f/∂u at a stage.
#[derive(Clone, Copy)]
struct Stage<T, const N: usize, const M: usize> {
    a: [[T; N]; N],
    b: [[T; M]; N],
}

impl<const STAGES: usize> Collocation<STAGES> {
    /// The derivative of x₁ − x₀ in a direction of the state, or by an input; NaN if the iteration does
    /// not settle.
    fn derivative<T, S, const N: usize, const M: usize>(
        &self,
        h: T,
        matrices: &Matrices<S>,
        stages: &[Stage<T, N, M>; STAGES],
        direction: &[T; N],
        input: Option<usize>,
    ) -> [T; N]
    where
        T: Real,
        S: Jacobian,
        S::State: State<Scalar = T, Dim = D<N>>,
    {
        let mut z = [[T::ZERO; N]; STAGES];
        let mut rests = z;
        let mut best = T::EPSILON.recip();
        for _ in 0..MOST_ITERATIONS {
            let mut slopes = [[T::ZERO; N]; STAGES];
            for ((slopes, stage), z) in slopes.iter_mut().zip(stages).zip(&z) {
                let moved = displaced(direction, T::ONE, z);
                for ((slope, a), b) in slopes.iter_mut().zip(&stage.a).zip(&stage.b) {
                    let by_input = input.and_then(|j| b.get(j)).copied().unwrap_or(T::ZERO);
                    *slope = a.iter().zip(&moved).fold(by_input, |sum, (a, x)| a.mul_add(*x, sum));
                }
            }
            let change = self.corrected(h, matrices, &slopes, (&mut z, &mut rests));
            let sizes = change.iter().zip(&z).map(|(change, z)| size(change, direction, z));
            let largest = sizes.fold(T::ZERO, T::max);
            if !largest.is_finite() {
                break;
            }
            let small = largest <= T::from_f64(1e3) * T::EPSILON;
            if largest == T::ZERO || (small && largest >= best * T::from_f64(0.5)) {
                return self.increment([T::ZERO; N], &z, &rests);
            }
            best = best.min(largest);
        }
        [T::from_f64(f64::NAN); N]
    }
}

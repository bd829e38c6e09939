//! The cost of a sequence of inputs and its exact gradient: what a general optimiser asks for.

use nalgebra::SVector;

use super::{ControlError, Cost, Entry, Model, finite};

/// The cost of a sequence of inputs from a state, without its gradient. Inputs that lead out of the numbers
/// cost infinity or NaN, which a line search steps back from.
#[doc(alias("MPPI"))]
pub fn shooting_cost<T: Entry, const N: usize, const M: usize>(
    model: &impl Model<T, N, M>,
    cost: &impl Cost<T, N, M>,
    start: &SVector<T, N>,
    inputs: &[SVector<T, M>],
) -> T {
    let mut x = *start;
    let mut sum = T::ZERO;
    for (tick, u) in inputs.iter().enumerate() {
        sum += cost.stage(tick, &x, u);
        x = model.step(tick, &x, u);
    }
    sum + cost.end(&x)
}

/// The cost of a sequence of inputs from a state, and its gradient by the inputs, by one sweep
/// forwards and one backwards (the adjoint equations; Bryson, Ho, Applied Optimal Control, 2.2).
///
/// `states` is where the sweep forwards leaves the state *before* each tick; `gradient` receives
/// the derivatives by the inputs of each tick. This is the seam to a maintained optimiser: the
/// crate `argmin`, for instance, takes a cost and a gradient from an implementation of its traits
/// `CostFunction` and `Gradient`, each a line that calls this module; the example `parking` shows it.
///
/// Of long sequences, by the start and by parameters, and with few states kept:
/// [`Adjoint`](crate::sensitivity::Adjoint), by the same adjoint of a step.
///
/// # Errors
/// [`ControlError::Length`] if the three slices differ in length, [`ControlError::NotFinite`] if the cost or
/// its gradient is not finite; `states` and `gradient` then hold what was computed.
pub fn shooting_gradient<T: Entry, const N: usize, const M: usize>(
    model: &impl Model<T, N, M>,
    cost: &impl Cost<T, N, M>,
    start: &SVector<T, N>,
    inputs: &[SVector<T, M>],
    states: &mut [SVector<T, N>],
    gradient: &mut [SVector<T, M>],
) -> Result<T, ControlError> {
    let ticks = inputs.len();
    for (slice, length) in [("states", states.len()), ("gradient", gradient.len())] {
        if length != ticks {
            return Err(ControlError::Length { slice, length, expected: ticks });
        }
    }
    let mut x = *start;
    let mut sum = T::ZERO;
    for ((tick, u), before) in inputs.iter().enumerate().zip(states.iter_mut()) {
        *before = x;
        sum += cost.stage(tick, &x, u);
        x = model.step(tick, &x, u);
    }
    let total = sum + cost.end(&x);
    if !total.is_finite() {
        return Err(ControlError::NotFinite { argument: "cost", value: total.to_f64() });
    }
    // the derivative of the cost to go by the state
    let mut adjoint = cost.end_expansion(&x).x;
    let sweep = inputs.iter().enumerate().zip(states.iter()).zip(gradient.iter_mut());
    for (((tick, u), x), slot) in sweep.rev() {
        let (by_state, by_input) = model.pulled_back(tick, x, u, &adjoint);
        let stage = cost.stage_expansion(tick, x, u);
        *slot = stage.u + by_input;
        finite("gradient", slot)?;
        adjoint = stage.x + by_state;
    }
    Ok(total)
}

#[cfg(test)]
mod tests {
    use super::super::Quadratic;
    use super::*;
    use nalgebra::{SMatrix, matrix, vector};

    /// A pendulum, by Euler's method with a tick of a tenth.
    pub(crate) struct Pendulum;

    impl Model<f64, 2, 1> for Pendulum {
        fn step(&self, _tick: usize, x: &SVector<f64, 2>, u: &SVector<f64, 1>) -> SVector<f64, 2> {
            vector![x[0] + 0.1 * x[1], x[1] + 0.1 * (u[0] - x[0].sin())]
        }
        fn linearized(
            &self,
            _tick: usize,
            x: &SVector<f64, 2>,
            _u: &SVector<f64, 1>,
        ) -> (SMatrix<f64, 2, 2>, SMatrix<f64, 2, 1>) {
            (matrix![1.0, 0.1; -0.1 * x[0].cos(), 1.0], matrix![0.0; 0.1])
        }
    }

    #[test]
    fn the_gradient_agrees_with_differences() {
        let cost = Quadratic {
            goal: vector![1.0, 0.0],
            state: vector![1.0, 0.1],
            input: vector![0.01],
            end: vector![10.0, 1.0],
        };
        let start = vector![0.2, -0.1];
        let inputs: [SVector<f64, 1>; 20] =
            core::array::from_fn(|k| vector![if k % 3 == 0 { 0.8 } else { -0.3 }]);
        let (mut states, mut gradient) = ([SVector::zeros(); 20], [SVector::zeros(); 20]);
        let total = shooting_gradient(&Pendulum, &cost, &start, &inputs, &mut states, &mut gradient).unwrap();
        assert!((total - shooting_cost(&Pendulum, &cost, &start, &inputs)).abs() < 1e-15);
        for k in 0..20 {
            let moved = |by: f64| {
                let mut inputs = inputs;
                inputs[k][0] += by;
                shooting_cost(&Pendulum, &cost, &start, &inputs)
            };
            let difference = (moved(1e-5) - moved(-1e-5)) / 2e-5;
            assert!((difference - gradient[k][0]).abs() < 1e-9, "{difference} {}", gradient[k][0]);
        }
        let short = shooting_gradient(&Pendulum, &cost, &start, &inputs, &mut states[..3], &mut gradient);
        assert_eq!(short, Err(ControlError::Length { slice: "states", length: 3, expected: 20 }));
    }
}

//! Optimal inputs over a horizon by the iterative linear-quadratic regulator.

use nalgebra::{SMatrix, SVector};

use super::box_quadratic::{CURVATURE, between, minimum};
use super::regularization::Regularization;
use super::{ControlError, Cost, Entry, Model, finite, shooting_cost, symmetrized};

/// Halvings of the step in the line search.
const MOST_HALVINGS: u32 = 12;
/// What is given by the user's model and cost.
const DERIVATIVES: &str = "the derivatives of model and cost";

/// A sequence of `H` inputs between bounds that is being made optimal: the iterative
/// linear-quadratic regulator (Li, Todorov, ICINCO 2004) with bounds on the inputs (Tassa, Mansard,
/// Todorov, ICRA 2014).
///
/// For model predictive control call [`improve`](Self::improve) once or a few times in every tick from the state
/// that is measured, apply the first input and [`shift`](Self::shift): the cost in time of `improve` is
/// bounded. A plan that has been improved is followed from the measured state by its feedback, unless its inputs
/// alone cost less: on a plant that is unstable they would lead away from the plan as soon as the plant is not the
/// model, and nothing that is found in one iteration would bring them back. So begin with a plan from the goal
/// itself: its feedback leads there from elsewhere. The example `balance` is such a loop.
///
/// All memory is in the value itself, `H · (N·M + N + 2M) + N` numbers, and [`improve`](Self::improve) has as much again
/// on the stack. A horizon without a tick does not compile:
///
/// ```compile_fail,E0080
/// nonholonomic::control::Ilqr::<f64, 2, 1, 0>::new(nalgebra::vector![0.0]);
/// ```
#[doc(alias("MPC", "DDP"))]
#[derive(Clone, Copy, Debug)]
pub struct Ilqr<T, const N: usize, const M: usize, const H: usize> {
    inputs: [SVector<T, M>; H],
    states: [SVector<T, N>; H],
    gains: [SMatrix<T, M, N>; H],
    changes: [SVector<T, M>; H],
    /// The state after the last tick.
    end: SVector<T, N>,
    /// Whether states and gains belong to the inputs.
    is_planned: bool,
    lower: SVector<T, M>,
    upper: SVector<T, M>,
    regularization: Regularization<T>,
}

/// What an iteration did.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Improvement<T> {
    /// The cost after it.
    pub cost: T,
    /// By how much it is less than before; zero if no step was found.
    pub decrease: T,
    /// The decrease that the quadratic model promised for a full step: zero at an optimum.
    pub promised: T,
}

impl<T: Entry, const N: usize, const M: usize, const H: usize> Ilqr<T, N, M, H> {
    /// Starts from a constant input, without bounds.
    #[must_use]
    pub fn new(input: SVector<T, M>) -> Self {
        const { assert!(H > 0, "a horizon has at least one tick") };
        let huge = T::MIN_POSITIVE.recip();
        Self {
            inputs: [input; H],
            states: [SVector::zeros(); H],
            gains: [SMatrix::zeros(); H],
            changes: [SVector::zeros(); H],
            end: SVector::zeros(),
            is_planned: false,
            lower: SVector::repeat(-huge),
            upper: SVector::repeat(huge),
            regularization: Regularization::none(),
        }
    }

    /// Keeps every input between these bounds.
    #[must_use]
    pub fn bounds(mut self, lower: SVector<T, M>, upper: SVector<T, M>) -> Self {
        (self.lower, self.upper) = (lower, upper);
        for u in &mut self.inputs {
            *u = clamped(u, &lower, &upper);
        }
        self
    }

    /// The inputs, one for each tick.
    #[must_use]
    pub fn inputs(&self) -> &[SVector<T, M>; H] {
        &self.inputs
    }

    /// The inputs, to be changed: a first guess. The next [`improve`](Self::improve) takes them between the bounds, without
    /// feedback along an earlier plan.
    pub fn inputs_mut(&mut self) -> &mut [SVector<T, M>; H] {
        self.is_planned = false;
        &mut self.inputs
    }

    /// The states before each tick along the inputs, after an [`improve`](Self::improve).
    #[must_use]
    pub fn states(&self) -> &[SVector<T, N>; H] {
        &self.states
    }

    /// The feedback K along the trajectory that [`improve`](Self::improve) expanded about:
    /// u = u_k + K_k (x − x_k) holds a system to it that is disturbed.
    #[must_use]
    pub fn gains(&self) -> &[SMatrix<T, M, N>; H] {
        &self.gains
    }

    /// Drops the first tick and repeats the last: the horizon recedes. States and gains go with the inputs, so
    /// that [`inputs`](Self::inputs), [`states`](Self::states) and [`gains`](Self::gains) are those of the ticks that
    /// are left, and the next [`improve`](Self::improve) follows them from where the plant really is. The
    /// state before the new tick is where the old plan ended; its input and gain are those of the tick before.
    pub fn shift(&mut self) {
        recede(&mut self.inputs);
        recede(&mut self.gains);
        self.states.rotate_left(1);
        if let [.., last] = self.states.as_mut_slice() {
            *last = self.end;
        }
    }

    /// Iterates until the promised decrease is below `tolerance` of the cost, or `most` iterations
    /// are done, at least one; returns the last of them.
    ///
    /// # Errors
    /// As [`improve`](Self::improve), and [`ControlError::Setting`] for a tolerance that is no number.
    pub fn solve(
        &mut self,
        model: &impl Model<T, N, M>,
        cost: &impl Cost<T, N, M>,
        start: &SVector<T, N>,
        tolerance: T,
        most: u32,
    ) -> Result<Improvement<T>, ControlError> {
        if !tolerance.is_finite() {
            let (setting, value) = ("tolerance", tolerance.to_f64());
            return Err(ControlError::Setting { setting, value, expected: "finite" });
        }
        let mut last = self.improve(model, cost, start)?;
        for _ in 1..most {
            if last.promised <= tolerance * last.cost.abs() {
                break;
            }
            last = self.improve(model, cost, start)?;
        }
        Ok(last)
    }

    /// One iteration from the state `start`: an expansion along the inputs, a sweep backwards, a
    /// line search. The inputs change only if the cost decreases.
    ///
    /// If there is a plan from another start, the inputs are first replaced by those with which its feedback follows
    /// it from here, where they cost less.
    ///
    /// # Errors
    /// [`ControlError::NotFinite`] if `start`, the inputs or a derivative is not finite, or the inputs lead out
    /// of the numbers; [`ControlError::Bounds`] if there is nothing between two bounds;
    /// [`ControlError::NotDefinite`] if no regularization makes the cost convex in the inputs. Nothing has then
    /// changed: inputs, states and gains are those of before.
    pub fn improve(
        &mut self,
        model: &impl Model<T, N, M>,
        cost: &impl Cost<T, N, M>,
        start: &SVector<T, N>,
    ) -> Result<Improvement<T>, ControlError> {
        let before = *self;
        let result = self.iteration(model, cost, start);
        if result.is_err() {
            *self = before;
        }
        result
    }

    fn iteration(
        &mut self,
        model: &impl Model<T, N, M>,
        cost: &impl Cost<T, N, M>,
        start: &SVector<T, N>,
    ) -> Result<Improvement<T>, ControlError> {
        finite("start", start)?;
        for (input, (low, high)) in self.lower.iter().zip(self.upper.iter()).enumerate() {
            if !low.all_ge(*low) || !high.all_ge(*low) {
                return Err(ControlError::Bounds { input, lower: low.to_f64(), upper: high.to_f64() });
            }
        }
        self.inputs.iter().try_for_each(|u| finite("inputs", u))?;
        for u in &mut self.inputs {
            *u = clamped(u, &self.lower, &self.upper);
        }
        let mut before = shooting_cost(model, cost, start, &self.inputs);
        if self.is_planned && *start != self.states[0] {
            let (inputs, held) = self.tried(model, cost, start, T::ZERO);
            if held < before || (held.is_finite() && !before.is_finite()) {
                (self.inputs, before) = (inputs, held);
            }
        }
        if !before.is_finite() {
            return Err(ControlError::NotFinite { argument: "cost", value: before.to_f64() });
        }
        let end = self.roll_out(model, start);
        let promised = loop {
            match self.sweep(model, cost, &end) {
                Ok(promised) => break promised,
                // feedback beyond the numbers, too, is that of a cost that is hardly convex
                Err(
                    error @ (ControlError::NotDefinite { .. }
                    | ControlError::NotFinite { argument: CURVATURE, .. }),
                ) => {
                    if !self.regularization.grow() {
                        return Err(error);
                    }
                }
                Err(error) => return Err(error),
            }
        };
        let mut share = T::ONE;
        for _ in 0..=MOST_HALVINGS {
            let (inputs, after) = self.tried(model, cost, start, share);
            let decrease = before - after;
            // Armijo's condition
            if decrease > T::from_f64(1e-4) * share * promised {
                self.inputs = inputs;
                self.regularization.shrink();
                self.roll_out(model, start);
                return Ok(Improvement { cost: after, decrease, promised });
            }
            share *= T::from_f64(0.5);
        }
        // where rounding hides what was promised, the curvature is not to blame: feedback stays what it is
        if promised > self.rounding(cost) {
            self.regularization.grow();
        } else {
            self.regularization.shrink();
        }
        Ok(Improvement { cost: before, decrease: T::ZERO, promised })
    }

    /// The states along the inputs; returns the one at the end.
    fn roll_out(&mut self, model: &impl Model<T, N, M>, start: &SVector<T, N>) -> SVector<T, N> {
        let mut x = *start;
        for ((tick, u), before) in self.inputs.iter().enumerate().zip(&mut self.states) {
            *before = x;
            x = model.step(tick, &x, u);
        }
        self.end = x;
        self.is_planned = true;
        x
    }

    /// Bellman's recursion on the quadratic model; returns the decrease that it promises.
    fn sweep(
        &mut self,
        model: &impl Model<T, N, M>,
        cost: &impl Cost<T, N, M>,
        end: &SVector<T, N>,
    ) -> Result<T, ControlError> {
        let last = cost.end_expansion(end);
        finite(DERIVATIVES, &last.x).and(finite(DERIVATIVES, &last.xx))?;
        let (mut slope, mut curvature) = (last.x, symmetrized(&last.xx));
        let mut promised = T::ZERO;
        let nominal = self.inputs.iter().enumerate().zip(&self.states);
        let results = self.gains.iter_mut().zip(&mut self.changes);
        for (((tick, u), x), (gain, change)) in nominal.zip(results).rev() {
            let (a, b) = model.linearized(tick, x, u);
            let stage = cost.stage_expansion(tick, x, u);
            stage.finite(DERIVATIVES).and(finite(DERIVATIVES, &a)).and(finite(DERIVATIVES, &b))?;
            let by_state = stage.x + a.transpose() * slope;
            let by_input = stage.u + b.transpose() * slope;
            let through = b.transpose() * curvature;
            let mixed = stage.ux + through * a;
            let reached = through * b;
            let twice = symmetrized(&(stage.uu + reached));
            let (low, high) = (self.lower - u, self.upper - u);
            let range = self.upper - self.lower;
            let mut heavy = twice + self.regularization.of([&stage.uu, &reached], &by_input, &range);
            // an input that the cost does not feel stays as it is: zero is divided by any number
            for i in 0..M {
                let is_felt = |list: &[T]| list.iter().any(|entry| *entry != T::ZERO);
                let curved = core::array::from_fn::<T, M, _>(|j| twice[(i, j)]);
                let tied = core::array::from_fn::<T, N, _>(|j| mixed[(i, j)]);
                if !is_felt(&curved) && !is_felt(&tied) && by_input[i] == T::ZERO {
                    heavy[(i, i)] = T::ONE;
                }
            }
            let best = minimum(&heavy, &by_input, [&low, &high], change)?;
            // the components that a bound holds do not answer to the state
            let mut answering = mixed;
            for (i, free) in best.free.iter().enumerate() {
                if !free {
                    answering.set_row(i, &SMatrix::<T, 1, N>::zeros());
                }
            }
            *gain = -best.factors.solve(&answering);
            *change = best.at;
            finite(CURVATURE, gain)?;
            finite(CURVATURE, change)?;
            promised -= change.dot(&by_input) + change.dot(&(twice * *change)) * T::from_f64(0.5);
            let (k, d) = (*gain, *change);
            slope = by_state + k.transpose() * (twice * d + by_input) + mixed.transpose() * d;
            curvature = symmetrized(
                &(stage.xx
                    + a.transpose() * curvature * a
                    + k.transpose() * twice * k
                    + k.transpose() * mixed
                    + mixed.transpose() * k),
            );
        }
        Ok(promised)
    }

    /// What rounding may do to the cost of the plan: ε of its terms, for every component of every tick.
    fn rounding(&self, cost: &impl Cost<T, N, M>) -> T {
        let ticks = self.states.iter().zip(&self.inputs).enumerate();
        let terms = ticks.map(|(tick, (x, u))| cost.stage(tick, x, u).abs());
        let sum = terms.fold(cost.end(&self.end).abs(), |sum, term| sum + term);
        let count = u32::try_from(H.saturating_mul(N + M)).unwrap_or(u32::MAX);
        T::from_u32(count) * T::EPSILON * sum
    }

    /// The inputs after a share of the step, with feedback along the way, and their cost.
    fn tried(
        &self,
        model: &impl Model<T, N, M>,
        cost: &impl Cost<T, N, M>,
        start: &SVector<T, N>,
        share: T,
    ) -> ([SVector<T, M>; H], T) {
        let mut inputs = self.inputs;
        let mut x = *start;
        let mut sum = T::ZERO;
        let plan = self.states.iter().zip(&self.gains).zip(&self.changes);
        for ((tick, u), ((nominal, gain), change)) in inputs.iter_mut().enumerate().zip(plan) {
            *u = clamped(&(*u + change * share + gain * (x - nominal)), &self.lower, &self.upper);
            sum += cost.stage(tick, &x, u);
            x = model.step(tick, &x, u);
        }
        (inputs, sum + cost.end(&x))
    }
}

/// Drops the first and repeats the last.
fn recede<X: Copy, const H: usize>(ticks: &mut [X; H]) {
    ticks.rotate_left(1);
    if let [.., before, last] = ticks.as_mut_slice() {
        *last = *before;
    }
}

fn clamped<T: Entry, const M: usize>(
    u: &SVector<T, M>,
    lower: &SVector<T, M>,
    upper: &SVector<T, M>,
) -> SVector<T, M> {
    u.zip_zip_map(lower, upper, between)
}

#[cfg(test)]
mod ilqr_tests;

//! The derivatives of the steps of collocation methods.

use super::collocation::Collocation;
use super::gauss::{Gauss, GaussLegendre4, GaussLegendre6, Table, Work, settled};
use super::linearization::Analytic;
use super::newton::check_length;
use super::radau5::{RADAU, Radau5};
use crate::arrays::displaced;
use crate::methods::{Start, Transition};
use crate::{D, IntegrationError, Jacobian, Real, State, Statistics};

macro_rules! linearized_step {
    ($name:ident, $table:expr) => {
        impl<T: Real> $name<T> {
            /// One step of length `dt` with its derivatives by the state and the input, from the system's own
            /// Jacobian A, B at the stages: zᵢ' = h Σ aᵢⱼ (Aⱼ (X + zⱼ') + Bⱼ U), the equations of the step
            /// differentiated where they are solved, and solved by elimination.
            ///
            /// # Errors
            /// [`IntegrationError::NoConvergence`] if the equations of the step are not solved,
            /// [`IntegrationError::SingularStep`] if they have no derivatives where they are,
            /// [`IntegrationError::NonFiniteDerivative`] if the derivative at `state` is not finite,
            /// [`IntegrationError::Setting`] if `dt` is not.
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
    let mut rows = [[Row::zero(); N]; STAGES];
    for (j, (node, z)) in table.nodes.iter().zip(&z).enumerate() {
        let time = start.time + T::from_f64(*node) * h;
        let point = S::State::from_array(displaced(&x, T::ONE, z));
        let a = start.system.state_jacobian(time, &point, start.input);
        let b = start.system.input_jacobian(time, &point, start.input);
        for (rows, weights) in rows.iter_mut().zip(&table.matrix) {
            let weight = weights.get(j).map_or(T::ZERO, |(weight, _)| h * T::from_f64(*weight));
            for (row, (a, b)) in rows.iter_mut().zip(a.iter().zip(&b)) {
                row.note(j, weight, a, b);
            }
        }
    }
    let changes = solved(rows);
    let mut step: Transition<S::State, T, N, M> = Transition::unknown(S::State::from_array(end));
    let ends = |of: &dyn Fn(&Row<T, STAGES, N, M>) -> T, component: usize| {
        let stages = changes.iter().zip(&table.end);
        stages.fold(T::ZERO, |sum, (stage, (weight, _))| {
            sum + T::from_f64(*weight) * stage.get(component).map_or(T::ZERO, of)
        })
    };
    for j in 0..N {
        for (i, entry) in step.by_state.column_mut(j).iter_mut().enumerate() {
            let own = if i == j { T::ONE } else { T::ZERO };
            *entry = own + ends(&|row| row.by_state.get(j).copied().unwrap_or(T::ZERO), i);
        }
    }
    for j in 0..M {
        for (i, entry) in step.by_input.column_mut(j).iter_mut().enumerate() {
            *entry = ends(&|row| row.by_input.get(j).copied().unwrap_or(T::ZERO), i);
        }
    }
    step.regular(start.time, h)
}

/// One of the equations (1 − h a ⊗ A) z' = h a ⊗ (A X + B U), or of their solution: the derivatives of one component of a
/// stage.
#[derive(Clone, Copy)]
struct Row<T, const STAGES: usize, const N: usize, const M: usize> {
    /// The coefficients of the components of all stages.
    left: [[T; N]; STAGES],
    by_state: [T; N],
    by_input: [T; M],
    /// The component that it is solved for.
    pivot: Option<(usize, usize)>,
}

impl<T: Real, const STAGES: usize, const N: usize, const M: usize> Row<T, STAGES, N, M> {
    fn zero() -> Self {
        Self { left: [[T::ZERO; N]; STAGES], by_state: [T::ZERO; N], by_input: [T::ZERO; M], pivot: None }
    }

    /// Takes up what a stage does, by a row of its Jacobians.
    fn note(&mut self, stage: usize, weight: T, a: &[T; N], b: &[T; M]) {
        let left = self.left.get_mut(stage).into_iter().flatten();
        for ((left, by_state), a) in left.zip(&mut self.by_state).zip(a) {
            *left -= weight * *a;
            *by_state += weight * *a;
        }
        for (by_input, b) in self.by_input.iter_mut().zip(b) {
            *by_input += weight * *b;
        }
    }

    fn at(&self, (stage, component): (usize, usize)) -> T {
        self.left.get(stage).and_then(|left| left.get(component)).copied().unwrap_or(T::ZERO)
    }

    fn numbers(&mut self) -> impl Iterator<Item = &mut T> {
        self.left.as_flattened_mut().iter_mut().chain(&mut self.by_state).chain(&mut self.by_input)
    }
}

/// The solutions, by stages and components, by Gauss and Jordan's elimination with scaled partial pivoting. Singular
/// equations have one that is not finite.
fn solved<T: Real, const STAGES: usize, const N: usize, const M: usize>(
    mut rows: [[Row<T, STAGES, N, M>; N]; STAGES],
) -> [[Row<T, STAGES, N, M>; N]; STAGES] {
    // 1 is small beside what is stiff, and no row has to be scaled before
    for (stage, rows) in rows.iter_mut().enumerate() {
        for (component, row) in rows.iter_mut().enumerate() {
            if let Some(own) = row.left.get_mut(stage).and_then(|left| left.get_mut(component)) {
                *own += T::ONE;
            }
            let most = row.left.as_flattened().iter().fold(T::ZERO, |most, entry| most.max(entry.abs()));
            let scale = most.recip();
            row.numbers().for_each(|number| *number *= scale);
        }
    }
    for place in (0..STAGES).flat_map(|stage| (0..N).map(move |component| (stage, component))) {
        let open = rows.as_flattened().iter().enumerate().filter(|(_, row)| row.pivot.is_none());
        let sizes = open.map(|(index, row)| (index, row.at(place).abs()));
        let largest = sizes.reduce(|best, other| if other.1 > best.1 { other } else { best });
        let Some(index) = largest.map(|(index, _)| index) else { continue };
        let Some(row) = rows.as_flattened_mut().get_mut(index) else { continue };
        row.pivot = Some(place);
        let pivot = row.at(place);
        row.numbers().for_each(|number| *number = *number / pivot);
        let mut solved = *row;
        for (_, other) in rows.as_flattened_mut().iter_mut().enumerate().filter(|(other, _)| *other != index)
        {
            let factor = other.at(place);
            for (number, taken) in other.numbers().zip(solved.numbers()) {
                *number -= factor * *taken;
            }
        }
    }
    let mut solution = [[Row::zero(); N]; STAGES];
    for row in rows.as_flattened() {
        let Some((stage, component)) = row.pivot else { continue };
        if let Some(place) = solution.get_mut(stage).and_then(|solution| solution.get_mut(component)) {
            *place = *row;
        }
    }
    solution
}

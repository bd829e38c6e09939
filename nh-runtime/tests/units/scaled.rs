//! A system in other units.

use nonholonomic::{
    AlmostPoisson, Constrained, Dim, DimOf, DiscreteLagrangian, Dynamics, Energy, EulerPoincareSuslov, Held,
    Holding, Invariants, Jacobian, Leapfrog, MatOf, ProjectionError, Real, Scalar, ScalarOf, State,
    TaylorSeries, VecOf,
};

use crate::Change;
use crate::problems::{Four, Problem};

/// Two to a power, exactly.
pub(crate) fn two<T: Scalar>(power: i32) -> T {
    T::from_f64(2.0_f64.powi(power))
}

/// A system in other units.
#[derive(Clone, Copy)]
pub(crate) struct Scaled<S: Dynamics> {
    pub(crate) system: S,
    /// τ.
    pub(crate) time: ScalarOf<S>,
    /// σ of each component.
    pub(crate) units: S::State,
    /// The unit of energies, residuals, momenta.
    pub(crate) other: ScalarOf<S>,
}

/// x times or over the units.
pub(crate) fn multiplied<X: State>(x: &X, units: &X) -> X {
    combined(x, units, |a, b| a * b)
}
pub(crate) fn divided<X: State>(x: &X, units: &X) -> X {
    combined(x, units, |a, b| a / b)
}
fn combined<X: State>(x: &X, units: &X, f: impl Fn(X::Scalar, X::Scalar) -> X::Scalar) -> X {
    let mut product = x.to_array();
    for (a, b) in product.as_mut().iter_mut().zip(units.to_array().as_ref()) {
        *a = f(*a, *b);
    }
    X::from_array(product)
}

impl<S: Dynamics> Scaled<S> {
    pub(crate) fn new(system: S, change: &Change) -> Self {
        let mut units = DimOf::<S>::vec(ScalarOf::<S>::ONE);
        for (unit, power) in units.as_mut().iter_mut().zip(change.state.iter().cycle()) {
            *unit = two(*power);
        }
        let units = S::State::from_array(units);
        Self { system, time: two(change.time), units, other: two(change.other) }
    }

    fn inner(&self, t: ScalarOf<S>, state: &S::State) -> (ScalarOf<S>, S::State) {
        (t / self.time, divided(state, &self.units))
    }

    fn unit(&self, i: usize) -> ScalarOf<S> {
        self.units.to_array().as_ref()[i]
    }
}

impl<S: Dynamics> Dynamics for Scaled<S> {
    type State = S::State;
    type Input = S::Input;

    fn derivative(&self, t: ScalarOf<S>, state: &S::State, input: &S::Input) -> S::State {
        let (t, state) = self.inner(t, state);
        let rates = self.system.derivative(t, &state, input);
        combined(&rates, &self.units, |f, unit| f * (unit / self.time))
    }
}

impl<S: Jacobian> Jacobian for Scaled<S> {
    type InputDim = S::InputDim;

    fn state_jacobian(&self, t: ScalarOf<S>, state: &S::State, input: &S::Input) -> MatOf<S> {
        let (t, state) = self.inner(t, state);
        let mut matrix = self.system.state_jacobian(t, &state, input);
        for (i, row) in matrix.as_mut().iter_mut().enumerate() {
            for (j, entry) in row.as_mut().iter_mut().enumerate() {
                *entry *= self.unit(i) / self.unit(j) / self.time;
            }
        }
        matrix
    }

    fn input_jacobian(
        &self,
        t: ScalarOf<S>,
        state: &S::State,
        input: &S::Input,
    ) -> <DimOf<S> as Dim>::Vec<<S::InputDim as Dim>::Vec<ScalarOf<S>>> {
        let (t, state) = self.inner(t, state);
        let mut matrix = self.system.input_jacobian(t, &state, input);
        for (i, row) in matrix.as_mut().iter_mut().enumerate() {
            for entry in row.as_mut() {
                *entry *= self.unit(i) / self.time;
            }
        }
        matrix
    }
}

impl<S: TaylorSeries> TaylorSeries for Scaled<S> {
    type Workspace<const P: usize> = S::Workspace<P>;

    fn expand<const P: usize>(
        &self,
        t: ScalarOf<S>,
        state: &S::State,
        input: &S::Input,
        unit: ScalarOf<S>,
        series: &mut [S::State],
        workspace: &mut S::Workspace<P>,
    ) {
        let (t, state) = self.inner(t, state);
        self.system.expand(t, &state, input, unit / self.time, series, workspace);
        for term in series {
            *term = multiplied(term, &self.units);
        }
    }
}

impl<S: Energy> Energy for Scaled<S> {
    fn energy(&self, t: ScalarOf<S>, state: &S::State) -> ScalarOf<S> {
        let (t, state) = self.inner(t, state);
        self.system.energy(t, &state) * self.other
    }
}

impl<S: Dynamics> Scaled<S> {
    /// A derivative by the components of what is measured in the other unit.
    fn covector(&self, mut covector: VecOf<S>) -> VecOf<S> {
        for (i, entry) in covector.as_mut().iter_mut().enumerate() {
            *entry *= self.other / self.unit(i);
        }
        covector
    }
}

impl<S: AlmostPoisson> AlmostPoisson for Scaled<S> {
    fn energy_gradient(&self, t: ScalarOf<S>, state: &S::State) -> VecOf<S> {
        let (t, state) = self.inner(t, state);
        self.covector(self.system.energy_gradient(t, &state))
    }

    fn almost_poisson(&self, t: ScalarOf<S>, state: &S::State, covector: &VecOf<S>) -> VecOf<S> {
        let (t, state) = self.inner(t, state);
        let mut covector = *covector;
        for (i, entry) in covector.as_mut().iter_mut().enumerate() {
            *entry *= self.unit(i) / self.other;
        }
        let mut turned = self.system.almost_poisson(t, &state, &covector);
        for (i, entry) in turned.as_mut().iter_mut().enumerate() {
            *entry *= self.unit(i) / self.time;
        }
        turned
    }
}

impl<S: Invariants> Invariants for Scaled<S> {
    type Count = S::Count;

    fn invariants(&self, t: ScalarOf<S>, state: &S::State) -> <S::Count as Dim>::Vec<ScalarOf<S>> {
        let (t, state) = self.inner(t, state);
        let mut values = self.system.invariants(t, &state);
        values.as_mut().iter_mut().for_each(|value| *value *= self.other);
        values
    }

    fn invariant_gradients(&self, t: ScalarOf<S>, state: &S::State) -> <S::Count as Dim>::Vec<VecOf<S>> {
        let (t, state) = self.inner(t, state);
        let mut gradients = self.system.invariant_gradients(t, &state);
        gradients.as_mut().iter_mut().for_each(|gradient| *gradient = self.covector(*gradient));
        gradients
    }
}

impl<S: Constrained> Constrained for Scaled<S> {
    type Constraints = S::Constraints;

    fn constraint_residual(
        &self,
        t: ScalarOf<S>,
        state: &S::State,
    ) -> <S::Constraints as Dim>::Vec<ScalarOf<S>> {
        let (t, state) = self.inner(t, state);
        let mut residual = self.system.constraint_residual(t, &state);
        residual.as_mut().iter_mut().for_each(|value| *value *= self.other);
        residual
    }

    fn project(&self, t: ScalarOf<S>, state: &mut S::State) -> Result<(), ProjectionError> {
        let (t, mut inner) = self.inner(t, state);
        self.system.project(t, &mut inner)?;
        *state = multiplied(&inner, &self.units);
        Ok(())
    }
}

/// A planet that keeps its angular momentum of 0.8, which a turn of the velocity corrects.
impl<T: Real> Holding for Scaled<Problem<T>> {
    fn held(&self, t: T, state: &Four<T>) -> Held<Four<T>> {
        let (_, Four([x, y, u, v])) = self.inner(t, state);
        let square = x * x + y * y;
        let (mut slope, mut direction) = ([v, -u, -y, x], [T::ZERO, T::ZERO, -y / square, x / square]);
        for (i, (slope, direction)) in slope.iter_mut().zip(&mut direction).enumerate() {
            *slope *= self.other / self.unit(i);
            *direction *= self.unit(i) / self.other;
        }
        Held::new([slope], [direction])
    }

    fn equations(&self, t: T, state: &Four<T>) -> [T; 4] {
        let (_, Four([x, y, u, v])) = self.inner(t, state);
        [(x * v - y * u - T::from_f64(0.8)) * self.other, T::ZERO, T::ZERO, T::ZERO]
    }
}

impl<S: Leapfrog> Leapfrog for Scaled<S> {
    fn kick(&self, state: &S::State, h: ScalarOf<S>) -> S::State {
        multiplied(&self.system.kick(&divided(state, &self.units), h / self.time), &self.units)
    }
}

/// Velocities are places over times, and constraints have the unit of energies.
impl<S: DiscreteLagrangian> DiscreteLagrangian for Scaled<S> {
    fn lagrangian_slopes(&self, state: &S::State) -> VecOf<S> {
        self.covector(self.system.lagrangian_slopes(&divided(state, &self.units)))
    }

    fn position_constraints(&self, state: &S::State) -> VecOf<S> {
        let mut left = self.system.position_constraints(&divided(state, &self.units));
        left.as_mut().iter_mut().for_each(|left| *left *= self.other);
        left
    }

    fn constrained(&self, state: &S::State, given: &VecOf<S>) -> VecOf<S> {
        let (mut inner, n) = (*given, given.as_ref().len() / 2);
        for (i, given) in inner.as_mut().iter_mut().enumerate() {
            *given *= if i < n { self.unit(n + i) } else { self.time } / self.other;
        }
        let mut change = self.system.constrained(&divided(state, &self.units), &inner);
        for (i, change) in change.as_mut().iter_mut().take(n).enumerate() {
            *change *= self.unit(n + i);
        }
        change
    }
}

impl<S: EulerPoincareSuslov> EulerPoincareSuslov for Scaled<S> {
    fn discrete_momentum(&self, state: &S::State, h: ScalarOf<S>) -> VecOf<S> {
        let mut momentum = self.system.discrete_momentum(&divided(state, &self.units), h / self.time);
        momentum.as_mut().iter_mut().for_each(|entry| *entry *= self.other);
        momentum
    }
}

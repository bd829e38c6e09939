//! A step that is refused, although its method has computed it, leaves the one before as it was: its dense output too.

use nonholonomic::methods::Interruptible;
use nonholonomic::prelude::*;
use nonholonomic::{Constrained, D, Invariants, Jacobian, Method, ProjectionError, TaylorSeries};

use crate::systems::every_kind;

/// A point that goes round, and behind a time is on the other side of a dead centre, or where no return leads back.
#[derive(Clone, Copy, Debug)]
struct Round<T> {
    until: T,
    lost: T,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Place<T>([T; 2]);

impl<T: Real> State for Place<T> {
    type Scalar = T;
    type Dim = D<2>;
    fn to_array(&self) -> [T; 2] {
        self.0
    }
    fn from_array(x: [T; 2]) -> Self {
        Self(x)
    }
    fn names() -> [&'static str; 2] {
        ["x", "y"]
    }
}

impl<T: Real> Dynamics for Round<T> {
    type State = Place<T>;
    type Input = ();
    fn derivative(&self, _t: T, Place([x, y]): &Place<T>, (): &()) -> Place<T> {
        Place([*y, -*x])
    }
    fn has_positions(&self) -> bool {
        true
    }
    fn return_to_positions(&self, t: T, _state: &mut Place<T>) -> Result<T, ProjectionError> {
        if t > self.lost { Err(ProjectionError { iterations: 1, residual: 1.0 }) } else { Ok(T::ZERO) }
    }
    fn side(&self, t: T, _state: &Place<T>) -> T {
        if t > self.until { -T::ONE } else { T::ONE }
    }
}

impl<T: Real> Jacobian for Round<T> {
    type InputDim = D<0>;
    fn state_jacobian(&self, _t: T, _state: &Place<T>, (): &()) -> [[T; 2]; 2] {
        [[T::ZERO, T::ONE], [-T::ONE, T::ZERO]]
    }
    fn input_jacobian(&self, _t: T, _state: &Place<T>, (): &()) -> [[T; 0]; 2] {
        [[]; 2]
    }
}

impl<T: Real> TaylorSeries for Round<T> {
    type Workspace<const P: usize> = ();
    fn expand<const P: usize>(
        &self,
        _t: T,
        state: &Place<T>,
        (): &(),
        unit: T,
        series: &mut [Place<T>],
        (): &mut (),
    ) {
        let (mut term, mut order) = (*state, T::ZERO);
        for place in series {
            *place = term;
            order += T::ONE;
            let Place([x, y]) = term;
            term = Place([y * unit / order, -x * unit / order]);
        }
    }
}

impl<T: Real> Invariants for Round<T> {
    type Count = D<1>;
    fn invariants(&self, _t: T, Place([x, y]): &Place<T>) -> [T; 1] {
        [*x * *x + *y * *y]
    }
    fn invariant_gradients(&self, _t: T, Place([x, y]): &Place<T>) -> [[T; 2]; 1] {
        [[*x + *x, *y + *y]]
    }
}

impl<T: Real> Constrained for Round<T> {
    type Constraints = D<1>;
    fn constraint_residual(&self, _t: T, _state: &Place<T>) -> [T; 1] {
        [T::ZERO]
    }
    fn project(&self, _t: T, _state: &mut Place<T>) -> Result<(), ProjectionError> {
        Ok(())
    }
}

/// Goes on until a step leads past the dead centre.
fn law<T: Real>(name: &str, method: impl Method<Round<T>> + Clone) {
    let system = Round { until: T::from_f64(2.0), lost: T::from_f64(f64::INFINITY) };
    let mut sim = Integrator::new(system, method, T::ZERO, Place([T::ZERO, T::ONE]));
    let mut before = T::ZERO;
    loop {
        // not the middle, where an error may vanish
        let within = before + (sim.time() - before) * T::from_f64(0.375);
        let given = sim.at(within).unwrap_or_else(|error| panic!("{name}: {error}"));
        let (time, state) = (sim.time(), *sim.state());
        match sim.step() {
            Ok(()) => before = time,
            Err(IntegrationError::DeadCentre { .. }) => {
                assert_eq!((sim.time(), sim.state()), (time, &state), "{name}");
                let again = sim.at(within).unwrap_or_else(|error| panic!("{name}: {error}"));
                let off = |i: usize| (again.0[i] - given.0[i]).to_f64().abs();
                // what is left of a step may be its cubic
                assert!(off(0) < 1e-3 && off(1) < 1e-3, "{name}: {again:?} {given:?}");
                break;
            }
            Err(error) => panic!("{name}: {error}"),
        }
    }
    assert!(before > T::ZERO, "{name}: one step at most");
    // and it goes on from there
    let nearer = sim.time() + (system.until - sim.time()) * T::from_f64(0.5);
    sim.advance_to(nearer).unwrap_or_else(|error| panic!("{name}: {error}"));
    let (sin, cos) = nearer.sin_cos();
    let off = [sim.state().0[0] - sin, sim.state().0[1] - cos].map(|off| off.to_f64().abs());
    assert!(off[0] < 1e-2 && off[1] < 1e-2, "{name}: {off:?}");
}

fn all<T: Real>() {
    every_kind!(law::<T>, T::from_f64(0.1));
    macro_rules! call {
        ($($method:expr;)*) => {$(law::<T>(stringify!($method), $method);)*};
    }
    call! {
        Taylor::new();
        Taylor::<T, 8>::of_order(6);
        Interruptible::new(Dopri5::new(), |_: &Statistics| true);
        Projected::new(Dopri5::new(), 2);
        Projected::new(Taylor::new(), 2);
        Conserving::new(Dopri5::new());
        Conserving::new(Taylor::new());
        Conserving::new(Rk4::new(T::from_f64(0.1)));
    }
}

#[test]
fn a_step_past_a_dead_centre_leaves_nothing_behind() {
    all::<f64>();
    all::<f32>();
}

/// What rounding took from the end of a step that is refused is not carried on.
#[test]
fn a_refused_step_carries_no_rounding_on() {
    for system in [Round { until: 0.5, lost: f64::INFINITY }, Round { until: f64::INFINITY, lost: 0.5 }] {
        let run = |ends: &[f64]| {
            let start = Place([0.8, 0.7]);
            let mut sim = Integrator::new(system, Rk4::new(1.0).compensated(), 0.0, start);
            let refused = ends.iter().filter(|end| sim.step_towards(**end).is_err()).count();
            (refused, sim.state().0.map(f64::to_bits))
        };
        let (none, state) = run(&[0.25]);
        assert_eq!(none, 0, "{system:?}");
        assert_eq!(run(&[1.0, 0.25]), (1, state), "{system:?}");
    }
}

//! The law over derivatives of motions: ∂x_i/∂x_k(0) goes with σ_i/σ_k.

use core::ops::ControlFlow;

use nonholonomic::methods::{DormandPrince8, Fixed, Kutta4, Method, PerComponent, Tableau};
use nonholonomic::nalgebra::SMatrix;
use nonholonomic::prelude::*;
use nonholonomic::sensitivity::{
    Adjoint, By, Checkpoint, ColumnTolerance, Jumps, LinearizedStep, NoParameters, Objective, PulledBack,
    Slope, Variational, WithColumns, advance_across,
};

use crate::problems::{Four, Kind, Problem};
use crate::scaled::{Scaled, multiplied};
use crate::{Change, Part, Verdict, changes};

type Tried = Scaled<Problem<f64>>;
type Motion = Variational<Tried, NoParameters<Tried, f64, 4>, 2>;

/// What a trial gives, in the units of the motion itself.
#[derive(Clone, PartialEq, Debug, Default)]
struct Told {
    numbers: Vec<f64>,
    cost: String,
}

impl Told {
    fn columns(&mut self, columns: &[Four<f64>; 2], [a, b, c, d]: [f64; 4]) {
        for (column, by) in columns.iter().zip([a, c]) {
            let units = [a, b, c, d].map(|unit| unit / by);
            self.numbers.extend(column.0.iter().zip(units).map(|(x, unit)| x / unit));
        }
    }
    fn state(&mut self, state: &Four<f64>, units: [f64; 4]) {
        self.numbers.extend(state.0.iter().zip(units).map(|(x, unit)| x / unit));
    }
}

/// One system in the units of a run.
struct Run {
    system: Tried,
    start: Four<f64>,
    from: f64,
    to: f64,
    step: f64,
}

impl Run {
    fn new(kind: Kind, change: &Change) -> Self {
        let problem = Problem::<f64>::new(kind);
        let system = Scaled::new(problem, change);
        let (course, step) = problem.course();
        let tau = system.time;
        let to = (course.from + 40.0 * step) * tau;
        let start = multiplied(&course.start, &system.units);
        Self { system, start, from: course.from * tau, to, step: step * tau }
    }

    fn motion(&self) -> (Motion, WithColumns<Four<f64>, 2>) {
        let motion = Variational::new(self.system, [By::Start(0), By::Start(2)]);
        (motion, motion.start(&self.start).unwrap())
    }

    fn tolerance(&self) -> ColumnTolerance<f64, PerComponent<Four<f64>>, PerComponent<Four<f64>>, 2> {
        let negligible = multiplied(&self.system.system.negligible(), &self.system.units);
        let [a, _, c, _] = self.system.units.0;
        let each = PerComponent::of(Four([1e-6, 1e-5, 1e-6, 1e-7]), negligible);
        ColumnTolerance::of_both(each, each).sizes([a, c])
    }
}

fn forwards<A: Method<Motion>>(kind: Kind, change: &Change, method: impl Fn(&Run) -> A) -> Told {
    let run = Run::new(kind, change);
    let (motion, start) = run.motion();
    let mut sim = Integrator::new(motion, method(&run), run.from, start);
    let mut told = Told::default();
    sim.advance_to(run.to).unwrap();
    told.state(&sim.state().state, run.system.units.0);
    told.columns(&sim.state().columns, run.system.units.0);
    told.cost = format!("{:?}", sim.statistics());
    told
}

fn along<A: Method<Tried> + LinearizedStep<f64>>(
    kind: Kind,
    change: &Change,
    method: impl Fn(&Run) -> A,
) -> Told {
    let run = Run::new(kind, change);
    let (motion, start) = run.motion();
    let mut columns = start.columns;
    let mut sim = Integrator::new(run.system, method(&run), run.from, start.state);
    let mut told = Told::default();
    motion.advance(&mut sim, run.to, &mut columns).unwrap();
    told.state(sim.state(), run.system.units.0);
    told.columns(&columns, run.system.units.0);
    told
}

/// g = x₀ and ℓ = x₀ per unit of time.
struct First {
    tau: f64,
}

impl Objective<Tried, 4, 0> for First {
    fn running(&self, _tick: usize, _t: f64, x: &Four<f64>, (): &()) -> Slope<f64, 4, 0> {
        let share = 1.0 / self.tau;
        Slope { value: x.0[0] * share, by_state: [share, 0.0, 0.0, 0.0], by_input: [] }
    }
    fn end(&self, _t: f64, x: &Four<f64>) -> Slope<f64, 4, 0> {
        Slope { value: x.0[0], by_state: [1.0, 0.0, 0.0, 0.0], by_input: [] }
    }
}

fn backwards<P: Tableau>(kind: Kind, change: &Change) -> Told {
    let run = Run::new(kind, change);
    let units = run.system.units.0;
    let mut room = [Checkpoint::room(run.start); 5];
    let found = Adjoint::new(&run.system, Fixed::<P, f64>::new(run.step))
        .gradient(run.from, &run.start, &[(); 40], &First { tau: run.system.time }, &mut room, &mut [[]; 40])
        .unwrap();
    let mut told = Told::default();
    told.state(&found.end, units);
    told.numbers.push(found.value / units[0]);
    told.numbers.extend(found.by_start.iter().zip(units).map(|(x, unit)| x / (units[0] / unit)));
    let back: PulledBack<_, f64, 4, 0> = Fixed::<P, f64>::pulled_back_step(
        &run.system,
        run.from,
        run.step,
        &run.start,
        &(),
        |_| units.map(|unit| 1.0 / unit),
        |_, _, ()| SMatrix::zeros(),
    );
    told.numbers.extend(back.by_state.iter().zip(units).map(|(x, unit)| x * unit));
    told
}

/// The first component turns back at 0.1 of its unit, with half of the second.
struct Floor([f64; 4]);

impl Jumps<4, 2, 1> for Floor {
    fn events<A: Scalar>(&self, _t: A, x: &[A; 4], _by: &[A; 2]) -> [A; 1] {
        [x[0] - A::from_f64(0.1 * self.0[0])]
    }
    fn reset<A: Scalar>(&self, _event: usize, _t: A, [a, b, c, d]: &[A; 4], _by: &[A; 2]) -> [A; 4] {
        [*a, -A::from_f64(0.5) * *b, *c, *d]
    }
}

fn across(kind: Kind, change: &Change) -> Told {
    let run = Run::new(kind, change);
    let units = run.system.units.0;
    let (motion, start) = run.motion();
    let mut sim = Integrator::new(motion, Dopri5::new().tolerance(run.tolerance()), run.from, start);
    let mut told = Told::default();
    let mut jumps = 0;
    advance_across(&mut sim, run.to, &Floor(units), |jump| {
        jumps += 1;
        told.numbers.push(jump.time / run.system.time);
        ControlFlow::Continue(())
    })
    .unwrap();
    assert!(jumps > 0);
    told.state(&sim.state().state, units);
    told.columns(&sim.state().columns, units);
    told
}

#[test]
fn derivatives_of_motions() {
    let mut verdict = Verdict::default();
    let plain = Change { part: Part::Time, time: 0, state: [0; 4], other: 0 };
    let mut each = |name: &str, kinds: &[Kind], apart: bool, trial: &dyn Fn(Kind, &Change) -> Told| {
        for &kind in kinds {
            let expected = trial(kind, &plain);
            for change in changes(false).iter().filter(|change| apart || change.part != Part::EachComponent) {
                let found = trial(kind, change);
                let detail = (found != expected).then(|| format!("{kind:?}: {found:?} {expected:?}"));
                verdict.note(name, change.part, detail);
            }
        }
    };
    let all = [Kind::Pendulum, Kind::Kepler, Kind::Rest, Kind::Robertson];
    each("Variational, ColumnTolerance", &all, true, &|kind, change| {
        forwards(kind, change, |run| Dopri5::new().tolerance(run.tolerance()))
    });
    each("Variational, of_state", &all, true, &|kind, change| {
        forwards(kind, change, |run| {
            let each = multiplied(&run.system.system.negligible(), &run.system.units);
            let each = PerComponent::of(Four([1e-6; 4]), each);
            Dop853::new().tolerance(ColumnTolerance::of_state(each))
        })
    });
    each("Variational, fixed", &all, true, &|kind, change| forwards(kind, change, |run| Rk4::new(run.step)));
    each("Variational::advance, explicit", &all, true, &|kind, change| {
        along(kind, change, |run| Rk4::new(run.step))
    });
    each("Variational::advance, midpoint", &all, false, &|kind, change| {
        along(kind, change, |run| ImplicitMidpoint::new(run.step).with_jacobian())
    });
    each("Variational::advance, Radau5", &all, false, &|kind, change| {
        along(kind, change, |run| Radau5::new().rtol(1e-6).atol(1e-7 * run.system.units.0[0]).with_jacobian())
    });
    each("Adjoint, Rk4", &all, true, &backwards::<Kutta4>);
    each("Adjoint, Dop853", &all, true, &backwards::<DormandPrince8>);
    each("advance_across", &[Kind::Pendulum], true, &across);
    verdict.judge();
}

//! What it costs to stay where position constraints hold, counted in runs, and what is kept by it.

use std::cell::{Cell, RefCell};
use std::hint::black_box;
use std::time::Instant;

use nonholonomic::prelude::*;
use nonholonomic::{Method, ProjectionError, Real, ScalarOf, StateFault};

use super::loops::{LINKAGE, start};

/// A mass on a rope.
#[nonholonomic(
    base { x, y }
    holonomic { rope: x^2 + y^2 = l^2; }
    lagrangian { (der(x)^2 + der(y)^2) / 2 - g * y }
)]
#[derive(Clone, Copy, Debug)]
struct Swing<T> {
    l: T,
    g: T,
}

/// A crank whose rod pushes a slide: dead centres at both ends of the stroke.
#[nonholonomic(
    base { crank, rod, slide }
    holonomic {
        along: slide = r * cos(crank) + l * cos(rod);
        across: r * sin(crank) = l * sin(rod);
    }
    lagrangian {
        J / 2 * der(crank)^2 + m / 2 * der(slide)^2
            + kinetic(M, M * l^2 / 12, [r * cos(crank) + l / 2 * cos(rod), l / 2 * sin(rod)], rod)
    }
    units { crank, rod = rad; slide, r, l = m; m, M = kg; J = kg m^2; }
)]
#[derive(Clone, Copy, Debug)]
struct SliderCrank {
    r: f64,
    l: f64,
    J: f64,
    m: f64,
    M: f64,
}

nh_models::bicycle! {
    #[derive(Clone, Copy, Debug)]
    pub(crate) struct Bicycle<T>;
}

/// A system that counts what is asked of it, and remembers the first states that were to be returned.
struct Counted<S: Dynamics> {
    system: S,
    derivatives: Cell<u64>,
    returns: Cell<u64>,
    returned: RefCell<Vec<(ScalarOf<S>, S::State)>>,
}

/// How many states are remembered.
const REMEMBERED: usize = 4096;

impl<S: Dynamics> Dynamics for Counted<S> {
    type State = S::State;
    type Input = S::Input;

    fn derivative(&self, t: ScalarOf<S>, state: &S::State, input: &S::Input) -> S::State {
        self.derivatives.set(self.derivatives.get() + 1);
        self.system.derivative(t, state, input)
    }
    fn has_positions(&self) -> bool {
        self.system.has_positions()
    }
    fn return_to_positions(
        &self,
        t: ScalarOf<S>,
        state: &mut S::State,
    ) -> Result<ScalarOf<S>, ProjectionError> {
        self.returns.set(self.returns.get() + 1);
        let mut returned = self.returned.borrow_mut();
        if returned.len() < REMEMBERED {
            returned.push((t, *state));
        }
        self.system.return_to_positions(t, state)
    }
    fn correct_positions(&self, t: ScalarOf<S>, state: &mut S::State) {
        self.system.correct_positions(t, state);
    }
    fn side(&self, t: ScalarOf<S>, state: &S::State) -> ScalarOf<S> {
        self.system.side(t, state)
    }
    fn worst_constraint(&self, t: ScalarOf<S>, state: &S::State) -> StateFault {
        self.system.worst_constraint(t, state)
    }
}

/// The least time of some runs, in seconds.
fn least(mut run: impl FnMut()) -> f64 {
    let time = |_| {
        let start = Instant::now();
        run();
        start.elapsed().as_secs_f64()
    };
    (0..30).map(time).fold(f64::INFINITY, f64::min)
}

/// A line of the table: a run to a time by a method with so many stages a step, looked at a thousand times.
#[allow(clippy::cast_precision_loss)] // counts
fn line<S, M>(name: &str, system: S, (method, stages): (M, u64), start: S::State, end: f64)
where
    S: Constrained<Input = ()> + Energy + Copy,
    M: for<'a> Method<&'a Counted<S>>,
    ScalarOf<S>: Real,
{
    let [derivatives, returns] = [Cell::new(0), Cell::new(0)];
    let counted = Counted { system, derivatives, returns, returned: RefCell::default() };
    let mut sim = Integrator::new(&counted, method, ScalarOf::<S>::ZERO, start);
    let energy = system.energy(ScalarOf::<S>::ZERO, &start).to_f64();
    let (mut open, mut lost) = (0.0_f64, 0.0_f64);
    for part in 1..=1000 {
        let time = ScalarOf::<S>::from_f64(end * f64::from(part) / 1000.0);
        if let Err(error) = sim.advance_to(time) {
            println!("{name:32} {error}");
            return;
        }
        let left = system.constraint_residual(time, sim.state());
        open = left.as_ref().iter().map(|left| left.to_f64().abs()).fold(open, f64::max);
        lost = lost.max((system.energy(time, sim.state()).to_f64() / energy - 1.0).abs());
    }
    let statistics = sim.statistics();
    let returned = counted.returned.borrow();
    let derivative = least(|| {
        for (t, state) in returned.iter() {
            black_box(system.derivative(*t, black_box(state), &()));
        }
    });
    let back = least(|| {
        for (t, state) in returned.iter() {
            let mut state = *black_box(state);
            _ = black_box(system.return_to_positions(*t, &mut state));
            black_box(state);
        }
    });
    let own = stages * (statistics.steps + statistics.rejected) + 1;
    let renewed = counted.derivatives.get().saturating_sub(own) as f64 / statistics.steps as f64;
    let returns = counted.returns.get() as f64 / statistics.steps as f64;
    let each = 1e9 / returned.len() as f64;
    println!(
        "{name:32} {:>8} {returns:8.2} {renewed:8.2} {:8.2} {:8.2} {:6.0} {:6.0} {open:10.1e} {lost:10.1e}",
        statistics.steps,
        back / derivative,
        returns * back / derivative + renewed,
        back * each,
        derivative * each,
    );
}

/// A mass on 250 m of rope, let go a radian from the vertical.
fn swing<T: Scalar>() -> (Swing<T>, SwingState<T>) {
    let (sin, cos) = 1.0_f64.sin_cos();
    let [l, x, y] = [250.0, 250.0 * sin, -250.0 * cos].map(T::from_f64);
    (Swing { l, g: T::from_f64(9.81) }, SwingState { x, y, x_dot: T::ZERO, y_dot: T::ZERO })
}

/// Runs of what has loops and contacts.
pub(crate) fn table() {
    println!("Returns to position constraints: by Dopri5 at rtol = atol = 1e-6 but for the last\n");
    println!(
        "{:32} {:>8} {:>8} {:>8} {:>8} {:>8} {:>6} {:>6} {:>10} {:>10}",
        "", "steps", "returns", "renewed", "return", "per step", "ns", "stage", "open", "energy"
    );
    let dopri5 = || (Dopri5::new().rtol(1e-6).atol(1e-6), 6);
    line("four-bar at 20 rad/s, 500 s", LINKAGE, dopri5(), start(), 500.0);
    let (system, rest) = swing::<f64>();
    line("pendulum in x and y, 1e5 s", system, dopri5(), rest, 1e5);
    let machine = SliderCrank { r: 0.3, l: 0.8, J: 0.05, m: 0.4, M: 0.2 };
    let rough = SliderCrankState { crank: 0.3, crank_dot: 30.0, slide: 1.0, ..Default::default() };
    let turning = machine.assemble_holding(0.0, &rough, &[SliderCrankCoordinate::crank]);
    line("slider crank at 30 rad/s, 100 s", machine, dopri5(), turning.expect("a crank turns"), 100.0);
    let bicycle: Bicycle<f64> = nh_models::published_bicycle!(Bicycle, 9.81, f64::from);
    let mut pushed = BicycleState { rear_dot: -4.6 / 0.3, lean_dot: 0.3, ..Default::default() };
    bicycle.project(0.0, &mut pushed).expect("it stands on its wheels");
    line("bicycle at 4.6 m/s, 1000 s", bicycle, dopri5(), pushed, 1000.0);
    let (system, rest) = swing::<f32>();
    let single = (Dopri5::new().rtol(1e-4).atol(1e-4), 6);
    line("pendulum in f32 at 1e-4, 1000 s", system, single, rest, 1000.0);
    println!();
}

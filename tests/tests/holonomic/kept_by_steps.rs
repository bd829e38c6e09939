//! Steps that keep position constraints by themselves, mathematics (37) and (38): discrete gradients keep the energy with
//! all constraints, a symmetric projection keeps the constraints and is reversible.

use nonholonomic::methods::Interruptible;
use nonholonomic::prelude::*;

/// A mass on a rod.
#[nonholonomic(
    base { x, y }
    holonomic { rod: x^2 + y^2 = l^2; }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - m * g * y }
    emit { discrete_gradient, symmetric_projection }
)]
#[derive(Clone, Copy, Debug)]
struct Rod {
    m: f64,
    g: f64,
    l: f64,
}
const ROD: Rod = Rod { m: 0.7, g: 9.81, l: 1.3 };

/// The same with one velocity in the state.
#[nonholonomic(
    base { x, y }
    holonomic { rod: x^2 + y^2 = l^2; }
    independent { der(x) }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - m * g * y }
    emit { discrete_gradient, symmetric_projection }
)]
#[derive(Clone, Copy, Debug)]
struct Hanging {
    m: f64,
    g: f64,
    l: f64,
}

/// A particle on a cylinder over a sphere, with a nonholonomic constraint beside.
#[nonholonomic(
    base { x, y, z, w }
    holonomic { sphere: x^2 + y^2 + w^2 = 1; }
    constraints { contact: der(z) = y * der(x); }
    lagrangian { (der(x)^2 + der(y)^2 + der(z)^2 + 2 * der(w)^2) / 2 - (x^2 + 3 * y * w + cos(z)) / 2 }
    emit { discrete_gradient, symmetric_projection }
)]
#[derive(Clone, Copy, Debug)]
struct Mixed;

/// A spring swings on a hoop that moves, with friction: neither scleronomic nor conservative.
#[nonholonomic(
    base { x, y }
    holonomic { hoop: x^2 + (y - a * sin(t))^2 = 1; }
    lagrangian { (der(x)^2 + der(y)^2) / 2 - k / 2 * (x - 1)^2 }
    forces { x: -c * der(x); y: -c * der(y); }
    emit { symmetric_projection }
)]
#[derive(Clone, Copy, Debug)]
struct Hoop {
    a: f64,
    k: f64,
    c: f64,
}

const fn rod() -> RodState {
    RodState { x: 1.3, y: 0.0, x_dot: 0.0, y_dot: 0.4 }
}

fn mixed() -> MixedState {
    let mut state =
        MixedState { x: 0.6, y: 0.0, z: 0.3, w: 0.8, x_dot: 0.8, y_dot: 0.5, z_dot: 0.0, w_dot: -0.6 };
    Mixed.project(0.0, &mut state).unwrap();
    state
}

/// The largest error of the energy, and the largest residual, after every step of a run.
fn kept<S, M>(system: S, method: M, start: S::State, steps: usize) -> (f64, f64, S::State)
where
    S: Energy<Input = ()> + Holding + Copy,
    S::State: State<Scalar = f64>,
    M: nonholonomic::Method<S>,
{
    kept_of(system, method, start, steps, |t, state| system.equations(t, state))
}

/// The same, with these residuals.
pub(super) fn kept_of<S, M, R>(
    system: S,
    method: M,
    start: S::State,
    steps: usize,
    residuals: impl Fn(f64, &S::State) -> R,
) -> (f64, f64, S::State)
where
    S: Energy<Input = ()> + Copy,
    S::State: State<Scalar = f64>,
    M: nonholonomic::Method<S>,
    R: AsRef<[f64]>,
{
    let energy = system.energy(0.0, &start);
    let mut sim = Integrator::new(system, method, 0.0, start);
    let (mut worst, mut open) = (0.0_f64, 0.0_f64);
    for _ in 0..steps {
        sim.step().unwrap();
        let (t, state) = (sim.time(), sim.state());
        worst = worst.max((system.energy(t, state) - energy).abs());
        open = residuals(t, state).as_ref().iter().fold(open, |open, residual| open.max(residual.abs()));
    }
    (worst, open, *sim.state())
}

#[test]
fn discrete_gradients_keep_the_energy_and_all_constraints() {
    for h in [0.02, 0.1] {
        let (energy, open, _) = kept(ROD, DiscreteGradient::new(h), rod(), 2000);
        assert!(energy < 3e-14 && open < 1e-14, "{h}: {energy:e} {open:e}");
        let (energy, open, _) = kept(Mixed, DiscreteGradient::new(h), mixed(), 2000);
        assert!(energy < 1e-14 && open < 1e-14, "{h}: {energy:e} {open:e}");
    }
    // with one velocity the rod must not pass where that does not determine the other
    let hanging = Hanging { m: 0.7, g: 9.81, l: 1.3 };
    let start = HangingState { x: 0.5, y: -1.2, x_dot: 0.3 };
    let (energy, open, _) = kept(hanging, DiscreteGradient::new(0.05), start, 2000);
    assert!(energy < 3e-14 && open < 1e-14, "{energy:e} {open:e}");
}

#[test]
fn their_order_is_two() {
    fn at_the_end<S: Dynamics<Input = ()> + Copy, M: nonholonomic::Method<S>>(
        system: S,
        method: M,
        start: S::State,
    ) -> <<S::State as State>::Dim as nonholonomic::Dim>::Vec<f64>
    where
        S::State: State<Scalar = f64>,
    {
        let mut sim = Integrator::new(system, method, 0.0, start);
        sim.advance_to(1.5).unwrap();
        sim.state().to_array()
    }
    fn distance(a: &[f64], b: &[f64]) -> f64 {
        a.iter().zip(b).fold(0.0, |most, (a, b)| most.max((a - b).abs()))
    }
    let exact = at_the_end(ROD, Dop853::new().rtol(1e-13).atol(1e-13), rod());
    let by_energy = [0.02, 0.01].map(|h| distance(&at_the_end(ROD, DiscreteGradient::new(h), rod()), &exact));
    let by_symmetry = [0.02, 0.01].map(|h| {
        distance(&at_the_end(ROD, ImplicitMidpoint::new(h).symmetrically_projected(), rod()), &exact)
    });
    let composed = [0.04, 0.02].map(|h| {
        let method = ImplicitMidpoint::new(h).symmetrically_projected().fourth_order();
        distance(&at_the_end(ROD, method, rod()), &exact)
    });
    for ([coarse, fine], order) in [(by_energy, 4.0), (by_symmetry, 4.0), (composed, 16.0)] {
        assert!(coarse < 2e-2 && (0.8..1.2).contains(&(coarse / fine / order)), "{coarse:e} {fine:e}");
    }
    let exact = at_the_end(Mixed, Dop853::new().rtol(1e-13).atol(1e-13), mixed());
    let [coarse, fine] =
        [0.02, 0.01].map(|h| distance(&at_the_end(Mixed, DiscreteGradient::new(h), mixed()), &exact));
    assert!(coarse < 1e-3 && (3.2..4.8).contains(&(coarse / fine)), "{coarse:e} {fine:e}");
    let hoop = Hoop { a: 0.3, k: 4.0, c: 0.1 };
    let start = HoopState { x: 0.0, y: 1.0, x_dot: 0.2, y_dot: 0.3 };
    let exact = at_the_end(hoop, Dop853::new().rtol(1e-13).atol(1e-13), start);
    let [coarse, fine] = [0.02, 0.01].map(|h| {
        distance(&at_the_end(hoop, ImplicitMidpoint::new(h).symmetrically_projected(), start), &exact)
    });
    assert!(coarse < 1e-3 && (3.2..4.8).contains(&(coarse / fine)), "{coarse:e} {fine:e}");
}

#[test]
fn symmetric_projection_is_reversible_and_keeps_the_energy_in_a_band() {
    let method = || ImplicitMidpoint::new(0.05).symmetrically_projected();
    // there, and back with the velocities turned round
    let (_, open, there) = kept(ROD, method(), rod(), 400);
    let turned = RodState { x_dot: -there.x_dot, y_dot: -there.y_dot, ..there };
    let (_, _, back) = kept(ROD, method(), turned, 400);
    let start = rod();
    let missed = [back.x - start.x, back.y - start.y, back.x_dot + start.x_dot, back.y_dot + start.y_dot];
    assert!(missed.iter().all(|off| off.abs() < 1e-9), "{missed:?}");
    assert!(open < 1e-13, "{open:e}");
    // what is a hundred times as long errs no more
    let (soon, _, _) = kept(ROD, method(), rod(), 400);
    let (late, open, _) = kept(ROD, method(), rod(), 40_000);
    assert!(late < 1.05 * soon && open < 1e-13, "{soon:e} {late:e} {open:e}");
    let (_, open, _) = kept(
        Hoop { a: 0.3, k: 4.0, c: 0.1 },
        method(),
        HoopState { x: 0.0, y: 1.0, x_dot: 0.2, y_dot: 0.3 },
        400,
    );
    assert!(open < 1e-13, "{open:e}");
}

/// A step that ends on the constraints is not returned to them, whatever the method is wrapped in: what a return moves is
/// what the wrapper has kept of the rounding, and of the energy.
#[test]
fn wrapped_methods_are_left_where_their_steps_end() {
    fn law<M: nonholonomic::Method<Rod> + Copy>(name: &str, method: M, energy: f64) {
        let mut sim = Integrator::new(ROD, method, 0.0, rod());
        sim.advance_to(2.0).unwrap();
        assert_eq!(sim.statistics().projections, 0, "{name}");
        let (off, open, _) = kept(ROD, method, rod(), 2000);
        assert!(off < energy && open < 1e-13, "{name}: {off:e} {open:e}");
    }
    let on = |_: &Statistics| true;
    let by_energy = DiscreteGradient::new(0.05);
    let by_symmetry = ImplicitMidpoint::new(0.02).symmetrically_projected();
    law("discrete gradient", by_energy, 1e-13);
    law("discrete gradient, compensated", by_energy.compensated(), 1e-13);
    law("discrete gradient, interruptible", Interruptible::new(by_energy.compensated(), on), 1e-13);
    law("of order 4, compensated", by_energy.fourth_order().compensated(), 1e-13);
    let (band, _, _) = kept(ROD, by_symmetry, rod(), 400);
    law("symmetric projection, compensated", by_symmetry.compensated(), 1.05 * band);
    law("the same of order 4", by_symmetry.fourth_order().compensated(), band);
}

/// A rod over numbers of any kind.
#[nonholonomic(
    base { x, y }
    holonomic { rod: x^2 + y^2 = l^2; }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - m * g * y }
    emit { discrete_gradient, symmetric_projection, prepared, jacobian }
)]
#[derive(Clone, Copy, Debug)]
struct AnyRod<T> {
    m: T,
    g: T,
    l: T,
}

#[test]
fn single_precision_prepared_systems_and_units_make_no_difference() {
    let rod = AnyRod { m: 1.0_f32, g: 9.81, l: 1.0 };
    let start = AnyRodState { x: 1.0_f32, y: 0.0, x_dot: 0.0, y_dot: 0.4 };
    let mut plain = Integrator::new(rod, DiscreteGradient::new(0.02), 0.0, start);
    plain.advance_to(100.0).unwrap();
    let mut prepared =
        Integrator::new(rod.prepare(), DiscreteGradient::new(0.02).with_jacobian().compensated(), 0.0, start);
    prepared.advance_to(100.0).unwrap();
    for state in [plain.state(), prepared.state()] {
        assert!((rod.energy(0.0, state) - rod.energy(0.0, &start)).abs() < 4e-6, "{state:?}");
        assert!((state.x.hypot(state.y) - 1.0).abs() < 4e-7, "{state:?}");
    }
    let places = [(1.0, 1.0), (1e-100, 1.0), (1e100, 1e20), (1.0, 1e-50)].map(|(size, time)| {
        let rod = AnyRod { m: 1.0, g: 9.81 * size / time / time, l: size };
        let start = AnyRodState { x: size, y: 0.0, x_dot: 0.0, y_dot: 0.4 * size / time };
        let mut by_energy = Integrator::new(rod, DiscreteGradient::new(0.02 * time), 0.0, start);
        by_energy.advance_to(10.0 * time).unwrap();
        let method = ImplicitMidpoint::new(0.02 * time).symmetrically_projected();
        let mut by_symmetry = Integrator::new(rod, method, 0.0, start);
        by_symmetry.advance_to(10.0 * time).unwrap();
        [by_energy.state().x / size, by_symmetry.state().x / size]
    });
    let [first, others @ ..] = places;
    for other in others {
        assert!(first.iter().zip(other).all(|(a, b)| (a - b).abs() < 1e-12), "{first:?} {other:?}");
    }
    // what rests stays, also where it may fall
    for y in [-1.0, 1.0] {
        let rod = AnyRod { m: 1.0, g: 9.81, l: 1.0 };
        let start = AnyRodState { x: 0.0, y, x_dot: 0.0, y_dot: 0.0 };
        let mut sim = Integrator::new(rod, DiscreteGradient::new(0.02), 0.0, start);
        sim.advance_to(10.0).unwrap();
        assert_eq!(*sim.state(), start);
    }
}

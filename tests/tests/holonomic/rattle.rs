//! Steps with a discrete Lagrangian and position constraints, mathematics (62): symplectic, reversible, on the constraints.

use nonholonomic::DiscreteLagrangian;
use nonholonomic::prelude::*;

use super::four_bar::LENGTHS;
use super::kept_by_steps::kept_of;

/// A four-bar linkage whose masses change along the motion.
#[nonholonomic(
    base { a, b, c }
    let along(angle) = [cos(angle), sin(angle)];
    holonomic { closure: l[0] * along(a) + l[1] * along(b) = l[2] * along(c) + [l[3], 0]; }
    lagrangian {
        J[0] / 2 * der(a)^2 + kinetic(m, J[1], l[0] * along(a) + l[1] / 2 * along(b), b) + J[2] / 2 * der(c)^2
            - k / 2 * sin(a)^2
    }
    emit { rattle }
)]
#[derive(Clone, Copy, Debug)]
struct FourBar {
    l: [f64; 4],
    m: f64,
    J: [f64; 3],
    k: f64,
}
const LINKAGE: FourBar = FourBar { l: LENGTHS, m: 1.0, J: [0.1, 0.3, 0.4], k: 3.0 };

fn turning() -> FourBarState {
    let rough = FourBarState { a: 0.2, b: 0.9, c: 1.6, a_dot: 20.0, ..Default::default() };
    LINKAGE.assemble_holding(0.0, &rough, &[FourBarCoordinate::a]).unwrap()
}

/// A mass on a rod in space, which turns about the vertical.
#[nonholonomic(
    base { x, y, z }
    holonomic { rod: x^2 + y^2 + z^2 = l^2; }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) - m * g * z }
    emit { rattle }
)]
#[derive(Clone, Copy, Debug)]
struct Rod {
    m: f64,
    g: f64,
    l: f64,
}
const ROD: Rod = Rod { m: 0.7, g: 9.81, l: 1.3 };

fn hanging() -> RodState {
    let mut state = RodState { x: 0.5, y: 0.0, z: -1.2, x_dot: 0.3, y_dot: 1.1, z_dot: 0.2 };
    ROD.project(0.0, &mut state).unwrap();
    state
}

/// Two links without any constraint, in angles, with a term linear in the rates: a charge in a field.
#[nonholonomic(
    base { p, q }
    lagrangian {
        (3 * der(p)^2 + 2 * cos(p - q) * der(p) * der(q) + 2 * der(q)^2) / 2 + sin(q) * der(p) / 5
            + g * (2 * cos(p) + cos(q))
    }
    emit { rattle }
)]
#[derive(Clone, Copy, Debug)]
struct Links {
    g: f64,
}

/// The state after steps of a length.
fn after<S: Dynamics<Input = ()> + Copy, M: nonholonomic::Method<S>>(
    system: S,
    method: M,
    start: S::State,
    steps: usize,
) -> S::State
where
    S::State: State<Scalar = f64>,
{
    let mut sim = Integrator::new(system, method, 0.0, start);
    for _ in 0..steps {
        sim.step().unwrap();
    }
    *sim.state()
}

/// The largest relative error of the energy after every step of a run, and the largest residual of the positions.
fn kept<S, M>(system: S, method: M, start: S::State, steps: usize) -> (f64, f64)
where
    S: Energy<Input = ()> + DiscreteLagrangian + Copy,
    S::State: State<Scalar = f64>,
    M: nonholonomic::Method<S>,
{
    let energy = system.energy(0.0, &start).abs();
    let (worst, open, _) =
        kept_of(system, method, start, steps, |_, state| system.position_constraints(state));
    (worst / energy, open)
}

#[test]
fn the_energy_of_a_crank_that_goes_round_stays_in_a_band() {
    let begun = kept(LINKAGE, Rattle::new(0.003), turning(), 300);
    let long = kept(LINKAGE, Rattle::new(0.003), turning(), 30_000);
    assert!(long.0 < 1.02 * begun.0 && long.0 < 2e-3, "{begun:?} {long:?}");
    assert!(long.1 < 1e-12, "{long:?}");
    let fourth = kept(LINKAGE, Rattle::new(0.003).fourth_order(), turning(), 3_000);
    assert!(fourth.0 < 2e-6 && fourth.1 < 1e-12, "{fourth:?}");
}

/// The map (a, p) → (a′, p′) of the one angle that is free and its momentum keeps areas.
#[test]
fn areas_are_kept_by_a_step() {
    // p = 2T/ȧ, from the energy
    let momentum = |s: &FourBarState| 2.0 * (LINKAGE.energy(0.0, s) - 1.5 * s.a.sin().powi(2)) / s.a_dot;
    let inertia = |a: f64| {
        let unit = FourBarState { a, a_dot: 1.0, ..turning() };
        momentum(&LINKAGE.assemble_holding(0.0, &unit, &[FourBarCoordinate::a]).unwrap())
    };
    let h = 0.01;
    let map = |[a, p]: [f64; 2]| {
        let rough = FourBarState { a, a_dot: p / inertia(a), ..turning() };
        let start = LINKAGE.assemble_holding(0.0, &rough, &[FourBarCoordinate::a]).unwrap();
        let start = FourBarState { a_dot: start.a_dot, ..start };
        let scale = rough.a_dot / start.a_dot;
        let start = FourBarState {
            a_dot: scale * start.a_dot,
            b_dot: scale * start.b_dot,
            c_dot: scale * start.c_dot,
            ..start
        };
        let end = after(LINKAGE, Rattle::new(h), start, 1);
        [end.a, momentum(&end)]
    };
    let at = [0.2, 20.0 * inertia(0.2)];
    // central differences of order 4
    let slope = |component: usize| {
        let d = 1e-3 * at[component];
        let values = [-2.0, -1.0, 1.0, 2.0].map(|k| {
            let mut there = at;
            there[component] += k * d;
            map(there)
        });
        [0, 1].map(|i| (values[0][i] - 8.0 * values[1][i] + 8.0 * values[2][i] - values[3][i]) / (12.0 * d))
    };
    let [by_a, by_p] = [slope(0), slope(1)];
    let area = by_a[0] * by_p[1] - by_a[1] * by_p[0];
    assert!((area - 1.0).abs() < 1e-9, "{area}");
}

#[test]
fn momenta_of_linear_symmetries_are_kept_to_round_off() {
    let about = |s: &RodState| s.x * s.y_dot - s.y * s.x_dot;
    let end = after(ROD, Rattle::new(0.02), hanging(), 10_000);
    assert!((about(&end) / about(&hanging()) - 1.0).abs() < 1e-12, "{}", about(&end));
}

#[test]
fn a_step_is_undone_by_the_step_back() {
    let h = 0.004;
    let forth = after(LINKAGE, Rattle::new(h), turning(), 50);
    let reversed = |s: FourBarState| FourBarState { a_dot: -s.a_dot, b_dot: -s.b_dot, c_dot: -s.c_dot, ..s };
    let back = reversed(after(LINKAGE, Rattle::new(h), reversed(forth), 50));
    for (found, wanted) in back.to_array().iter().zip(turning().to_array()) {
        assert!((found - wanted).abs() < 1e-11 * wanted.abs().max(1.0), "{back:?}");
    }
}

/// Where masses are constant it is RATTLE: kicks by half, one multiplier for the positions, one for the velocities.
#[test]
fn constant_masses_make_it_rattle() {
    let (h, Rod { g, l, .. }) = (0.05, ROD);
    let mut state = hanging();
    for _ in 0..20 {
        let RodState { x, y, z, x_dot, y_dot, z_dot } = state;
        // v½ = v − h/2 (g e₃ + 2 λ q), |q + h v½| = l: a quadratic equation for λ
        let kicked = [x_dot, y_dot, z_dot - h / 2.0 * g];
        let free = [x + h * kicked[0], y + h * kicked[1], z + h * kicked[2]];
        let (qq, qf) = (x * x + y * y + z * z, x * free[0] + y * free[1] + z * free[2]);
        let ff = free.iter().map(|f| f * f).sum::<f64>();
        let amount = (ff - l * l) / (qf + (qf * qf - qq * (ff - l * l)).sqrt());
        let next = [free[0] - amount * x, free[1] - amount * y, free[2] - amount * z];
        let within = [(next[0] - x) / h, (next[1] - y) / h, (next[2] - z) / h];
        let late = [within[0], within[1], within[2] - h / 2.0 * g];
        let out = (0..3).map(|k| next[k] * late[k]).sum::<f64>() / next.iter().map(|q| q * q).sum::<f64>();
        let wanted = [
            next[0],
            next[1],
            next[2],
            late[0] - out * next[0],
            late[1] - out * next[1],
            late[2] - out * next[2],
        ];
        state = after(ROD, Rattle::new(h), state, 1);
        for (found, wanted) in state.to_array().iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-13, "{state:?} {wanted:?}");
        }
    }
}

#[test]
fn orders_are_two_and_four() {
    let exact = {
        let mut sim = Integrator::new(LINKAGE, Dop853::new().rtol(1e-13).atol(1e-13), 0.0, turning());
        sim.advance_to(0.6).unwrap();
        *sim.state()
    };
    let error = |end: FourBarState| (end.a - exact.a).abs().max((end.a_dot - exact.a_dot).abs() / 20.0);
    let second = [100_u32, 200]
        .map(|steps| error(after(LINKAGE, Rattle::new(0.6 / f64::from(steps)), turning(), steps as usize)));
    let fourth = [100_u32, 200].map(|steps| {
        error(after(LINKAGE, Rattle::new(0.6 / f64::from(steps)).fourth_order(), turning(), steps as usize))
    });
    let orders = [second, fourth].map(|[coarse, fine]| (coarse / fine).log2());
    assert!(
        (orders[0] - 2.0).abs() < 0.2 && (orders[1] - 4.0).abs() < 0.4,
        "{orders:?} {second:?} {fourth:?}"
    );
    // without constraints, with gyroscopic terms
    let links = Links { g: 9.81 };
    let start = LinksState { p: 1.0, q: -0.4, p_dot: 0.5, q_dot: -1.0 };
    let end = |steps: u32| after(links, Rattle::new(1.0 / f64::from(steps)), start, steps as usize);
    let mut sim = Integrator::new(links, Dop853::new().rtol(1e-13).atol(1e-13), 0.0, start);
    sim.advance_to(1.0).unwrap();
    let [coarse, fine] =
        [200, 400].map(|steps| (end(steps).p - sim.state().p).hypot(end(steps).q - sim.state().q));
    assert!(((coarse / fine).log2() - 2.0).abs() < 0.1, "{coarse:e} {fine:e}");
}

/// A crank that has turned for long has few digits, and other angles have no more than it leaves them.
#[test]
fn a_crank_after_many_turns_steps_on() {
    let turned = FourBarState { a: turning().a + 1e5 * std::f64::consts::TAU, ..turning() };
    let begun = LINKAGE.assemble_holding(0.0, &turned, &[FourBarCoordinate::a]).unwrap();
    let (energy, open) = kept(LINKAGE, Rattle::new(0.003), begun, 1000);
    assert!(energy < 3e-3 && open < 1e-9, "{energy:e} {open:e}");
    // slowly, where every correction is rounding
    let slow = FourBarState { a_dot: 1e-9, b_dot: begun.b_dot * 5e-11, c_dot: begun.c_dot * 5e-11, ..begun };
    _ = after(FourBar { k: 0.0, ..LINKAGE }, Rattle::new(0.003), slow, 100);
}

/// A step during which nothing moves by a digit changes no velocity, whatever rounding of the positions is by its length.
#[test]
fn steps_that_positions_do_not_resolve_keep_velocities() {
    for h in [1e-18, 1e-20, 1e-30, 1e-100, 1e-300] {
        let end = after(ROD, Rattle::new(h), hanging(), 20);
        for (found, wanted) in end.to_array().iter().zip(hanging().to_array()) {
            assert!((found - wanted).abs() < 1e-14, "{h:e}: {end:?}");
        }
        let end = after(LINKAGE, Rattle::new(h).fourth_order(), turning(), 20);
        for (found, wanted) in end.to_array().iter().zip(turning().to_array()) {
            assert!((found - wanted).abs() < 1e-12, "{h:e}: {end:?}");
        }
    }
    // from rest, half of the force acts within the step and half at its end
    let held = RodState { x_dot: 0.0, y_dot: 0.0, z_dot: 0.0, ..hanging() };
    let end = after(ROD, Rattle::new(1e-30), held, 20);
    let RodState { x, z, .. } = held;
    let [fall, swing] =
        [-(1.0 - z * z / (ROD.l * ROD.l)), x * z / (ROD.l * ROD.l)].map(|share| share * ROD.g * 2e-29);
    assert!((end.z_dot / fall - 1.0).abs() < 1e-12 && (end.x_dot / swing - 1.0).abs() < 1e-12, "{end:?}");
}

/// A parallelogram, whose coupler does not turn: what is left of its closure is rounding of sines that cancel.
#[nonholonomic(
    base { a, b, c }
    let along(angle) = [cos(angle), sin(angle)];
    holonomic {
        same: a = c;
        closure: l * along(a) + d * along(b) = l * along(c) + [d, 0];
        redundant;
    }
    lagrangian { J / 2 * (der(a)^2 + der(b)^2 + der(c)^2) - k * sin(a) }
    emit { rattle }
)]
#[derive(Clone, Copy, Debug)]
struct Parallelogram {
    l: f64,
    d: f64,
    J: f64,
    k: f64,
}

#[test]
fn a_coordinate_at_zero_has_the_digits_of_the_terms_of_its_equations() {
    let system = Parallelogram { l: 1.0, d: 2.0, J: 0.3, k: 1.0 };
    for (h, rate) in [(0.001, 2.0), (0.001, 0.0), (0.01, 2.0), (0.01, 0.0), (0.1, 2.0)] {
        let start = ParallelogramState { a: 0.7, c: 0.7, a_dot: rate, c_dot: rate, ..Default::default() };
        let (_, open) = kept(system, Rattle::new(h), start, 3000);
        assert!(open < 1e-12, "{h} {rate}: {open:e}");
    }
}

/// A velocity beside one that is larger by more than its digits: momenta are sums of both.
#[test]
fn a_slow_velocity_has_the_digits_of_the_terms_of_its_momentum() {
    let start = LinksState { p_dot: 1e-8, q_dot: 1e3, ..LinksState::default() };
    for method in [Rattle::new(1e-9), Rattle::new(1e-7), Rattle::new(1e-5)] {
        let end = after(Links { g: 9.81 }, method, start, 1000);
        assert!((end.q_dot / 1e3 - 1.0).abs() < 0.5, "{end:?}");
        _ = after(Links { g: 9.81 }, method.fourth_order(), start, 300);
    }
}

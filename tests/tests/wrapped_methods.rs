//! What is wrapped around methods and systems keeps what these keep: levels at events, position constraints of a
//! reconstruction, constraints of states that are handed out.

mod wrapped_methods {
    mod columns_of_returns;
    mod reconstructions;
    mod returns_by_the_whole_state;
}

use core::ops::ControlFlow;

use nonholonomic::methods::Interruptible;
use nonholonomic::prelude::*;
use nonholonomic::{ChartError, Jet, linearize_on_constraints};

/// A pendulum by its angle.
#[nonholonomic(
    base { a }
    lagrangian { der(a)^2 / 2 + g * cos(a) }
    conserved { total = der(a)^2 / 2 - g * cos(a); }
    emit { invariants, discrete_gradient }
)]
#[derive(Clone, Copy, Debug)]
struct Swinging {
    g: f64,
}

/// The level of a first integral is that of the first state, however often a run stands within a step.
#[test]
fn a_level_holds_at_events() {
    fn drift(method: impl nonholonomic::Method<Swinging>) -> f64 {
        let start = SwingingState { a: 1.0, a_dot: 0.0 };
        let system = Swinging { g: 1.0 };
        let mut sim = Integrator::new(system, method, 0.0, start);
        let mut events = 0;
        sim.advance_acting(300.0, &Events::new(|_, x: &SwingingState, (): &()| [x.a]), |_, _| {
            events += 1;
            ControlFlow::<()>::Continue(())
        })
        .expect("a smooth motion");
        assert!(events > 80, "{events}");
        sim.step().expect("a step");
        (system.energy(0.0, sim.state()) - system.energy(0.0, &start)).abs()
    }
    assert!(drift(Conserving::new(Dopri5::new().rtol(1e-3))) < 1e-14);
    assert!(drift(Conserving::new(Rk4::new(0.2))) < 1e-14);
    assert!(drift(Conserving::new(ImplicitMidpoint::new(0.1))) < 1e-14);
    assert!(drift(DiscreteGradient::new(0.1)) < 1e-13);
    assert!(drift(DiscreteGradient::new(0.1).fourth_order()) < 1e-13);
}

/// A weight on a rope.
#[nonholonomic(
    base { x, y }
    lagrangian { 1 / 2 * (der(x)^2 + der(y)^2) - g * y }
    holonomic { rope: x^2 + y^2 = l^2; }
    conserved { total = 1 / 2 * (der(x)^2 + der(y)^2) + g * y; }
    emit { invariants, symmetric_projection }
)]
#[derive(Clone, Copy, Debug)]
struct Rope {
    l: f64,
    g: f64,
}

/// Energy and rope together.
#[test]
fn a_level_is_met_with_the_position_constraints() {
    fn off(method: impl nonholonomic::Method<Rope>) -> [f64; 2] {
        let rope = Rope { l: 1.0, g: 9.81 };
        let start = RopeState { x: 0.8, y: -0.6, x_dot: 0.3, y_dot: 0.4 };
        let energy = |s: &RopeState| rope.energy(0.0, s);
        let mut sim = Integrator::new(rope, method, 0.0, start);
        let mut worst = [0.0_f64; 2];
        for second in 1..=20 {
            sim.advance_to(f64::from(second)).expect("a smooth motion");
            let s = sim.state();
            worst[0] = worst[0].max((s.x.hypot(s.y) - 1.0).abs());
            worst[1] = worst[1].max((energy(s) - energy(&start)).abs());
        }
        worst
    }
    for [rope, energy] in [
        off(Conserving::new(Rk4::new(0.1))),
        off(Conserving::new(Dopri5::new().rtol(1e-4))),
        off(Conserving::new(ImplicitMidpoint::new(0.1).symmetrically_projected())),
    ] {
        assert!(rope < 1e-13 && energy < 1e-12, "{rope:e} {energy:e}");
    }
}

/// A bead that slides along a valley: the place along it is cyclic.
#[nonholonomic(
    base { x, y, z }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) - m * g * y }
    holonomic { bowl: y = h * x^2; }
    independent { der(x), der(z) }
)]
#[derive(Clone, Copy, Debug)]
struct Valley {
    m: f64,
    g: f64,
    h: f64,
}

quotient! { Valley -> #[derive(Clone, Copy, Debug)] struct Across by { z } { } }

#[test]
fn a_reconstruction_returns_to_the_position_constraints() {
    let full = Valley { m: 1.0, g: 9.81, h: 1.0 };
    let start = ValleyState { x: 1.0, y: 1.0, z: 0.0, x_dot: 0.0, z_dot: 1.0 };
    let motion = Reconstructed::<Valley, Across>::new(full);
    assert!(motion.has_positions());
    let mut joint = Integrator::new(motion, Rk4::new(0.05), 0.0, motion.start(0.0, &start));
    joint.advance_to(100.0).expect("a smooth motion");
    let reached = motion.full_state(100.0, joint.state());
    assert!((reached.y - reached.x * reached.x).abs() < 1e-14, "{reached:?}");
    let precise = || Vern9::new().rtol(1e-12).atol(1e-12);
    let mut joint = Integrator::new(motion, precise(), 0.0, motion.start(0.0, &start));
    joint.advance_to(20.0).expect("a smooth motion");
    let reached = motion.full_state(20.0, joint.state());
    let mut whole = Integrator::new(full, precise(), 0.0, start);
    whole.advance_to(20.0).expect("a smooth motion");
    assert!((whole.state().x - reached.x).abs() < 1e-9, "{reached:?} {:?}", whole.state());
    // a start beside them is refused, as that of the full system
    let beside = ValleyState { y: 3.0, ..start };
    let refused = Integrator::new(motion, Rk4::new(0.05), 0.0, motion.start(0.0, &beside)).step();
    assert!(matches!(refused, Err(IntegrationError::OffConstraints { .. })), "{refused:?}");
}

/// A skate with all rates in its state.
#[nonholonomic(
    base { x, y, turn }
    lagrangian { 1 / 2 * (der(x)^2 + der(y)^2 + der(turn)^2) - g * x }
    constraints { blade: sin(turn) * der(x) = cos(turn) * der(y) + d * der(turn); }
    formulation { projected }
)]
#[derive(Clone, Copy, Debug)]
struct Skate {
    g: f64,
    /// The blade is so far aside.
    d: f64,
}

const GLIDING: SkateState = SkateState { x: 0.0, y: 0.0, turn: 0.3, x_dot: 0.0, y_dot: 0.0, turn_dot: 0.7 };

/// States that events and samples are given satisfy the constraints, so that a run may go on from them.
#[test]
fn projected_states_are_handed_out_on_the_constraints() {
    let off = |s: &SkateState| (s.turn.sin() * s.x_dot - s.turn.cos() * s.y_dot).abs();
    for h in [0.1, 0.05] {
        let mut sim = Integrator::new(Skate { g: 1.0, d: 0.0 }, Projected::new(Rk4::new(h), 1), 0.0, GLIDING);
        let mut turns = 0;
        let events = Events::new(|_, s: &SkateState, (): &()| [s.turn - 1.0]);
        sim.advance_acting(10.0, &events, |sim, event| {
            turns += 1;
            let SkateState { x_dot, y_dot, turn_dot, .. } = event.state;
            assert!(off(&event.state) < 1e-14, "{:e}", off(&event.state));
            sim.set_state(SkateState { x_dot: -x_dot, y_dot: -y_dot, turn_dot: -turn_dot, ..event.state });
            ControlFlow::<()>::Continue(())
        })
        .unwrap_or_else(|error| panic!("{h}: {error}"));
        assert!(turns >= 1, "{turns}");
        let times = (1..40).map(|k| sim.time() + 0.013 * f64::from(k)).collect::<Vec<_>>();
        sim.sample(times, |_, s| assert!(off(s) < 1e-14, "{:e}", off(s))).expect("a smooth motion");
    }
}

/// Other parameters, other constraints: the state is looked at again.
#[test]
fn a_state_that_new_parameters_leave_off_the_constraints_is_refused() {
    let mut sim = Integrator::new(Skate { g: 1.0, d: 0.0 }, Projected::new(Rk4::new(0.1), 1), 0.0, GLIDING);
    sim.advance_to(1.0).expect("a smooth motion");
    let before = *sim.state();
    sim.system_mut().d = 0.7;
    let refused = sim.step();
    assert!(matches!(refused, Err(IntegrationError::InconsistentStart { .. })), "{refused:?}");
    assert_eq!(*sim.state(), before);
}

#[test]
fn interruptions_take_no_projection_away() {
    let projections = |every: u32| {
        let asked = core::cell::Cell::new(0_u32);
        let goes_on = |_: &_| {
            asked.set(asked.get() + 1);
            every == 0 || !asked.get().is_multiple_of(every)
        };
        let method = Projected::new(Interruptible::new(Rk4::new(0.1), goes_on), 10);
        let mut sim = Integrator::new(Skate { g: 1.0, d: 0.0 }, method, 0.0, GLIDING);
        while let Err(error) = sim.advance_to(20.0) {
            assert!(matches!(error, IntegrationError::Interrupted { .. }), "{error}");
        }
        (sim.statistics().steps, sim.statistics().projections)
    };
    let plain = projections(0);
    for every in [3, 10, 17] {
        assert_eq!(projections(every), plain, "{every}");
    }
}

/// A rod that two of three coordinates determine, unless these stand still together.
#[nonholonomic(
    base { x, y, z, w }
    lagrangian { 1 / 2 * (der(x)^2 + der(y)^2 + der(z)^2 + der(w)^2) - k / 2 * (z^2 + w^2) }
    holonomic { p: 0.1 * x + 0.3 * y + a * z = 0; q: 0.7 * x + 2.1 * y + 0.3 * z + w = 0; }
)]
#[derive(Clone, Copy, Debug)]
struct Plane<T> {
    a: T,
    k: T,
}

/// A ball on a rope in space, in units of time and length.
#[nonholonomic(
    base { x, y, z }
    lagrangian { 1 / 2 * (der(x)^2 + der(y)^2 + der(z)^2) - g * z }
    holonomic { rope: x^2 + y^2 + z^2 = l^2; }
)]
#[derive(Clone, Copy, Debug)]
struct Ball<T> {
    g: T,
    l: T,
}

#[test]
fn charts_that_determine_nothing_are_refused_and_others_know_no_units() {
    for a in [0.1, 0.3, 0.7, 1.3, -2.9] {
        let plane = Plane::<Jet<f64, 8>> { a: Jet::constant(a), k: Jet::constant(2.0) };
        let found = linearize_on_constraints(&plane, 0.0, &[0.0; 8], &[], |[]| (), &[2, 3, 6, 7]);
        assert_eq!(found.map(|_| ()), Err(ChartError::Singular), "{a}");
        let other = linearize_on_constraints(&plane, 0.0, &[0.0; 8], &[], |[]| (), &[0, 3, 4, 7]);
        assert!(other.is_ok(), "{a}: {other:?}");
    }
    let found = |time: f64, length: f64| {
        let jet = Jet::<f64, 6>::constant;
        let ball = Ball { g: jet(9.81 * length / time / time), l: jet(0.5 * length) };
        let speed = length / time;
        // on the rope, across it
        let state = [0.3 * length, -0.4 * length, 0.0, 0.4 * speed, 0.3 * speed, 0.7 * speed];
        let linear = linearize_on_constraints(&ball, 0.0, &state, &[], |[]| (), &[0, 2, 3, 5])
            .unwrap_or_else(|error| panic!("{time:e} {length:e}: {error}"));
        let units = [length, length, speed, speed];
        core::array::from_fn::<_, 16, _>(|k| linear.a[(k / 4, k % 4)] * time * units[k % 4] / units[k / 4])
    };
    let plain = found(1.0, 1.0);
    assert_eq!([plain[2], plain[7]].map(f64::to_bits), [1.0_f64.to_bits(); 2], "{plain:?}");
    for (time, length) in [(1e-6, 1.0), (1e-9, 1.0), (1e9, 1.0), (1.0, 1e6), (1e3, 1e-9)] {
        for (a, b) in found(time, length).iter().zip(&plain) {
            assert!((a - b).abs() <= 1e-11 * b.abs().max(1.0), "{time:e} {length:e}: {a} {b}");
        }
    }
}

/// A weight on a rope that is let out, pushed, and wound up by a motor with a lag.
#[nonholonomic(
    base { x, y }
    lagrangian { 1 / 2 * (der(x)^2 + der(y)^2) - g * y }
    holonomic { rope: x^2 + y^2 = (l + v * t)^2; }
    auxiliary { der(pull) = (push - pull) / lag; }
    forces { x: pull; }
    inputs { push }
    emit { jacobian, return_jacobian }
)]
#[derive(Clone, Copy, Debug)]
struct Pushed<T> {
    l: T,
    v: T,
    g: T,
    lag: T,
}

/// A skate on the rim of a wheel: position constraints beside one on velocities, in few velocities.
#[nonholonomic(
    base { x, y, heading }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) + J / 2 * der(heading)^2 }
    holonomic { rim: x^2 + y^2 = l^2 * (1 + heading^2 / 8); }
    constraints { edge: der(y) = (1 + x) * der(heading) / 4; }
    forces { heading: push; }
    inputs { push }
    emit { jacobian, return_jacobian }
)]
#[derive(Clone, Copy, Debug)]
struct Rim<T> {
    m: T,
    J: T,
    l: T,
}

/// The derivative of a step with its return is that of the whole, as steps over jets have it, and differences.
#[test]
fn steps_are_differentiated_with_their_return() {
    let jet = Jet::<f64, 5, 1>::constant;
    let plain = Pushed { l: 1.0, v: 0.2, g: 9.81, lag: 0.3 };
    let jets = Pushed { l: jet(1.0), v: jet(0.2), g: jet(9.81), lag: jet(0.3) };
    let start = PushedState { x: 0.6, y: -0.8, x_dot: 0.12 + 0.8, y_dot: -0.16 + 0.6, pull: 0.4 };
    let input = PushedInput { push: 0.3 };
    let step = Rk4::linearized_step(&plain, 0.0, 0.1, &start, &input);
    let alone = Rk4::step(&plain, 0.0, 0.1, &start, &input);
    let begun = PushedState::from(Jet::variables(start.to_array()));
    let push = Jet { by_others: [1.0], ..jet(0.3) };
    let whole = Rk4::step(&jets, jet(0.0), jet(0.1), &begun, &PushedInput { push }).to_array();
    for (i, (component, alone)) in whole.iter().zip(alone.to_array()).enumerate() {
        assert!((step.state.to_array()[i] - alone).abs() < 1e-15);
        for (j, by) in component.by.iter().enumerate() {
            assert!((step.by_state[(i, j)] - by).abs() < 1e-13, "{i} {j}: {} {by}", step.by_state[(i, j)]);
        }
        assert!((step.by_input[(i, 0)] - component.by_others[0]).abs() < 1e-14);
    }
    let back = Rk4::pulled_back_step(
        &plain,
        0.0,
        0.1,
        &start,
        &input,
        |_| [1.0, -2.0, 0.5, 3.0, 1.0],
        |_, _, _| nalgebra::SMatrix::<f64, 5, 0>::zeros(),
    );
    for j in 0..5 {
        let forward: f64 =
            [1.0, -2.0, 0.5, 3.0, 1.0].iter().zip(step.by_state.column(j).iter()).map(|(l, x)| l * x).sum();
        assert!((back.by_state[j] - forward).abs() < 1e-13, "{j}: {} {forward}", back.by_state[j]);
    }
}

/// By implicit methods as by explicit ones, with a constraint on velocities, against differences of whole steps.
#[test]
fn implicit_steps_are_differentiated_with_their_return() {
    use nonholonomic::methods::Transition;
    type Step = Transition<RimState<f64>, f64, 6, 1>;
    type Whole = fn(&Rim<f64>, &RimState<f64>, &RimInput<f64>) -> RimState<f64>;

    let rim = Rim { m: 1.0, J: 0.5, l: 1.0 };
    // A = 0 leaves one direction: x ẋ + y ẏ = θ θ̇/8 l², ẏ = (1 + x) θ̇/4
    let heading_dot = 0.7;
    let (x, heading): (f64, f64) = (0.6, 0.4);
    let y = (1.0 + heading * heading / 8.0 - x * x).sqrt();
    let y_dot = (1.0 + x) * heading_dot / 4.0;
    let x_dot = (heading * heading_dot / 8.0 - y * y_dot) / x;
    let start = RimState { x, y, heading, x_dot, y_dot, heading_dot };
    let input = RimInput { push: 0.3 };
    let cases: [(&str, Step, Whole); 4] = [
        ("Rk4", Rk4::linearized_step(&rim, 0.0, 0.1, &start, &input), |s, x, u| Rk4::step(s, 0.0, 0.1, x, u)),
        (
            "ImplicitMidpoint",
            ImplicitMidpoint::linearized_step(&rim, 0.0, 0.1, &start, &input).unwrap(),
            |s, x, u| ImplicitMidpoint::step_with_jacobian(s, 0.0, 0.1, x, u).unwrap(),
        ),
        (
            "GaussLegendre4",
            GaussLegendre4::linearized_step(&rim, 0.0, 0.1, &start, &input).unwrap(),
            |s, x, u| GaussLegendre4::step(s, 0.0, 0.1, x, u).unwrap(),
        ),
        (
            "GaussLegendre6",
            GaussLegendre6::linearized_step(&rim, 0.0, 0.1, &start, &input).unwrap(),
            |s, x, u| GaussLegendre6::step(s, 0.0, 0.1, x, u).unwrap(),
        ),
    ];
    let h = 1e-6;
    for (name, step, whole) in cases {
        let alone = whole(&rim, &start, &input).to_array();
        for (found, alone) in step.state.to_array().iter().zip(alone) {
            assert!((found - alone).abs() < 1e-14, "{name}: {found} {alone}");
        }
        for j in 0..7 {
            let end = |by: f64| {
                let mut from = start.to_array();
                let mut push = input.push;
                if let Some(component) = from.get_mut(j) {
                    *component += by;
                } else {
                    push += by;
                }
                whole(&rim, &RimState::from(from), &RimInput { push }).to_array()
            };
            for (i, (ahead, behind)) in end(h).iter().zip(end(-h)).enumerate() {
                let found = if j < 6 { step.by_state[(i, j)] } else { step.by_input[(i, 0)] };
                let slope = (ahead - behind) / (2.0 * h);
                assert!((found - slope).abs() < 2e-8, "{name} {i} {j}: {found} {slope}");
            }
        }
        // where the constraints hold, a return leaves of any displacement what is along them
        let mut there = step.state;
        (0..3).for_each(|_| rim.correct_positions(0.1, &mut there));
        let slopes = rim.return_jacobian(0.1, &there);
        for column in step.by_state.column_iter() {
            let along = slopes.map(|row| row.iter().zip(column.iter()).map(|(a, x)| a * x).sum::<f64>());
            let off = 2.0 * (there.x * along[0] + there.y * along[1]) - there.heading * along[2] / 4.0;
            assert!(off.abs() < 1e-14, "{name}: {off:e}");
        }
    }
}

/// A regulator in a receding horizon sees the derivative of steps with returns.
#[test]
fn plans_of_machines_with_loops() {
    use nalgebra::{SVector, Vector1};
    use nonholonomic::control::{Ilqr, Quadratic, Sampled};

    let rope = Pushed { l: 1.0, v: 0.0, g: 9.81, lag: 0.1 };
    let start = PushedState { x: 0.6, y: -0.8, x_dot: 0.8, y_dot: 0.6, pull: 0.0 };
    let model = Sampled { system: rope, start: 0.0, dt: 0.05 };
    let cost = Quadratic {
        goal: [0.0, -1.0, 0.0, 0.0, 0.0].into(),
        state: [1.0, 1.0, 0.1, 0.1, 0.0].into(),
        input: Vector1::new(0.01),
        end: [100.0, 100.0, 100.0, 100.0, 0.0].into(),
    };
    let mut plan = Ilqr::<f64, 5, 1, 30>::new(SVector::zeros());
    let solved = plan.solve(&model, &cost, &start.to_array().into(), 1e-9, 200).unwrap();
    assert!(solved.decrease.abs() <= 1e-6 * solved.cost, "{solved:?}");
    let end = plan.states()[29];
    assert!(end[0].abs() < 0.05 && end[2].abs() < 0.2, "{end}");
    assert!((end[0] * end[0] + end[1] * end[1] - 1.0).abs() < 1e-6, "{end}");
}

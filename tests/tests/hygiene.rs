//! Declarations compute the right thing in surroundings that shadow what generated code relies on.
//! That they compile there, without a warning, is the greater half of the check.

use nh_tests::hygiene::colliding::{Odd, OddState};
use nh_tests::hygiene::narrow::{acceleration, oscillation};
use nh_tests::hygiene::shadowed::{
    Bob, BobState, Body, BodyState, Drop, DropState, Ferry, FerryState, Sleigh, SleighInput, SleighState,
};
use nh_tests::silent::{narrow, underscores};
use nonholonomic::Energy;

const EXACT: f64 = 1e-14;

#[test]
fn shadowed_names_are_not_picked_up() {
    let sleigh = Sleigh { J: 1.0, I: 2.0, a: 0.5, r#type: 0.1, unused: 7.0 };
    let state = SleighState { theta: 0.3, x: 0.0, y: 0.0, omega: 0.8, v1: 0.4 };
    let rate = sleigh.derivative(0.0, &state, &SleighInput { torque: 0.2 });
    let inertia = 1.0 + 2.0 * 0.25;
    let omega_dot = (0.2 - 0.1 * 0.8 - 2.0 * 0.5 * 0.8 * 0.4) / inertia;
    let v1_dot = 0.5 * 0.8 * 0.8 - 0.1 * 0.4 / 2.0;
    assert!((rate.omega - omega_dot).abs() < EXACT, "{rate:?}");
    assert!((rate.v1 - v1_dot).abs() < EXACT, "{rate:?}");
    assert!((rate.x - 0.4 * 0.3_f64.cos()).abs() < EXACT, "{rate:?}");
    let energy = Energy::energy(&sleigh, 0.0, &state);
    assert!((energy - (inertia / 2.0 * 0.64 + 0.16)).abs() < EXACT, "{energy}");
    assert!((sleigh.velocity(0.0, &state).v2).abs() < EXACT);
}

#[test]
fn declared_names_do_not_collide_with_generated_ones() {
    let odd = Odd { system: 2.0, f: 3.0, velocity: 0.5, h: 0.7, array: 1.1, c0: 1.3 };
    let state = OddState { state: 1.0, input: 1.0, result: 0.2, out_dot: 4.0, ..OddState::default() };
    let rate = odd.derivative(0.0, &state, &());
    assert!((rate.state_dot + 1.5).abs() < EXACT, "{rate:?}");
    assert!((rate.input_dot + 0.75).abs() < EXACT, "{rate:?}");
    assert!((rate.result_dot + 0.35 * 0.2_f64.cos()).abs() < EXACT, "{rate:?}");
    assert!((rate.out - 4.0).abs() < EXACT, "{rate:?}");
    assert!((rate.value_dot + 0.65).abs() < EXACT, "{rate:?}");
}

#[test]
fn constraints_and_projections_do_not_collide_either() {
    let ferry = Ferry { J: 1.0 };
    let mut state = FerryState { start: 0.5, project_dot: 1.0, ..FerryState::default() };
    assert!((ferry.constraint_residual(0.0, &state).state - 0.5_f64.cos()).abs() < EXACT);
    assert!(ferry.project(0.0, &mut state).is_ok());
    assert!((state.present_dot - 0.5_f64.sin() * 0.5_f64.cos()).abs() < EXACT, "{state:?}");
    assert!((ferry.multipliers(0.0, &state, &()).state - 0.5_f64.cos()).abs() < EXACT);
    assert!((ferry.reactions(0.0, &state, &()).project_dot - 0.5_f64.cos().powi(2)).abs() < EXACT);
}

#[test]
fn position_constraints_do_not_collide_either() {
    let bob = Bob { J: 1.0 };
    let start = BobState { given: 0.6, held: -0.8, given_dot: 0.4, held_dot: 0.3 };
    let mut sim = nonholonomic::Integrator::new(bob, nonholonomic::Rattle::new(0.05), 0.0, start);
    sim.advance_to(2.0).expect("a pendulum swings");
    let end = sim.state();
    assert!((end.given.hypot(end.held) - 1.0).abs() < EXACT, "{end:?}");
    assert!((bob.energy(0.0, end) - bob.energy(0.0, &start)).abs() < 1e-2, "{end:?}");
}

#[test]
fn phase_space_does_not_collide_either() {
    // the momentum of a body whose constraint is along a principal axis stays, in discrete equations too
    let body = Body { J: 2.0, c: 3.0 };
    let state = BodyState { length: 0.4, matrix: -0.3 };
    assert_eq!(body.hamilton(0.0, &body.legendre(0.0, &state), &()).p_length.to_bits() << 1, 0);
    assert!((body.volume_density(0.0, &state) - 1.0).abs() < EXACT);
    let discrete = nonholonomic::EulerPoincareSuslov::discrete_momentum(&body, &state, 0.0);
    assert!((discrete[0] - 0.8).abs() < EXACT && (discrete[1] + 0.9).abs() < EXACT, "{discrete:?}");
    // the particle on its Hamilton–Jacobi section moves with energy c + J/2
    let particle = Drop { J: 1.5, c: 4.0 };
    let start = DropState { phase: 0.7, covector: 0.3, ..DropState::default() };
    let on_section = particle.hamilton_jacobi(0.0, &start);
    assert!((particle.energy(0.0, &on_section) - 4.75).abs() < 1e-13, "{on_section:?}");
    let (rate, other) =
        (particle.derivative(0.0, &on_section, &()), particle.gibbs_appell(0.0, &on_section, &()));
    assert!((rate.phase_dot - other.phase_dot).abs() < EXACT, "{rate:?} {other:?}");
    let with_energy = particle.bracket_with_energy(0.0, &on_section, &()).density;
    assert!((with_energy - rate.phase_dot).abs() < EXACT, "{with_energy}");
    assert!((particle.volume_density(0.0, &start) - (1.0 + 0.3_f64.sin().powi(2)).sqrt()).abs() < EXACT);
}

#[test]
fn narrow_items_and_user_macros_work() {
    assert!((acceleration(0.4, 9.0) + 9.0 * 0.4_f64.sin()).abs() < EXACT);
    assert!((oscillation(2.0) + 6.0).abs() < EXACT);
}

#[test]
fn odd_names_and_narrow_items_compute_what_others_do() {
    // a weight of 2 on a mass of 1, a weight of 4, and a force of 1/2 against a weight of 8
    assert!((narrow::sum() + 2.0 + 4.0 + 7.5).abs() < EXACT);
    let under = underscores::Under { _m: 2.0, __k: 3.0, k_: 4.0, _unused: 5.0 };
    let state = underscores::UnderState { _x: 0.5, ___dot: 6.0, ..underscores::UnderState::default() };
    let rate = under.derivative(0.0, &state, &underscores::UnderInput { _u: 1.0, _unused_input: 9.0 });
    assert!((rate._x_dot + 1.0).abs() < EXACT, "{rate:?}");
    assert!((rate.w___dot + 2.0).abs() < EXACT, "{rate:?}");
    assert!((rate.__ - 6.0).abs() < EXACT, "{rate:?}");
}

/// A mass on a spring, by names that a parameter of generated functions has otherwise.
mod names_of_parameters {
    use nonholonomic::prelude::*;

    #[nonholonomic(
        base { x }
        lagrangian { m / 2 * der(x)^2 - k / 2 * x^2 }
        forces { x: push; }
        inputs { push }
        names { state = COUNT; input = NUMBER; }
        emit { taylor }
    )]
    #[derive(Clone, Copy, Debug)]
    #[allow(clippy::upper_case_acronyms, reason = "the names are the point")]
    pub(crate) struct P<TERMS> {
        pub m: TERMS,
        pub k: TERMS,
    }
}

#[test]
fn constant_parameters_hide_no_types() {
    use names_of_parameters::{COUNT, NUMBER, P};
    let [start, rate, half] =
        P { m: 2.0_f64, k: 8.0 }.taylor(0.0, &COUNT { x: 1.0, x_dot: 0.5 }, &NUMBER { push: 0.0 });
    assert!((start.x - 1.0).abs() < EXACT && (rate.x - 0.5).abs() < EXACT, "{start:?} {rate:?}");
    assert!((half.x + 2.0).abs() < EXACT, "{half:?}");
}

/// Systems by names that structs of a reconstruction have otherwise.
mod names_of_reconstructions {
    use nonholonomic::prelude::*;

    #[nonholonomic(base { x, y } lagrangian { m / 2 * (der(x)^2 + der(y)^2) - k / 2 * x^2 })]
    #[derive(Clone, Copy, Debug)]
    pub(crate) struct Joint {
        pub m: f64,
        pub k: f64,
    }

    quotient! { Joint -> #[derive(Clone, Copy, Debug)] pub(crate) struct Group by { y } }
}

#[test]
fn structs_of_reconstructions_hide_no_systems() {
    use names_of_reconstructions::{Group, Joint, JointState};
    use nonholonomic::{Integrator, Reconstructed, Vern9};
    let motion = Reconstructed::<Joint, Group>::new(Joint { m: 2.0, k: 8.0 });
    let start = motion.start(0.0, &JointState { x: 1.0, y: 0.5, x_dot: 0.0, y_dot: 2.0 });
    let mut sim = Integrator::new(motion, Vern9::new().rtol(1e-12).atol(1e-12), 0.0, start);
    sim.advance_to(1.0).expect("a smooth motion");
    let end = motion.full_state(1.0, sim.state());
    assert!((end.x - 2.0_f64.cos()).abs() < 1e-9 && (end.y - 2.5).abs() < 1e-9, "{end:?}");
}

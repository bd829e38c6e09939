//! Generated code and methods of fixed step in a control loop: they cannot panic, hold no state outside of what
//! they are given, and give the same bits in every build for the same target.
//!
//! ```sh
//! cargo run --profile bounded -p nh-bounded --features proof
//! ```
//!
//! links only if no function in `proved.rs` has a path that panics, and prints the bits of the states that a
//! debug build has to print too.

mod bits;
mod methods;
mod proved;
mod structure;
mod systems;

use nonholonomic::ParameterError;
use nonholonomic::control::{
    ControlError, Correction, Estimate, Ilqr, Quadratic, Regulator, Sampled, Squares, Unscented,
};
use nonholonomic::prelude::*;
use systems::{Robot, RobotInput, RobotState, Sleigh, SleighInput, SleighState};

/// Types that may be copied, and shared with an interrupt.
const fn plain<T: Copy + Send + Sync + 'static>() {}
/// Types that may be handed to an interrupt.
const fn shared<T: Send + Sync + 'static>() {}
const _: () = {
    plain::<Sleigh<f32>>();
    plain::<SleighState<Fast<f64>>>();
    plain::<SleighInput<f32>>();
    plain::<Robot>();
    plain::<RobotState>();
    plain::<RobotInput>();
    plain::<systems::SleighVelocity<f64>>();
    plain::<systems::SleighMultipliers<f64>>();
    plain::<systems::SleighOutputs<f64>>();
    plain::<Euler<f64>>();
    plain::<Heun<f64>>();
    plain::<Ralston<f64>>();
    plain::<Rk4<f32>>();
    plain::<Bs23<f64>>();
    plain::<Dopri5<f64>>();
    plain::<Tsit5<f64>>();
    plain::<Dop853<f64>>();
    plain::<Vern9<f64>>();
    plain::<ImplicitMidpoint<f64>>();
    plain::<GaussLegendre4<f64>>();
    plain::<GaussLegendre6<f64>>();
    plain::<Radau5<f64>>();
    plain::<Rodas5P<f64>>();
    plain::<Auto<f64>>();
    plain::<Taylor<f64>>();
    plain::<DiscreteGradient<f64>>();
    plain::<DiscreteSuslov<f64>>();
    plain::<Rattle<f64>>();
    plain::<ReflectedLeapfrog<f64>>();
    plain::<Projected<Rk4<f64>>>();
    plain::<Conserving<Rk4<f64>>>();
    plain::<Regulator<f32, 4, 2>>();
    plain::<Estimate<Fast<f32>, 4>>();
    plain::<Correction<f64, 4>>();
    plain::<Unscented<f64>>();
    plain::<Ilqr<f64, 4, 2, 10>>();
    plain::<Quadratic<f64, 4, 2>>();
    plain::<Squares<()>>();
    plain::<Sampled<Robot, f64>>();
    plain::<ControlError>();
    plain::<ParameterError>();
    shared::<Integrator<Sleigh<f32>, Rk4<f32>>>();
    shared::<Integrator<Robot, Dopri5<f64>>>();
    plain::<IntegrationError>();
};

fn sleigh_over<T: Real>(number: impl Fn(f64) -> T) -> [T; 5] {
    let sleigh = Sleigh {
        m: number(1.0),
        J: number(0.5),
        a: number(0.3),
        b: number(0.1),
        c: number(0.02),
        J_w: number(0.1),
    };
    let mut state = SleighState::from([-0.4, 0.0, 0.0, 0.15, -1.0].map(&number));
    for tick in 0..1000 {
        let input = SleighInput { torque: number(0.01) * T::from_u32(tick % 7) };
        state = Rk4::step(&sleigh, T::ZERO, number(0.02), &state, &input);
    }
    state.into()
}

fn robot() -> [f64; 7] {
    let robot = Robot { m: 8.0, J: 0.3, I: 0.02, b: 0.2, d: 0.05, r: 0.1 };
    let mut state = RobotState::default();
    for tick in 0..1000 {
        let input = RobotInput { right: 0.021, left: if tick % 3 == 0 { 0.0 } else { 0.03 } };
        state = proved::implicit_step(&robot, 0.02, &state, &input).unwrap_or_default();
    }
    state.into()
}

/// The bits of every result, a line each.
fn results() -> Vec<String> {
    let mut lines = vec![
        format!("f64       {:016x?}", sleigh_over(|x| x).map(f64::to_bits)),
        format!("f32       {:08x?}", sleigh_over(<f32 as Scalar>::from_f64).map(f32::to_bits)),
        format!("Fast<f64> {:016x?}", sleigh_over(Fast).map(|x| x.0.to_bits())),
        format!("Fast<f32> {:08x?}", sleigh_over(<Fast<f32> as Scalar>::from_f64).map(|x| x.0.to_bits())),
        format!("implicit  {:016x?}", robot().map(f64::to_bits)),
    ];
    lines.extend(methods::all());
    lines.extend(structure::all::<f64>());
    lines.extend(structure::all::<f32>());
    lines
}

fn main() {
    let lines = results();
    assert_eq!(lines, results(), "a second run has other bits");
    for line in lines {
        println!("{line}");
    }
    println!("{}", proved::all());
}

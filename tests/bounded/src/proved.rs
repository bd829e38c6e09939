//! Functions that cannot panic: with the feature `proof` the linker refuses them if they can.

use nonholonomic::control::{
    Estimate, Ilqr, Quadratic, Regulator, Sampled, Unscented, angle_difference, held_noise, zero_order_hold,
};
use nonholonomic::prelude::*;

use nalgebra::{Matrix1, Matrix4, RowVector4, Vector1, Vector4, Vector5};

use crate::systems::{
    Robot, RobotInput, RobotState, Sleigh, SleighInput, SleighOnThePlane, SleighOnThePlaneState, SleighState,
};

/// Defines functions that are proved not to panic.
macro_rules! proved {
    ($($vis:vis fn $name:ident($($argument:ident: $type:ty),* $(,)?) -> $result:ty $body:block)*) => {$(
        #[cfg_attr(feature = "proof", no_panic::no_panic)]
        #[inline(never)]
        $vis fn $name($($argument: $type),*) -> $result $body
    )*};
}

type Single = SleighState<f32>;
type Double = SleighState<f64>;
/// An optimal control problem of five ticks.
pub(crate) type Plan = Ilqr<f64, 5, 1, 5>;
type Cost = Quadratic<f64, 5, 1>;

proved! {
    fn derivative(sleigh: &Sleigh<f64>, x: &Double, u: &SleighInput<f64>) -> Double { sleigh.derivative(0.0, x, u) }
    fn derivative_single(sleigh: &Sleigh<f32>, x: &Single, u: &SleighInput<f32>) -> Single {
        sleigh.derivative(0.0, x, u)
    }
    fn energy(sleigh: &Sleigh<f64>, x: &Double) -> f64 { sleigh.energy(0.0, x) }
    fn outputs(sleigh: &Sleigh<f64>, x: &Double, u: &SleighInput<f64>) -> f64 { sleigh.outputs(0.0, x, u).speed }
    fn multipliers(sleigh: &Sleigh<f64>, x: &Double, u: &SleighInput<f64>) -> f64 {
        sleigh.multipliers(0.0, x, u).edge
    }
    fn velocity(sleigh: &Sleigh<f64>, x: &Double) -> f64 { sleigh.velocity(0.0, x).v2 }
    fn jacobian(sleigh: &Sleigh<f64>, x: &Double, u: &SleighInput<f64>) -> f64 { sleigh.jacobian(0.0, x, u).0.sum() }
    fn valid(sleigh: &Sleigh<f64>) -> bool { sleigh.validate().is_ok() }
    fn euler(sleigh: &Sleigh<f64>, dt: f64, x: &Double, u: &SleighInput<f64>) -> Double {
        Euler::step(sleigh, 0.0, dt, x, u)
    }
    fn runge_kutta(sleigh: &Sleigh<f64>, dt: f64, x: &Double, u: &SleighInput<f64>) -> Double {
        Rk4::step(sleigh, 0.0, dt, x, u)
    }
    fn runge_kutta_single(sleigh: &Sleigh<f32>, dt: f32, x: &Single, u: &SleighInput<f32>) -> Single {
        Rk4::step(sleigh, 0.0, dt, x, u)
    }
    fn runge_kutta_fast(
        sleigh: &Sleigh<Fast<f64>>, dt: Fast<f64>, x: &SleighState<Fast<f64>>, u: &SleighInput<Fast<f64>>,
    ) -> SleighState<Fast<f64>> {
        Rk4::step(sleigh, Fast(0.0), dt, x, u)
    }
    fn linearized(sleigh: &Sleigh<f64>, dt: f64, x: &Double, u: &SleighInput<f64>) -> f64 {
        Rk4::linearized_step(sleigh, 0.0, dt, x, u).by_state.sum()
    }
    pub(crate) fn implicit_step(robot: &Robot, dt: f64, x: &RobotState, u: &RobotInput) -> Option<RobotState> {
        ImplicitMidpoint::step_with_jacobian(robot, 0.0, dt, x, u).ok()
    }
    fn robot(robot: &Robot, dt: f64, x: &RobotState, u: &RobotInput) -> RobotState {
        Rk4::step(robot, 0.0, dt, x, u)
    }
    fn projected(sleigh: &SleighOnThePlane, dt: f64, x: &SleighOnThePlaneState) -> SleighOnThePlaneState {
        Rk4::step(sleigh, 0.0, dt, x, &())
    }
    fn back_on_the_constraint(sleigh: &SleighOnThePlane, x: &SleighOnThePlaneState) -> bool {
        let mut x = *x;
        sleigh.project(0.0, &mut x).is_ok()
    }
    fn sine_and_cosine(x: Fast<f64>) -> (Fast<f64>, Fast<f64>) { x.sin_cos() }
    fn sine_and_cosine_single(x: Fast<f32>) -> (Fast<f32>, Fast<f32>) { x.sin_cos() }
    fn hold(a: &Matrix4<f64>, b: &Vector4<f64>, dt: f64) -> bool { zero_order_hold(a, b, dt).is_ok() }
    fn noise(a: &Matrix4<f64>, density: &Matrix4<f64>, dt: f64) -> bool { held_noise(a, density, dt).is_ok() }
    fn regulator(a: &Matrix4<f64>, b: &Vector4<f64>, q: &Matrix4<f64>, r: &Matrix1<f64>) -> bool {
        Regulator::stationary(a, b, q, r).is_ok()
    }
    fn regulator_with_cross(a: &Matrix4<f64>, b: &Vector4<f64>, q: &Matrix4<f64>, r: &Matrix1<f64>) -> bool {
        Regulator::stationary_with_cross(a, b, q, r, b).is_ok()
    }
    fn regulator_before(a: &Matrix4<f32>, b: &Vector4<f32>, q: &Matrix4<f32>, r: &Matrix1<f32>) -> bool {
        Regulator::before(q, a, b, q, r).is_ok()
    }
    fn predicted(belief: &Estimate<f64, 4>, a: &Matrix4<f64>, noise: &Matrix4<f64>) -> bool {
        belief.predicted(a * belief.mean, a, noise).is_ok()
    }
    fn corrected(belief: &Estimate<f64, 4>, innovation: &Vector1<f64>, c: &RowVector4<f64>, r: &Matrix1<f64>) -> bool {
        belief.corrected(innovation, c, r).is_ok()
    }
    fn points_predicted(belief: &Estimate<f64, 4>, a: &Matrix4<f64>, noise: &Matrix4<f64>) -> bool {
        Unscented::default().predicted(belief, |x| a * x, noise).is_ok()
    }
    fn points_corrected(belief: &Estimate<f64, 4>, seen: &Vector1<f64>, c: &RowVector4<f64>, r: &Matrix1<f64>) -> bool {
        let difference = |a: Vector1<f64>, b: Vector1<f64>| Vector1::new(angle_difference(a.x, b.x));
        Unscented::default().corrected(belief, seen, |x| c * x, difference, r).is_ok()
    }
    fn plan(plan: &mut Plan, model: &Sampled<Sleigh<f64>, f64>, cost: &Cost, start: &Vector5<f64>) -> bool {
        plan.improve(model, cost, start).is_ok()
    }
    fn loop_with_an_integrator(robot: &Robot, dt: f64, end: f64, x: &RobotState) -> bool {
        let mut sim = Integrator::new(robot, Rk4::new(dt), 0.0, *x);
        let stepped = sim.step().is_ok();
        stepped & sim.advance_to(end).is_ok()
    }
    fn gauss(robot: &Robot, dt: f64, x: &RobotState, u: &RobotInput) -> bool {
        GaussLegendre4::step(robot, 0.0, dt, x, u).is_ok()
    }
    fn gauss_of_order_six(robot: &Robot, dt: f64, x: &RobotState, u: &RobotInput) -> bool {
        GaussLegendre6::step(robot, 0.0, dt, x, u).is_ok()
    }
    fn adaptive(robot: &Robot, tolerance: f64, end: f64, x: &RobotState) -> bool {
        Integrator::new(robot, Dopri5::new().rtol(tolerance), 0.0, *x).advance_to(end).is_ok()
    }
    fn adaptive_of_order_eight(robot: &Robot, tolerance: f64, end: f64, x: &RobotState) -> bool {
        Integrator::new(robot, Dop853::new().rtol(tolerance), 0.0, *x).advance_to(end).is_ok()
    }
    fn radau(robot: &Robot, tolerance: f64, end: f64, x: &RobotState) -> bool {
        Integrator::new(robot, Radau5::new().rtol(tolerance), 0.0, *x).advance_to(end).is_ok()
    }
    fn rosenbrock(robot: &Robot, tolerance: f64, end: f64, x: &RobotState) -> bool {
        Integrator::new(robot, Rodas5P::new().rtol(tolerance), 0.0, *x).advance_to(end).is_ok()
    }
}

#[allow(non_snake_case)] // the names of the parameters
/// Calls all of them, so that all of them are linked: how many gave something finite.
pub(crate) fn all() -> String {
    use std::hint::black_box;

    let numbers: [f64; 6] = black_box([1.0, 0.5, 0.1, 0.3, 0.1, 0.02]);
    let [m, J, J_w, a, b, c] = numbers;
    let sleigh = Sleigh { m, J, J_w, a, b, c };
    let x: Double = black_box([0.3, 0.1, 0.2, 0.4, 0.5]).into();
    let u = black_box(SleighInput { torque: 0.1 });
    let [m, J, J_w, a, b, c] = black_box([1.0_f32, 0.5, 0.1, 0.3, 0.1, 0.02]);
    let single = Sleigh { m, J, J_w, a, b, c };
    let single_x: Single = black_box([0.3_f32, 0.1, 0.2, 0.4, 0.5]).into();
    let single_u = black_box(SleighInput { torque: 0.1_f32 });
    let [m, J, J_w, a, b, c] = numbers.map(Fast);
    let fast = Sleigh { m, J, J_w, a, b, c };
    let fast_x = SleighState::from(x.to_array().map(Fast));
    let robot_system = black_box(Robot { m: 8.0, J: 0.3, I: 0.02, b: 0.2, d: 0.05, r: 0.1 });
    let (robot_x, robot_u) = black_box((RobotState::default(), RobotInput { right: 0.1, left: 0.2 }));
    let plane = black_box(SleighOnThePlane { m: 1.0, J: 0.2 });
    let plane_x = black_box(SleighOnThePlaneState { x_dot: 1.0, ..SleighOnThePlaneState::default() });
    // hidden too, so that nothing is proved for one length alone
    let (dt, end, tolerance) = black_box((0.01, 0.1, 1e-6));
    let results = [
        derivative(&sleigh, &x, &u).omega.is_finite(),
        derivative_single(&single, &single_x, &single_u).omega.is_finite(),
        energy(&sleigh, &x).is_finite(),
        outputs(&sleigh, &x, &u).is_finite(),
        multipliers(&sleigh, &x, &u).is_finite(),
        velocity(&sleigh, &x).is_finite(),
        jacobian(&sleigh, &x, &u).is_finite(),
        valid(&sleigh),
        euler(&sleigh, dt, &x, &u).x.is_finite(),
        runge_kutta(&sleigh, dt, &x, &u).x.is_finite(),
        runge_kutta_single(&single, black_box(0.01), &single_x, &single_u).x.is_finite(),
        runge_kutta_fast(&fast, Fast(dt), &fast_x, &SleighInput { torque: Fast(0.1) }).x.0.is_finite(),
        linearized(&sleigh, dt, &x, &u).is_finite(),
        implicit_step(&robot_system, dt, &robot_x, &robot_u).is_some(),
        robot(&robot_system, dt, &robot_x, &robot_u).x.is_finite(),
        projected(&plane, dt, &plane_x).x.is_finite(),
        back_on_the_constraint(&plane, &plane_x),
        sine_and_cosine(Fast(black_box(1e7))).0.0.is_finite(),
        sine_and_cosine_single(Fast(black_box(1e7))).0.0.is_finite(),
        loop_with_an_integrator(&robot_system, dt, end, &robot_x),
        gauss(&robot_system, dt, &robot_x, &robot_u),
        gauss_of_order_six(&robot_system, dt, &robot_x, &robot_u),
        adaptive(&robot_system, tolerance, end, &robot_x),
        adaptive_of_order_eight(&robot_system, tolerance, end, &robot_x),
        radau(&robot_system, tolerance, end, &robot_x),
        rosenbrock(&robot_system, tolerance, end, &robot_x),
    ];
    let controls = controls(&sleigh);
    let results = results.iter().chain(&controls);
    let count = results.clone().count();
    for (number, finite) in results.enumerate() {
        assert!(*finite, "function {number} of `proved.rs` gave nothing finite");
    }
    format!("{count} functions gave something finite")
}

/// The same of the building blocks of controllers.
fn controls(sleigh: &Sleigh<f64>) -> [bool; 10] {
    use std::hint::black_box;

    let a = black_box(Matrix4::identity() * 0.9 + Matrix4::repeat(0.02));
    let b = black_box(Vector4::new(0.1, 0.2, 0.3, 0.4));
    let (one, r) = black_box((Matrix4::identity(), Matrix1::new(2.0)));
    let row = black_box(RowVector4::new(1.0, 0.0, 0.5, 0.0));
    let belief = black_box(Estimate { mean: Vector4::new(0.1, 0.0, 0.2, 0.0), covariance: one });
    let seen = black_box(Vector1::new(0.3));
    let model = black_box(Sampled { system: *sleigh, start: 0.0, dt: 0.05 });
    let five = black_box(Vector5::new(0.3, 0.1, 0.2, 0.4, 0.5));
    let cost = Quadratic { goal: Vector5::zeros(), state: five, input: seen, end: five };
    [
        hold(&a, &b, black_box(0.1)),
        noise(&a, &one, black_box(0.1)),
        regulator(&a, &b, &one, &r),
        regulator_with_cross(&a, &b, &one, &r),
        regulator_before(&a.cast(), &b.cast(), &one.cast(), &r.cast()),
        predicted(&belief, &a, &one),
        corrected(&belief, &seen, &row, &r),
        points_predicted(&belief, &a, &one),
        points_corrected(&belief, &seen, &row, &r),
        plan(&mut black_box(Plan::new(seen)), &model, &cost, &five),
    ]
}

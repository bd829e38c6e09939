use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { der(x)^2 / 2 }
)]
#[derive(Clone, Copy)]
struct Free;

fn main() {
    let state = FreeState { x: 0.0, x_dot: 1.0 };
    let _ = Free.jacobian(0.0, &state, &());
    let _ = Free.sparse_jacobian(0.0, &state, &());
    let _ = Free.prepare().derivative(0.0, &state, &());
    let _ = Integrator::new(Free, Radau5::new().with_jacobian(), 0.0, state);
    let _ = Integrator::new(Free, ImplicitMidpoint::new(0.1).with_jacobian(), 0.0, state);
}

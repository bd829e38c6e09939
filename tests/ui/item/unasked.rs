use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { der(x)^2 / 2 }
)]
struct Free;

fn main() {
    let (free, mut state) = (Free, FreeState { x: 0.0, x_dot: 1.0 });
    let multipliers = free.multipliers(0.0, &state, &());
    println!("{:?}", multipliers.x);
    let _ = free.jacobian_product(0.0, &state, &(), &state, &());
    let _ = free.linearize(0.0, &state, &());
    let _ = free.trim(0.0, &state, &(), &[]);
    let _ = free.curvature(0.0, &state);
    let _ = free.assemble(0.0, &state);
    let _ = free.assemble_holding(0.0, &state, &[]);
    let _ = free.normalize(&mut state);
}

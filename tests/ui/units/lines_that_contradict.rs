use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 }
    units { x = m; x_dot = m/s^2; }
)]
struct S { m: f64 }

fn main() {}

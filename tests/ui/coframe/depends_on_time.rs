use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    velocities { v = exp(t) * der(x); }
    lagrangian { m / 2 * v^2 }
)]
struct S { m: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    velocities { v = der(x) + 1; }
    lagrangian { m / 2 * v^2 }
)]
struct S { m: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    basis { w }
    velocities { v = der(x); }
    lagrangian { m / 2 * v^2 }
)]
struct S { m: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    velocities { v = der(x) + der(y); }
    lagrangian { m / 2 * v^2 }
)]
struct S { m: f64 }

fn main() {}

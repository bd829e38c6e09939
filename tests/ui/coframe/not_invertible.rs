use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    velocities { v = der(x) + der(y); w = 2 * der(x) + 2 * der(y); }
    lagrangian { m / 2 * (v^2 + w^2) }
)]
struct S { m: f64 }

fn main() {}

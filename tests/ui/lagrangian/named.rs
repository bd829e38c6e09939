use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { L = m / 2 * der(x)^2; }
)]
struct Mass { m: f64 }

fn main() {}

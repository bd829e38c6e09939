use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 - k * sqrt(1 - cos(x)) }
)]
struct S { m: f64, k: f64 }

fn main() {}

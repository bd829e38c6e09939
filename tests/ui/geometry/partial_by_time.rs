use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * diff(x, t)^2 - k / 2 * diff(x * sin(t), t)^2 }
)]
struct S { m: f64, k: f64 }

fn main() {}

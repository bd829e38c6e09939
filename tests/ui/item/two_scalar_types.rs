use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 - k * x^2 }
)]
struct S { m: f64, k: f32 }

fn main() {}

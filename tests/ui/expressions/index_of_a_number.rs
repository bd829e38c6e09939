use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 - m[0] * x }
)]
struct S { m: f64 }

fn main() {}

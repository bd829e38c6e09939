use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 - 1e4000 * x }
)]
struct S { m: f64 }

fn main() {}

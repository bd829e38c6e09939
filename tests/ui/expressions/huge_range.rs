use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 - sum(i in 0..1000000000: i * x) }
)]
struct S { m: f64 }

fn main() {}

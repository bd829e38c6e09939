use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 - x * ln(0) }
)]
struct S { m: f64 }

fn main() {}

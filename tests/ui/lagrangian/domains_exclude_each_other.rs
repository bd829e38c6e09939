use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 - ln(x - 1) * asin(x + 1) }
)]
struct S { m: f64 }

fn main() {}

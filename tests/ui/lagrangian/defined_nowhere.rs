use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 + x / (cosh(x)^2 - sinh(x)^2 - 1) }
)]
struct S { m: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 }
    outputs { force = m * der(x * der(x)); }
)]
struct S { m: f64 }

fn main() {}

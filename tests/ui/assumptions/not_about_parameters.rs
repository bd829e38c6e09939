use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 }
    assume { x > 0; }
)]
struct S { m: f64 }

fn main() {}

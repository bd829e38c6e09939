use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 - ln(x - x - 1) }
    assume { m > 0; m < -1; x > 0; }
)]
struct S { m: f64 }

fn main() {}

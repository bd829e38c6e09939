use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 }
    forces { x = 1; }
)]
struct S { m: f64 }

fn main() {}

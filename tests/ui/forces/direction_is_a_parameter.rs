use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 }
    forces { m: 1; }
)]
struct S { m: f64 }

fn main() {}

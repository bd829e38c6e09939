use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 - k / 2 * (x - 1)^2 }
    units { x = m; m = kg; }
)]
struct S { m: f64, k: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - k * x }
    forces { y: -k * y; }
    units { x, y = m; m = kg; }
)]
struct S { m: f64, k: f64 }

fn main() {}

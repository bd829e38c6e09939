use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - k * ((x - y)^4)^(3/4) }
)]
struct S { m: f64, k: f64 }

fn main() {}

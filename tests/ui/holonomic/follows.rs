use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    holonomic { a: x = y; b: 2 * x = 2 * y; }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) }
)]
struct S { m: f64, l: f64 }

fn main() {}

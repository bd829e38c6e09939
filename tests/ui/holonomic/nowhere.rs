use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    holonomic { a: x^2 + y^2 + l^2 + 1 = 0; }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) }
)]
struct S { m: f64, l: f64 }

fn main() {}

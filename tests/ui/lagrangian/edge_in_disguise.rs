use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - sqrt(x^2 - 2 * x * y + y^2) }
)]
struct S { m: f64 }

fn main() {}

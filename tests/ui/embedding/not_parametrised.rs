use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    on { exp(x) + sin(x) + exp(y) + sin(y) = 3; }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) }
)]
struct S { m: f64 }

fn main() {}

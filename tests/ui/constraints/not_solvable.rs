use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) }
    constraints { exp(der(x)) + exp(der(y)) = 3; }
)]
struct S { m: f64 }

fn main() {}

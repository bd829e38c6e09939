use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y, z }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) }
    constraints { knife: der(x) = 0; knife: der(y) = 0; }
)]
struct S { m: f64 }

fn main() {}

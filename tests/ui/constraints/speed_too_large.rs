use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y, z }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) }
    constraints { speed: der(x)^2 + der(y)^2 = 1; rail: der(x) = 2; }
)]
struct S { m: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - m * y }
    impacts { floor: y >= 0 with restitution 3 / 2; }
)]
struct S { m: f64, e: f64 }

fn main() {}

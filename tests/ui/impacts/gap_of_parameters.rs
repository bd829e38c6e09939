use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - m * y }
    impacts { floor: h >= 0 with restitution e; }
)]
struct S { m: f64, h: f64, e: f64 }

fn main() {}

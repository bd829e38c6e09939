use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - m * y }
    impacts { walls: x >= 0, y >= 0, x >= -1, y >= -1, x >= -2, y >= -2, x >= -3; }
)]
struct S { m: f64, e: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    holonomic { one: x = a * t; two: 2 * x = 2 * a * t + sin(t); }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) }
)]
struct S { m: f64, a: f64 }

fn main() {}

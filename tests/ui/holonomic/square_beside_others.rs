use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y, z }
    holonomic { one: (x - y)^2 + x = z; two: x = z; redundant; }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) }
)]
struct S { m: f64 }

fn main() {}

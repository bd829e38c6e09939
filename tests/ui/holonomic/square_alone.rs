use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    holonomic { one: (x - y)^2 = 0; redundant; }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) }
)]
struct S { m: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    on { der(x) = 0; }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) }
)]
struct S { m: f64 }

fn main() {}

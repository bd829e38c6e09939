use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) }
    constraints { der(x) = 0; der(y) = 1; }
)]
struct S { m: f64 }

fn main() {}

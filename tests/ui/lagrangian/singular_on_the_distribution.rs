use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y, z }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) }
    constraints { der(y) = der(x); }
)]
struct S { m: f64 }

fn main() {}

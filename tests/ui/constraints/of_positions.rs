use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) }
    constraints { x^2 + y^2 = m^2; }
)]
struct S { m: f64 }

fn main() {}

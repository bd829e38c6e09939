use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y, z }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) }
    constraints { der(x)^2 + der(x) * der(y) + der(y)^2 + 1 = 0; }
)]
struct S { m: f64 }

fn main() {}

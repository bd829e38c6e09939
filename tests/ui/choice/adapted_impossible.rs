use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) }
    constraints { x * der(x) + y * der(y) = 0; }
    formulation { adapted }
)]
struct S { m: f64 }

fn main() {}

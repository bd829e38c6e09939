use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) }
    constraints { der(y) = x * der(x); }
    emit { symmetric_projection }
)]
struct S { m: f64 }

fn main() {}

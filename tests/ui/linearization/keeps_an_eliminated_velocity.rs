use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    constraints { der(y) = x * der(x); }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) }
    linearization { keep: x, der(y); }
)]
struct S { m: f64 }

fn main() {}

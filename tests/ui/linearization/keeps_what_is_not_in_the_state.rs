use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y, angle }
    constraints { der(y) = tan(angle) * der(x); }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) + J / 2 * der(angle)^2 }
    linearization { keep: angle, der(y), der(y), aagle; }
)]
struct S { m: f64, J: f64 }

fn main() {}

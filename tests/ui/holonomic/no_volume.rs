use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y, c, s }
    holonomic { direction: c^2 + s^2 = 1; }
    constraints { blade: c * der(y) - s * der(x) = 0; }
    lagrangian { m / 2 * ((der(x) + a * der(c))^2 + (der(y) + a * der(s))^2) + J / 2 * (der(c)^2 + der(s)^2) }
    volume;
)]
struct S { m: f64, a: f64, J: f64 }

fn main() {}

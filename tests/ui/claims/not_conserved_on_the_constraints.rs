use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - m * y }
    constraints { der(x)^2 + der(y)^2 = 1; }
    conserved { energy = m / 2 * der(y)^2 + m * y; }
)]
struct S { m: f64 }

fn main() {}

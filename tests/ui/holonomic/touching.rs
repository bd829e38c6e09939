use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y, z }
    holonomic { ball: x^2 + y^2 + z^2 = l^2; top: z = l; }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) }
)]
struct Pole { m: f64, l: f64 }

#[nonholonomic(
    base { x, y, z }
    holonomic { cone: x^2 + y^2 = z^2; floor: z = 0; }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) }
)]
struct Apex { m: f64 }

fn main() {}

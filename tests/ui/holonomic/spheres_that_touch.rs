use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y, z }
    holonomic { x^2 + y^2 + z^2 = 1; x^2 + y^2 + (z - 2)^2 = 1; }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) }
)]
struct Between { m: f64 }

fn main() {}

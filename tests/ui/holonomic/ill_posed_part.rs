use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    holonomic { stop: x^2 = 4; }
    lagrangian { m / 2 * (2 + x) * (der(x)^2 + der(y)^2) }
)]
struct Massless { m: f64 }

#[nonholonomic(
    base { x, y, z }
    holonomic { stop: x^2 = 4; plane: (x + 2) * (y - z) = 0; }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) }
)]
struct Dependent { m: f64 }

fn main() {}

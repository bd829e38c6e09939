use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y, z } holonomic { rod: x^2 + y^2 = 1; }
    lagrangian { (der(x)^2 + der(y)^2 + der(z)^2) / 2 }
    constraints { slope: der(z) = y * der(x); }
    emit { rattle }
)]
struct Rail;

fn main() {}

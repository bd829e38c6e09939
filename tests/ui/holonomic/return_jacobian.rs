use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) }
    emit { jacobian, return_jacobian }
)]
struct Free { m: f64 }

#[nonholonomic(
    base { x, y }
    holonomic { rope: x^2 + y^2 = l^2; }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) }
    emit { return_jacobian }
)]
struct Rope { m: f64, l: f64 }

fn main() {}

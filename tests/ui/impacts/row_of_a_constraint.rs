use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - m * y }
    constraints { cart: der(y) = x * der(x); }
    formulation { projected }
    impacts { floor: y >= 0 with restitution e; blade: x * der(x) = der(y); }
)]
struct S { m: f64, e: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { (der(x)^2 + der(y)^2) / 2 }
    constraints { der(y) = 2 * der(x); }
    hamilton_jacobi { der(y): 1; }
)]
struct Rail;

fn main() {}

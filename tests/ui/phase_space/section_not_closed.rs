use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { (der(x)^2 + der(y)^2) / 2 }
    hamilton_jacobi { der(x): k * y; }
)]
struct Free { k: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { (der(x)^2 + der(y)^2) / 2 - g * y }
    hamilton_jacobi { der(x): k; }
)]
struct Fall { k: f64, g: f64 }

fn main() {}

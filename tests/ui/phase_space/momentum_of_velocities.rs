use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { (der(x)^2 + der(y)^2) / 2 }
    hamilton_jacobi { der(y): der(x); }
)]
struct Free;

fn main() {}

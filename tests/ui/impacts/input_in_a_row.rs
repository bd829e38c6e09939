use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - m * y }
    inputs { u }
    impacts { blade: der(x) = u; }
)]
struct S { m: f64, e: f64 }

fn main() {}

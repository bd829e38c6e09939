use nonholonomic::prelude::*;

#[nonholonomic(
    constants { I[0] = 2; }
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) }
)]
struct S { m: f64 }

fn main() {}

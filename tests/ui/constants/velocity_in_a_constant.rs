use nonholonomic::prelude::*;

#[nonholonomic(
    constants { speed = 2 * der(x); }
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) }
)]
struct S { m: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    constants { l = 1/2; J = m * l^2; }
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) + J * der(x)^2 }
)]
struct S { m: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    constants { m = 2; a = 0.4; J = 0.32; }
    base { x, th }
    lagrangian { m / 2 * der(x)^2 + m * a * der(x) * der(th) + J / 2 * der(th)^2 }
)]
struct S {}

fn main() {}

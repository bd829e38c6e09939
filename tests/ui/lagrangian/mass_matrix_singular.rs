use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * der(x)^2 - y^2 }
)]
struct S { m: f64 }

fn main() {}

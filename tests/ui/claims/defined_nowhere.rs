use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 }
    outputs { angle = atan2(x - x, sin(x)^2 + cos(x)^2 - 1); }
)]
struct S { m: f64 }

fn main() {}

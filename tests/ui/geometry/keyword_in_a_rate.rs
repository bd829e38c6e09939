use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 }
    outputs { speed = der(loop); }
)]
struct S { m: f64 }

fn main() {}

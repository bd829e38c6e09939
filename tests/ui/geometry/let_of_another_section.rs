use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { let v = der(x); m / 2 * v^2 }
    outputs { speed = v; }
)]
struct S { m: f64 }

fn main() {}

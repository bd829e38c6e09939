use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) }
    outputs { v[0..2] = [der(x), der(y), 0]; a[2..2] = [x]; }
)]
struct S { m: f64 }

fn main() {}

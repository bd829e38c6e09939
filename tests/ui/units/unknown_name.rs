use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 }
    outputs { speed = der(x); }
    units { z = m; sped = m/s; lagrangain = J; }
)]
struct S { m: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    inputs { push }
    lagrangian { m / 2 * der(x)^2 }
    outputs { jerk = der(push * x); }
)]
struct S { m: f64 }

fn main() {}

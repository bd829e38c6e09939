use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    inputs { u }
    lagrangian { m / 2 * der(x)^2 + u * x }
)]
struct S { m: f64 }

fn main() {}

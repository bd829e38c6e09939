use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 - f64::consts::PI * x }
)]
struct S { m: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { (4 * atan(1/5) - atan(1/239) - pi / 4) * der(x)^2 - m * x }
)]
struct S { m: f64 }

fn main() {}

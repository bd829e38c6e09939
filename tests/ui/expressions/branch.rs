use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { if x < 0 { 0 } else { m / 2 * der(x)^2 } }
)]
struct S { m: f64 }

fn main() {}

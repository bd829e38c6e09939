use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m[0] / 2 * der(x)^2 }
)]
struct S { m: [f64; LENGTH] }
const LENGTH: usize = 2;

fn main() {}

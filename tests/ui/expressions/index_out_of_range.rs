use nonholonomic::prelude::*;

#[nonholonomic(
    base { x[3] }
    lagrangian { m / 2 * der(x[3])^2 }
)]
struct S { m: f64 }

fn main() {}

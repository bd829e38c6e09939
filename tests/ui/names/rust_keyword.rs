use nonholonomic::prelude::*;

#[nonholonomic(
    base { loop }
    lagrangian { m / 2 * der(loop)^2 }
)]
struct S { m: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x[3] }
    lagrangian { m / 2 * sum(i in 0..=2: der(x[i])^2) }
)]
struct S { m: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    basis { a, b }
    lagrangian { m / 2 * (a^2 + b^2) }
)]
struct S { m: f64 }

fn main() {}

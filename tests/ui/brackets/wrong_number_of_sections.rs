use nonholonomic::prelude::*;

#[nonholonomic(
    basis { a, b }
    brackets so(3) { a, b }
    lagrangian { m / 2 * (a^2 + b^2) }
)]
struct S { m: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    basis { a, b }
    brackets { [a, b] = a^2; }
    lagrangian { m / 2 * (a^2 + b^2) }
)]
struct S { m: f64 }

fn main() {}

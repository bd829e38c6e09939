use nonholonomic::prelude::*;

#[nonholonomic(
    basis { a, b }
    brackets { [a, b] = t * a; }
    lagrangian { m / 2 * (a^2 + b^2) }
)]
struct S { m: f64 }

fn main() {}

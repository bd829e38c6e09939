use nonholonomic::prelude::*;

#[nonholonomic(
    basis { a, b, c }
    brackets su(2) { a, b, c }
    lagrangian { m / 2 * (a^2 + b^2 + c^2) }
)]
struct S { m: f64 }

fn main() {}

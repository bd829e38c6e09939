use nonholonomic::prelude::*;

#[nonholonomic(
    basis { a, b, c }
    brackets so(3) { a, b, c }
    brackets { [a, b] = 2 * c; }
    lagrangian { m / 2 * (a^2 + b^2 + c^2) }
)]
struct S { m: f64 }

fn main() {}

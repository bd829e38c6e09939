use nonholonomic::prelude::*;

#[nonholonomic(
    basis { a, b, c }
    brackets { [a, b] = a; [b, c] = b; }
    lagrangian { m / 2 * (a^2 + b^2 + c^2) }
)]
struct S { m: f64 }

fn main() {}

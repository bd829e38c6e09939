use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y, z }
    basis { a, b }
    anchor { der(x) = a; der(y) = b; der(z) = x * b; }
    lagrangian { m / 2 * (a^2 + b^2) }
)]
struct S { m: f64 }

fn main() {}

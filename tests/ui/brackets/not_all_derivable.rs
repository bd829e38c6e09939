use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    basis { a, b, c }
    anchor { der(x) = a + b; der(y) = x * a + c; }
    brackets { [b, c] = 0; }
    lagrangian { m / 2 * (a^2 + b^2 + c^2) }
)]
struct S { m: f64 }

fn main() {}

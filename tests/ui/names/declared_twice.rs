use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    basis { x }
    anchor { der(x) = x; der(y) = 0; }
    lagrangian { m / 2 * x^2 }
)]
struct S { m: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    basis { v }
    anchor { der(x) = v; der(x) = 2 * v; }
    lagrangian { m / 2 * v^2 }
)]
struct S { m: f64 }

fn main() {}

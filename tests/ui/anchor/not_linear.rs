use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    basis { v }
    anchor { der(x) = v^2; }
    lagrangian { m / 2 * v^2 }
)]
struct S { m: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    basis { v }
    anchor { der(x) = cos(t) * v; }
    lagrangian { m / 2 * v^2 }
)]
struct S { m: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, q }
    lagrangian { m / 2 * (der(x)^2 + der(q)^2) }
    units { x = mm; q = deg; m = g; }
)]
struct S { m: f64 }

fn main() {}

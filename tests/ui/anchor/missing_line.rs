use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    basis { v, w }
    anchor { der(x) = v; }
    lagrangian { m / 2 * (v^2 + w^2) }
)]
struct S { m: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    basis { v, spin }
    anchor { der(x) = v + spin; }
    lagrangian { m / 2 * (v^2 + spin^2) }
)]
struct S { m: f64 }

fn main() {}

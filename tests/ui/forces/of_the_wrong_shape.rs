use nonholonomic::prelude::*;

#[nonholonomic(
    base { x[3] }
    lagrangian { m / 2 * dot(der(x), der(x)) }
    forces { x: 1; }
)]
struct S { m: f64 }

fn main() {}

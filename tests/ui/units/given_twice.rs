use nonholonomic::prelude::*;

#[nonholonomic(
    base { x[2] }
    lagrangian { m / 2 * dot(der(x), der(x)) }
    units { x = m; x[1] = m; }
)]
struct S { m: f64 }

fn main() {}

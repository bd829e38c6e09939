use nonholonomic::prelude::*;

#[nonholonomic(
    base { x[3] }
    lagrangian { m / 2 * dot(der(x), der(x)) - dot(x, [1, 2]) }
)]
struct S { m: f64 }

fn main() {}

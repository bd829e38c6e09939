use nonholonomic::prelude::*;

#[nonholonomic(
    base { x[2] }
    lagrangian { m / 2 * dot(der(x), der(x)) - dot(cross(x, x), x) }
)]
struct S { m: f64 }

fn main() {}

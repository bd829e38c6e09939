use nonholonomic::prelude::*;

#[nonholonomic(
    base { x[3] }
    lagrangian { m / 2 * dot(der(x), der(x)) - x }
)]
struct S { m: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x[2] }
    lagrangian { m[0] / 2 * dot(der(x), der(x)) }
)]
struct S<const N: usize> { m: [f64; N] }

fn main() {}

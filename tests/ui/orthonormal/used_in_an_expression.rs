use nonholonomic::prelude::*;

#[nonholonomic(base { x } lagrangian { m / 2 * u^2 } orthonormal { u, x })]
struct S { m: f64 }

fn main() {}

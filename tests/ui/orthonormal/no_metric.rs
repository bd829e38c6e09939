use nonholonomic::prelude::*;

#[nonholonomic(base { x } lagrangian { -m * c^2 * sqrt(1 - der(x)^2 / c^2) } orthonormal { u })]
struct S { m: f64, c: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(base { x, y } lagrangian { m / 2 * (der(x)^2 + der(y)^2) } orthonormal { u })]
struct S { m: f64 }

fn main() {}

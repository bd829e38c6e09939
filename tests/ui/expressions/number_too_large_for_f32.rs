use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m/2*der(x)^2 - k*1e50*x^2 }
)]
struct S { m: f32, k: f32 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m/2*der(x)^2*1e-400 - k*x^2/2 }
)]
struct S { m: f64, k: f64 }

fn main() {}

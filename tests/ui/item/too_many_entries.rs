use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 }
)]
struct S { m: f64, a: [[f64; 4096]; 4096] }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x[2] }
    lagrangian { 1 / 2 * dot(der(x), A * der(x)) }
)]
struct S { A: [[f64; 3]; 3] }

fn main() {}

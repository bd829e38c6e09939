use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, a }
    let R = rot([1, 1, 0], a);
    lagrangian { kinetic(m, I, [x, 0, 0], R) }
)]
struct S { m: f64, I: f64 }

fn main() {}

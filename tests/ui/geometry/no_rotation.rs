use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y, z, a }
    let R = [[cos(a), -sin(a), 0], [sin(a), cos(a), 0], [0, 0, 2]];
    lagrangian { kinetic(m, I, [x, y, z], R) }
)]
struct S { m: f64, I: f64 }

fn main() {}

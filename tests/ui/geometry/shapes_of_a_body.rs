use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y, a }
    lagrangian { kinetic(m, I, [x, y], rot_z(a)) }
)]
struct S { m: f64, I: f64 }

fn main() {}

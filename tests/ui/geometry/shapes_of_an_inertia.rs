use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y, a }
    lagrangian { kinetic(m, [I, I, I], [x, y], a) }
)]
struct S { m: f64, I: f64 }

#[nonholonomic(
    base { p[3], a }
    lagrangian { kinetic(m, [I, I], p, rot_z(a)) }
)]
struct T { m: f64, I: f64 }

fn main() {}

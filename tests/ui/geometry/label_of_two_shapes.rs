use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y, z }
    lagrangian { kinetic(m, [x, y, z]) }
    constraints { roll: der([x, y]) = 0; roll: der(z) = 0; }
)]
struct S { m: f64 }

fn main() {}

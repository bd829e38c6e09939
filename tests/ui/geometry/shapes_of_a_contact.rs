use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y, a }
    lagrangian { kinetic(m, I, [x, y], a) }
    constraints { blade: velocity_at([x, y], a, [x, y, 0])[1] = 0; }
)]
struct S { m: f64, I: f64 }

fn main() {}

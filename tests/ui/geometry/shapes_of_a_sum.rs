use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y, a }
    let R = rot_z(a);
    let tip = [x, y] + R * [1, 0, 0];
    lagrangian { kinetic(m, tip) + m / 2 * der(a)^2 }
)]
struct S { m: f64 }

fn main() {}

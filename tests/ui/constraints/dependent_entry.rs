use nonholonomic::prelude::*;

/// A ball whose contact never leaves the ground, rolling: that it does not rise is said twice.
#[nonholonomic(
    base { p[3], q[3] }
    let R = rot_z(q[0]) * rot_x(q[1]) * rot_z(q[2]);
    lagrangian { kinetic(m, I, p, R) - m * g * p[2] }
    holonomic { ground: p[2] = r; }
    constraints { velocity_at(p, R, p - [0, 0, r]) = 0; }
)]
struct S { m: f64, I: f64, g: f64, r: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y, z }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) - k * (x^2 + y^2) }
    symmetries { turn: x * der(y) - y * der(x); }
    emit { splitting }
)]
struct Particle { m: f64, k: f64 }

fn main() {}

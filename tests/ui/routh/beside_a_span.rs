use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y, z }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) }
    frame { a = der(x); b = der(y); }
    distribution { a, b }
    symmetries { turn: x * der(y) - y * der(x); }
    routh { turn = mu; }
)]
struct Particle { m: f64, mu: f64 }

fn main() {}

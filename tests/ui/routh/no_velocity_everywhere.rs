use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) }
    symmetries { turn: x * der(y) - y * der(x); }
    routh { turn = mu; }
    formulation { adapted }
)]
struct Particle { m: f64, mu: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) }
    symmetries { east: der(x); west: -2 * der(x); }
    routh { east = mu; west = nu; }
)]
struct Particle { m: f64, mu: f64, nu: f64 }

fn main() {}

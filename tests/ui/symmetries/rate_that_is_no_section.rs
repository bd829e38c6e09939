use nonholonomic::prelude::*;

#[nonholonomic(
    base { theta, x, y }
    basis { w, u, v }
    anchor { der(theta) = 2 * w; der(x) = u; der(y) = v; }
    lagrangian { J * w^2 + m / 2 * (u^2 + v^2) }
    symmetries { spin: der(theta); }
)]
struct Sleigh {
    m: f64,
    J: f64,
}

fn main() {}

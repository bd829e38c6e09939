use nonholonomic::prelude::*;

#[nonholonomic(
    base { theta, x, y }
    lagrangian { J / 2 * der(theta)^2 + m / 2 * (der(x)^2 + der(y)^2) }
    symmetries { none: x * der(y) - x * der(y); }
)]
struct Sleigh {
    m: f64,
    J: f64,
}

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - x^2 }
    routh { x = mu; }
)]
struct Skate {
    m: f64,
    mu: f64,
}

fn main() {}

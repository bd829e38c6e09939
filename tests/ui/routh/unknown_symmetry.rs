use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, angle }
    lagrangian { m / 2 * (der(x)^2 + der(angle)^2) - x^2 }
    routh { angel = mu; }
)]
struct Skate {
    m: f64,
    mu: f64,
}

fn main() {}

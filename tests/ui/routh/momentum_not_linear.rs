use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * der(x)^2 + (der(y)^2 + der(y)^4) / 2 }
    routh { y = mu; }
)]
struct Skate {
    m: f64,
    mu: f64,
}

fn main() {}

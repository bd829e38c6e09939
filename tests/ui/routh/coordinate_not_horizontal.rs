use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y, z }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) }
    constraints { der(z) = x * der(y); }
    routh { y = mu; }
)]
struct Skate {
    m: f64,
    mu: f64,
}

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y, z }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) - x^2 }
    constraints { der(z) = x * der(y); }
    emit { gyroscopic }
)]
struct Particle {
    m: f64,
}

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y, phi }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) + J / 2 * der(phi)^2 }
    constraints { sin(phi) * der(x) = cos(phi) * der(y); }
    symmetries { turn: der(phi) - x * der(y) + y * der(x); }
)]
struct Knife { m: f64, J: f64 }

fn main() {}

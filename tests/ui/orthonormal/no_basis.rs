use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y, theta }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) + J / 2 * der(theta)^2 }
    constraints { cos(theta) * der(y) = sin(theta) * der(x); }
    orthonormal { u1, u2 }
)]
struct Skate { m: f64, J: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y, z }
    holonomic { point: x^2 + (y - l)^2 + z^2 = 0; }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) }
)]
struct Sphere { m: f64, l: f64 }

#[nonholonomic(
    base { x, y }
    holonomic { peak: 1 - cos(x) = 0; }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) }
)]
struct Peak { m: f64 }

fn main() {}

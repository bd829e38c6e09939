//! Equal spheres meet in the plane between them, and in that plane they are nowhere.
use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y, z }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) }
    holonomic {
        first: x^2 + y^2 + z^2 = r^2;
        second: (x - d)^2 + y^2 + z^2 = r^2;
    }
    assume { r > 0; d > 2 * r; }
)]
#[derive(Clone, Copy)]
struct TwoRopes {
    m: f64,
    r: f64,
    d: f64,
}

fn main() {}

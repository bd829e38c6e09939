//! Two velocities prescribed for one coordinate, which are the same on a line.
use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y, z }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) }
    constraints { der(x) = y; der(x) = z; }
)]
#[derive(Clone, Copy)]
struct S {
    m: f64,
}

fn main() {}

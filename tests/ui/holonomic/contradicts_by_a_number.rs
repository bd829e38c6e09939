//! The rate of the second follows from that of the first, but not what it says.
use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) }
    holonomic {
        line: x + y = 0;
        cube: (x + y)^3 + x + y = 1;
        redundant;
    }
)]
#[derive(Clone, Copy)]
struct OnALine {
    m: f64,
}

fn main() {}

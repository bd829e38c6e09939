use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { (der(x)^2 + der(y)^2) / 2 - x * y }
    constraints { der(y) = x * der(x); }
    emit { splitting }
)]
struct Bead {}

fn main() {}

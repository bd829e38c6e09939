use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { (der(x)^2 + der(y)^2) / 2 }
    constraints { der(y) = x * der(x); }
    emit { leapfrog }
)]
struct Rail;

fn main() {}

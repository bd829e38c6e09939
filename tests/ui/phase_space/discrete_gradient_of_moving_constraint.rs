use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { (der(x)^2 + der(y)^2) / 2 }
    constraints { der(y) = t * der(x); }
    emit { discrete_gradient }
)]
struct Turning;

fn main() {}

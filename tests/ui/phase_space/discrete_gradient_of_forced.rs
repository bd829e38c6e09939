use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { der(x)^2 / 2 }
    forces { x: -c * der(x); }
    emit { discrete_gradient }
)]
struct Damped { c: f64 }

fn main() {}

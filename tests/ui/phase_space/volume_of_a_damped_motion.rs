use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { der(x)^2 / 2 }
    forces { x: -c * der(x)^3; }
    emit { volume }
)]
struct Damped { c: f64 }

fn main() {}

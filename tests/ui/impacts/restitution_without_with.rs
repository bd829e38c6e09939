use nonholonomic::prelude::*;

#[nonholonomic(
    base { y }
    lagrangian { m / 2 * der(y)^2 - m * g * y }
    impacts { floor: y >= 0 restitution e; }
)]
struct Ball { m: f64, g: f64, e: f64 }

fn main() {}

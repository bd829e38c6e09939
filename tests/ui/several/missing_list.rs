use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y, theta }
    lagrangian { m / 2 * (v^2 + side^2) + J / 2 * omega^2 }
    constraints { blade: side = a * omega; }
)]
struct Sleigh { m: f64, J: f64, a: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    inputs { push }
    let half = push / 2;
    let speed = half + der(y);
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) }
    constraints { der(x) = speed; }
)]
struct S { m: f64 }

fn main() {}

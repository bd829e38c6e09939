use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y, theta }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) + J / 2 * der(theta)^2 }
    constraints { blade: sin(theta) * der(x) = cos(theta) * der(y); }
    units { x: m; y: m; theta: 1; m: kg; J: kg*m^2; }
)]
struct Sleigh { m: f64, J: f64 }

fn main() {}

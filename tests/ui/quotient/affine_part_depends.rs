use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + 2 * der(y)^2) }
    constraints { carried: der(x) = 3 * der(y) - rate * y; }
)]
struct Full { m: f64, rate: f64 }

quotient! { Full -> struct Reduced by { x, y } }

fn main() {}

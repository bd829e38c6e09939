use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - k * (x^2 + y^2) }
    symmetries { spin: x * der(y) - y * der(x); }
)]
struct Full { m: f64, k: f64 }

quotient! { Full -> struct Reduced by { x, y } }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) }
    auxiliary { der(lag) = k * x - lag; }
    forces { y: -lag; }
)]
struct Full { m: f64, k: f64 }

quotient! { Full -> struct Reduced by { x } }

fn main() {}

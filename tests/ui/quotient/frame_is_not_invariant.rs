use nonholonomic::prelude::*;

#[nonholonomic(base { x, y } lagrangian { m / 2 * (der(x)^2 + der(y)^2) })]
struct Full { m: f64 }

quotient! { Full -> struct Reduced by { x } {
    velocities { u = der(x); v = der(y) - sin(x) * der(x); }
} }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(base { x, y } lagrangian { m / 2 * (der(x)^2 + der(y)^2) - m * g * sin(x) * y })]
struct Full { m: f64, g: f64 }

quotient! { Full -> struct Reduced by { x } }

fn main() {}

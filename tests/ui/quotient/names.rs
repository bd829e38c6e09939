use nonholonomic::prelude::*;

#[nonholonomic(base { x, y } lagrangian { m / 2 * (der(x)^2 + der(y)^2) })]
struct Full { m: f64 }

quotient! { Full -> struct Reduced by { x, z, x } }
quotient! { Full -> struct Second by { x } { lagrangian { 1 } } }
quotient! { Full -> Third by { x } }
quotient! { Full -> struct Fourth { x } }

fn main() {}

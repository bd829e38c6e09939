use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y, z }
    holonomic { ramp: z = a * x + y^2; }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) }
)]
struct Ramp { m: f64, a: f64 }

quotient! { Ramp -> struct Flat by { x } {} }

fn main() {}

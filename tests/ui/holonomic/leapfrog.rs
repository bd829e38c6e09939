use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y, z }
    holonomic { a: y = x^2; } emit { leapfrog }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) + m / 2 * der(z)^2 }
)]
struct S { m: f64, p: f64 }

fn main() {}

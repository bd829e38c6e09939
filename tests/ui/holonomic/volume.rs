use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    holonomic { a: y = x^2; } volume;
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) }
)]
struct S { m: f64, l: f64 }

fn main() {}

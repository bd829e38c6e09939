use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    holonomic { a: y = x^2; } constraints { b: der(y) = 2 * x * der(x); }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) }
)]
struct S { m: f64, l: f64 }

fn main() {}

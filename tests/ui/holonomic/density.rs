use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    holonomic { rope: x^2 + y^2 = l^2; }
    independent { der(x) }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) - m * g * y }
    volume { y; }
)]
struct S { m: f64, l: f64, g: f64 }

fn main() {}

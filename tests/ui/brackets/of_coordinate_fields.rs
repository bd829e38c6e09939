use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    brackets { [x, y] = x; }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2) }
)]
struct S { m: f64 }

fn main() {}

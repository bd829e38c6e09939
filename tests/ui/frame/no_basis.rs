use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    basis { v, w }
    anchor { der(x) = v; der(y) = w; }
    frame { a = v + w; b = 2 * v + 2 * w; }
    lagrangian { m / 2 * (a^2 + b^2) }
)]
struct S { m: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    basis { v, w }
    anchor { der(x) = v; der(y) = w; }
    frame { a = v + x * w; b = 2 * v + 2 * x * w; }
    distribution { a, b }
    lagrangian { m / 2 * (v^2 + w^2) }
)]
struct S { m: f64 }

fn main() {}

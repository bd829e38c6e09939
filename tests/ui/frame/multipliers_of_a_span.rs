use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    basis { v, w }
    anchor { der(x) = v; der(y) = w; }
    frame { a = v + x * w; }
    distribution { a }
    lagrangian { m / 2 * (v^2 + w^2) }
    emit { multipliers }
)]
struct S { m: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    basis { v, w }
    anchor { der(x) = v; der(y) = w; }
    frame { a = v^2; }
    lagrangian { m / 2 * (a^2 + w^2) }
)]
struct S { m: f64 }

fn main() {}

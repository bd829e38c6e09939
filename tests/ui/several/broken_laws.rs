use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y, z }
    basis { u, v, w }
    anchor { der(x) = u^2; der(y) = v + 1; der(z) = w; }
    lagrangian { m / 2 * (u^2 + v^2 + w^2) }
)]
struct S { m: f64 }

fn main() {}

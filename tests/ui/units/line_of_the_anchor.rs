use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, q }
    basis { v, w }
    anchor { der(x) = v * cos(q); der(q) = v; }
    lagrangian { m / 2 * (v^2 + w^2) }
    units { x = m; q = rad; }
)]
struct S { m: f64 }

fn main() {}

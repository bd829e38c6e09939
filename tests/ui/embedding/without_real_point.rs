use nonholonomic::prelude::*;

#[nonholonomic(
    base { c, s }
    on { c^2 + s^2 = -1; }
    basis { w }
    anchor { der(c) = -s * w; der(s) = c * w; }
    lagrangian { m / 2 * w^2 }
)]
struct S { m: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y }
    basis { w }
    anchor { der(x) = -w * y; der(y) = w * x; }
    holonomic { circle: x^2 + y^2 = 1; }
    lagrangian { m / 2 * w^2 }
)]
struct S { m: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x, y, z }
    holonomic { a: x^2 + y^2 = 1; }
    symmetries { shift: der(x); } routh { shift = p; }
    lagrangian { m / 2 * (der(x)^2 + der(y)^2 + der(z)^2) }
)]
struct S { m: f64, p: f64 }

fn main() {}

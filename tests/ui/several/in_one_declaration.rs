use nonholonomic::prelude::*;

#[nonholonomic(
    base { theta, t }
    basis { omega }
    anchor { der(teta) = omega; }
    lagrangian { m / 2 * omgea^2 - g * cos(theta) }
    forces { phi: 1; }
)]
struct S { m: f64 }

fn main() {}

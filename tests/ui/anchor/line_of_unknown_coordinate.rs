use nonholonomic::prelude::*;

#[nonholonomic(
    base { theta }
    basis { omega }
    anchor { der(tehta) = omega; }
    lagrangian { m / 2 * omega^2 }
)]
struct S { m: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { theta }
    lagrangian { m / 2 * der(theta)^2 }
    forces { theat: 1; }
)]
struct S { m: f64 }

fn main() {}

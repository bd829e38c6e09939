use nonholonomic::prelude::*;

#[nonholonomic(
    base { theta }
    lagrangian { m / 2 * der(theta)^2 - m * cos(teta) }
)]
struct S { m: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { t }
    lagrangian { m / 2 * der(t)^2 }
)]
struct S { m: f64 }

fn main() {}

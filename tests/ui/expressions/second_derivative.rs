use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(der(x))^2 }
)]
struct S { m: f64 }

fn main() {}

use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 - (((x^900)^900)^900)^900 }
)]
struct S { m: f64 }

fn main() {}

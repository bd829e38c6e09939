use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 - sqrt(1 - a) * x }
    assume { a > 2; }
)]
struct S { m: f64, a: f64 }

fn main() {}

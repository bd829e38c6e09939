use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 - a * b * x }
    assume { a > 1; b > 1; a * b < 1; }
)]
struct S { m: f64, a: f64, b: f64 }

fn main() {}

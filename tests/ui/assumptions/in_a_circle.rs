use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    lagrangian { m / 2 * der(x)^2 - (a + b + c) * x }
    assume { a > b; b > c; c > a; }
)]
struct S { m: f64, a: f64, b: f64, c: f64 }

fn main() {}

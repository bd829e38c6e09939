use nonholonomic::prelude::*;

#[nonholonomic(
    constants { a = 0.5; b = 1/2; }
    base { x }
    lagrangian { m / 2 * der(x)^2 - x^2 / (a - b) }
)]
struct S { m: f64 }

fn main() {}

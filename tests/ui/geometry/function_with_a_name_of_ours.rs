use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    let norm(u) = u^2;
    lagrangian { m / 2 * der(x)^2 - norm(x) }
)]
struct S { m: f64 }

fn main() {}

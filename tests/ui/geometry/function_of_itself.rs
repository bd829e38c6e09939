use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    let height(u) = u * height(u - 1);
    lagrangian { m / 2 * der(x)^2 - height(x) }
)]
struct S { m: f64 }

fn main() {}

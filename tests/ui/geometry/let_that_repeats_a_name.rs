use nonholonomic::prelude::*;

#[nonholonomic(
    base { x }
    let m = 2;
    lagrangian { let x = 3; m / 2 * der(x)^2 }
)]
struct S { m: f64 }

fn main() {}
